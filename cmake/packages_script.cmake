# Run by CPack when the files of all packages lie in folders of their own: what Debian has its own
# way for. Installing by CMake leaves them as they are.
get_filename_component(SPLOTCHCL_SOURCE ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)

function(compress file)
  execute_process(COMMAND gzip -9n ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Libraries lie where the loader looks by itself.
function(remove_search_paths folder)
  file(GLOB_RECURSE files ${folder}/usr/bin/* ${folder}/usr/lib/*.so*)
  foreach(file IN LISTS files)
    if(NOT IS_SYMLINK ${file})
      file(RPATH_REMOVE FILE ${file})
    endif()
  endforeach()
endfunction()

function(write_documents folder package)
  set(documents ${folder}/usr/share/doc/${package})
  file(READ ${SPLOTCHCL_SOURCE}/LICENSE license)
  file(READ ${SPLOTCHCL_SOURCE}/palettes/NOTICE palettes)
  string(REPLACE "(LICENSE.Apache-2.0 in this folder)" "(/usr/share/common-licenses/Apache-2.0)"
    palettes "${palettes}")
  file(WRITE ${documents}/copyright "${license}\n\n${palettes}")
  configure_file(${SPLOTCHCL_SOURCE}/CHANGELOG.md ${documents}/changelog COPYONLY)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${documents}/changelog.Debian
    "splotchcl (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
    "  * Packages of version ${CPACK_PACKAGE_VERSION}; the file changelog says what is new.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  compress(${documents}/changelog)
  compress(${documents}/changelog.Debian)
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(folder ${CPACK_TEMPORARY_DIRECTORY}/${component})
  remove_search_paths(${folder})
  write_documents(${folder} ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
endforeach()

# They are opened by their names, by what was built with them, and nobody links them.
foreach(module IN ITEMS openimageio openmpi mpich)
  list(FIND CPACK_COMPONENTS_ALL ${module} place)
  if(NOT place EQUAL -1)
    file(WRITE ${CPACK_TEMPORARY_DIRECTORY}/${module}/usr/share/lintian/overrides/splotchcl-${module}
      "splotchcl-${module}: sharedobject-in-library-directory-missing-soname\n")
  endif()
endforeach()

set(program ${CPACK_TEMPORARY_DIRECTORY}/program/usr/share)
file(GLOB pages ${program}/man/man1/*.1)
foreach(page IN LISTS pages)
  compress(${page})
endforeach()
file(MAKE_DIRECTORY ${program}/zsh/vendor-completions)
file(RENAME ${program}/zsh/site-functions/_splotchcl ${program}/zsh/vendor-completions/_splotchcl)
file(REMOVE_RECURSE ${program}/zsh/site-functions)
