// SPDX-License-Identifier: GPL-3.0-or-later
#include "Library.h"

#include "Input.h"
#include "Lexer.h"
#include "Parser.h"

#include "Support/Error.h"

namespace atria::vrml {

using scene::Diagnostics;

namespace fs = std::filesystem;

namespace {

void checkLanguage(const fs::path& file, std::string_view text)
{
  if (versionOf(text) == Version::missing && text.find('\0') != std::string_view::npos)
  {
    throw Error(std::string("'").append(file.string()).append("', line 1: this is not a VRML file"));
  }
}

/// Returns the version by the nodes if the header is missing or wrong. VRML 1.0 has nodes that VRML97 does not have,
/// and the other way around, and few characters of a file go by without one of them.
Version versionOfNodes(std::string_view text)
{
  constexpr std::size_t farEnough = 1 << 16;
  Lexer lexer(text.substr(0, farEnough));
  for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next())
  {
    if (token.is("PROTO") || token.is("EXTERNPROTO") || token.is("fields"))
    {
      break; // names after it may be any
    }
    if (token.kind != TokenKind::word || lexer.peek().kind != TokenKind::openBrace)
    {
      continue;
    }
    for (const std::string_view name : {"Separator", "Coordinate3", "ShapeHints", "MaterialBinding", "WWWInline"})
    {
      if (token.text == name)
      {
        return Version::vrml1;
      }
    }
    for (const std::string_view name : {"Shape", "Appearance", "Coordinate", "WorldInfo", "Viewpoint", "Inline"})
    {
      if (token.text == name)
      {
        return Version::vrml97;
      }
    }
  }
  return Version::missing;
}

/// Returns the language to read a file as. Warns if its header does not state it.
Version chooseVersion(Diagnostics& diagnostics, const Document& document, std::string_view text)
{
  const std::string place = document.displayName() + ":1: ";
  const Version declared = versionOf(text);
  const Version used = versionOfNodes(text);
  const auto nameOf = [](Version version) { return version == Version::vrml1 ? "VRML 1.0" : "VRML97"; };
  if (declared == Version::missing)
  {
    diagnostics.warn(place + "the first line is not '#VRML V2.0 utf8'; read as " + nameOf(used));
    return used;
  }
  if (declared == Version::x3d)
  {
    diagnostics.warn(place + "the file declares X3D; read as VRML97");
    return declared;
  }
  if (used != Version::missing && used != declared)
  {
    diagnostics.warn(place + "the file declares " + nameOf(declared) + ", but its nodes are those of " + nameOf(used) +
                     "; read as such");
    return used;
  }
  return declared;
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
  FileText source = readText(file);
  checkLanguage(file, source.text());
  auto document = std::make_unique<Document>(file);
  document->version = chooseVersion(diagnostics, *document, source.text());
  constexpr std::size_t headLength = 4096;
  document->head = source.text().substr(0, headLength);
  if (source.truncated)
  {
    diagnostics.warn(document->displayName() +
                     ": the compressed file is damaged or ends early; read as far as possible");
  }
  Parser(*document, std::move(source), diagnostics, progress).run();
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

const Document* Library::openOnce(const fs::path& file, const std::string& place)
{
  const auto [found, isNew] = documents.try_emplace(fs::weakly_canonical(file));
  if (isNew)
  {
    try
    {
      found->second = read(file);
    }
    catch (const Error& error)
    {
      diagnostics.warn(place + ": " + error.what());
    }
  }
  return found->second.get();
}

const Document* Library::openNamesake(const fs::path& folder, std::string_view url, const std::string& place)
{
  const std::optional<fs::path> file = findNamesake(folder, url);
  const Document* document = file ? openOnce(*file, place) : nullptr;
  if (document && namesakes.insert({toUtf8(url), *file}).second)
  {
    diagnostics.warn(place + ": '" + toUtf8(url) + "' is not there; '" + file->string() +
                     "' is read instead, which has its name");
  }
  return document;
}

const Document* Library::openBeside(const Document& from, const Strings& urls, const Node& user)
{
  const std::string place = placeOf(user);
  const fs::path folder = from.file.parent_path();
  std::string tried;
  for (const std::string_view url : urls)
  {
    tried += (tried.empty() ? "'" : ", '") + toUtf8(url) + "'";
    const std::optional<fs::path> file = findFile(folder, url);
    if (const Document* document = file ? openOnce(*file, place) : nullptr)
    {
      return document;
    }
  }
  for (const std::string_view url : urls)
  {
    if (const Document* document = openNamesake(folder, url, place))
    {
      return document;
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
