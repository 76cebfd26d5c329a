# A table of the project's targets as CMake links them, for tests/architecture: what a folder may
# include follows from its target_link_libraries, and from nothing else.

# splotchcl_describe_target(NAME [FOLDERS...] [HEADERS NAMES...]): the target's files lie in the
# current folder and in these others of the project, its public headers in include/splotchcl/.
# Only what is in src/ is described.
function(splotchcl_describe_target name)
  cmake_parse_arguments(arg "" "" "HEADERS" ${ARGN})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT folder MATCHES "^src/")
    return()
  endif()
  list(TRANSFORM arg_HEADERS PREPEND splotchcl/)
  set_property(GLOBAL APPEND PROPERTY SPLOTCHCL_TARGETS ${name})
  set_property(TARGET ${name} PROPERTY SPLOTCHCL_FOLDERS ${folder} ${arg_UNPARSED_ARGUMENTS})
  set_property(TARGET ${name} PROPERTY SPLOTCHCL_HEADERS ${arg_HEADERS})
endfunction()

# Keeps those of the targets that are described.
function(splotchcl_keep_described result)
  get_property(described GLOBAL PROPERTY SPLOTCHCL_TARGETS)
  set(kept)
  foreach(item IN LISTS ARGN)
    if(item IN_LIST described)
      list(APPEND kept ${item})
    endif()
  endforeach()
  set(${result} ${kept} PARENT_SCOPE)
endfunction()

# Lines of words for one target:
#   target NAME
#   folder FOLDER      of the project
#   header FILE        a public header, as it is included
#   links TARGET       what it may include
#   exports TARGET     what those that link it may include, too
function(splotchcl_describe result name)
  set(text "target ${name}\n")
  get_target_property(type ${name} TYPE)
  get_property(interface TARGET ${name} PROPERTY INTERFACE_LINK_LIBRARIES)
  splotchcl_keep_described(exports ${interface})
  set(links)
  if(NOT type STREQUAL INTERFACE_LIBRARY)
    get_property(own TARGET ${name} PROPERTY LINK_LIBRARIES)
    # Of a module that implements what another target declares, without linking it.
    get_property(implements TARGET ${name} PROPERTY SPLOTCHCL_IMPLEMENTS)
    splotchcl_keep_described(links ${own} ${implements})
  endif()
  get_property(folder TARGET ${name} PROPERTY SPLOTCHCL_FOLDERS)
  get_property(header TARGET ${name} PROPERTY SPLOTCHCL_HEADERS)
  foreach(kind IN ITEMS folder header links exports)
    foreach(word IN LISTS ${kind})
      string(APPEND text "${kind} ${word}\n")
    endforeach()
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Called when everything has been configured, so that no link is missing.
function(splotchcl_write_target_table file)
  get_property(targets GLOBAL PROPERTY SPLOTCHCL_TARGETS)
  set(table "")
  foreach(target IN LISTS targets)
    splotchcl_describe(text ${target})
    string(APPEND table "${text}")
  endforeach()
  file(WRITE ${file} "${table}")
endfunction()
