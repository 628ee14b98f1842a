// SPDX-License-Identifier: GPL-3.0-or-later
#include "JsonText.h"

#include "Support/Error.h"
#include "Support/Utf8.h"

#include <string>

namespace atria::model {

nlohmann::json parseJson(std::string_view text)
{
  try
  {
    return nlohmann::json::parse(toUtf8(text));
  }
  catch (const nlohmann::json::exception& error)
  {
    // Behind the position, nlohmann-json repeats the text it read, which may be a whole buffer.
    const std::string_view said(error.what());
    const std::size_t begin = said.find("] ") + 2;
    throw Error("its JSON is damaged: " + std::string(said.substr(begin, said.find("; last read") - begin)));
  }
}

const nlohmann::json& entryOf(const nlohmann::json& object, const char* key)
{
  static const nlohmann::json none;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : none;
}

std::string textOf(const nlohmann::json& value) { return value.is_string() ? value.get<std::string>() : std::string(); }

} // namespace atria::model
