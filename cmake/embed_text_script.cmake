# Run by embed_text.cmake at build time. NAME, FILES (separated by |), BASE, SOURCE, HEADER.
string(REPLACE "|" ";" files "${FILES}")

set(header "#pragma once\n\n#include <string_view>\n#include <vector>\n\n")
string(APPEND header "namespace splotchcl::embedded {\n\n")
string(APPEND header "#ifndef SPLOTCHCL_EMBEDDED_TEXT_FILE\n#define SPLOTCHCL_EMBEDDED_TEXT_FILE\n")
string(APPEND header "struct TextFile {\n  const char* name;\n  std::string_view text;\n};\n#endif\n\n")
string(APPEND header "const std::vector<TextFile>& ${NAME}();\n\n}  // namespace splotchcl::embedded\n")

set(entries "")
foreach(file ${files})
  if(BASE)
    file(RELATIVE_PATH name ${BASE} ${file})
  else()
    get_filename_component(name ${file} NAME)
  endif()
  file(READ ${file} text)
  string(APPEND entries "      {\"${name}\", R\"EMBEDDED(${text})EMBEDDED\"},\n")
endforeach()

set(source "#include \"splotchcl_embedded/${NAME}.h\"\n\nnamespace splotchcl::embedded {\n\n")
string(APPEND source "const std::vector<TextFile>& ${NAME}() {\n")
string(APPEND source "  static const std::vector<TextFile> files = {\n${entries}  };\n  return files;\n}\n\n")
string(APPEND source "}  // namespace splotchcl::embedded\n")

file(WRITE ${HEADER} "${header}")
file(WRITE ${SOURCE} "${source}")
