// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library.h"

#include "Input.h"
#include "Lexer.h"
#include "Parser.h"

#include "Support/Error.h"

namespace atria::vrml {

namespace fs = std::filesystem;

namespace {

void checkLanguage(const fs::path& file, std::string_view text)
{
  if (versionOf(text) == Version::missing && text.find('\0') != std::string_view::npos)
  {
    throw Error(std::string("'").append(file.string()).append("', line 1: this is not a VRML file"));
  }
}

/// Files without a header: VRML 1.0 has nodes that VRML97 has not, and no file goes far without one of them.
Version guessVersion(std::string_view text)
{
  constexpr std::size_t farEnough = 1 << 20;
  Lexer lexer(text.substr(0, farEnough));
  for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next())
  {
    for (const std::string_view name : {"Separator", "Coordinate3", "ShapeHints", "MaterialBinding", "WWWInline"})
    {
      if (token.is(name) && lexer.peek().kind == TokenKind::openBrace)
      {
        return Version::vrml1;
      }
    }
    if (token.is("Shape") || token.is("children"))
    {
      break;
    }
  }
  return Version::missing;
}

void warnOfVersion(Diagnostics& diagnostics, const Document& document, Version declared)
{
  const std::string place = document.displayName() + ":1: ";
  if (declared == Version::missing)
  {
    diagnostics.warn(place + "the first line is not '#VRML V2.0 utf8'; read as " +
                     (document.version == Version::vrml1 ? "VRML 1.0" : "VRML97"));
  }
  else if (declared == Version::x3d)
  {
    diagnostics.warn(place + "the file declares X3D; read as VRML97");
  }
}

} // namespace

Version versionOf(std::string_view text)
{
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  const std::string_view line = start == std::string_view::npos ? "" : text.substr(start, 20);
  const auto starts = [&](std::string_view header) { return line.substr(0, header.size()) == header; };
  if (starts("#VRML V2"))
  {
    return Version::vrml97;
  }
  if (starts("#VRML V1") || starts("#Inventor"))
  {
    return Version::vrml1;
  }
  return starts("#X3D") ? Version::x3d : Version::missing;
}

std::unique_ptr<Document> Library::read(const fs::path& file)
{
  const FileText source = readText(file);
  checkLanguage(file, source.text());
  auto document = std::make_unique<Document>(file);
  const Version declared = versionOf(source.text());
  document->version = declared == Version::missing ? guessVersion(source.text()) : declared;
  constexpr std::size_t headLength = 4096;
  document->head = source.text().substr(0, headLength);
  if (source.truncated)
  {
    diagnostics.warn(document->displayName() +
                     ": the compressed file is damaged or ends early; read as far as possible");
  }
  warnOfVersion(diagnostics, *document, declared);
  Parser(*document, source.text(), diagnostics, progress).run();
  return document;
}

const Document& Library::open(const fs::path& file)
{
  std::error_code ignored;
  const fs::path canonical = fs::weakly_canonical(file, ignored);
  std::unique_ptr<Document>& document = documents[canonical.empty() ? file : canonical];
  document = read(file);
  return *document;
}

const Document* Library::openBeside(const Document& from, const std::vector<std::string>& urls, int line,
                                    const std::string& what)
{
  const std::string place = from.displayName() + ":" + std::to_string(line) + ": " + what;
  std::string tried;
  for (const std::string& url : urls)
  {
    tried += (tried.empty() ? "'" : ", '") + toUtf8(url) + "'";
    const std::optional<fs::path> file = findFile(from.file.parent_path(), url);
    if (!file)
    {
      continue;
    }
    const auto [found, isNew] = documents.try_emplace(fs::weakly_canonical(*file));
    if (isNew)
    {
      try
      {
        found->second = read(*file);
      }
      catch (const Error& error)
      {
        diagnostics.warn(place + ": " + error.what());
      }
    }
    if (found->second)
    {
      return found->second.get();
    }
  }
  diagnostics.warn(place + (tried.empty() ? " has no URL" : ": cannot read " + tried) + "; skipped");
  return nullptr;
}

std::size_t Library::routes() const
{
  std::size_t sum = 0;
  for (const auto& [path, document] : documents)
  {
    sum += document ? document->routes : 0;
  }
  return sum;
}

} // namespace atria::vrml
