# splotchcl_embed_text(TARGET <target> NAME <identifier> FILES <files...> [BASE <folder>])
#
# Compiles text files into <target>, so that the program needs no files of its own at
# run time. The header splotchcl_embedded/<identifier>.h declares
#   namespace splotchcl::embedded {
#   struct TextFile { const char* name; std::string_view text; };   // name: from BASE on, else without folder
#   const std::vector<TextFile>& <identifier>();
#   }
# The files are read at build time: editing one rebuilds what embeds it.
set(SPLOTCHCL_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_text_script.cmake)

function(splotchcl_embed_text)
  cmake_parse_arguments(arg "" "TARGET;NAME;BASE" "FILES" ${ARGN})
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  set(source ${folder}/${arg_NAME}.cpp)
  set(header ${folder}/splotchcl_embedded/${arg_NAME}.h)
  set(files)
  foreach(file ${arg_FILES})
    get_filename_component(file ${file} ABSOLUTE)
    list(APPEND files ${file})
  endforeach()
  list(JOIN files "|" joined)
  add_custom_command(
    OUTPUT ${source} ${header}
    COMMAND ${CMAKE_COMMAND} -DNAME=${arg_NAME} -DFILES=${joined} -DBASE=${arg_BASE} -DSOURCE=${source}
            -DHEADER=${header} -P ${SPLOTCHCL_EMBED_SCRIPT}
    DEPENDS ${files} ${SPLOTCHCL_EMBED_SCRIPT}
    COMMENT "Embedding ${arg_NAME}"
    VERBATIM)
  target_sources(${arg_TARGET} PRIVATE ${source} ${header})
  target_include_directories(${arg_TARGET} PRIVATE ${folder})
endfunction()
