# Writes a source with the text of all templates: cmake -DFOLDER=... -DLIST=... -DSOURCE=... -P EmbedTemplates.cmake
file(READ "${LIST}" templates)
list(SORT templates)
set(rows "")
foreach (template IN LISTS templates)
  file(RELATIVE_PATH name "${FOLDER}" "${template}")
  file(READ "${template}" text)
  string(APPEND rows "    {\"${name}\", R\"template(${text})template\"},\n")
endforeach ()
file(WRITE "${SOURCE}" "// Made from the folder Templates.
#include \"FoamTemplate.h\"

namespace atria {

const std::map<std::string, std::string_view, std::less<>>& foamTemplates()
{
  static const std::map<std::string, std::string_view, std::less<>> all{
${rows}  };
  return all;
}

} // namespace atria
")
