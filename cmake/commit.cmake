# splotchcl_add_commit_header(TARGET): gives <target> splotchcl_embedded/commit.h, which defines SPLOTCHCL_COMMIT:
# the commit that is built, with "+" where files were changed; empty outside of a repository.
# Looked at in every build; the header is written anew only where it changes.
set(SPLOTCHCL_COMMIT_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/commit_script.cmake)

function(splotchcl_add_commit_header target)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/commit/splotchcl_embedded/commit.h)
  add_custom_target(${target}_commit BYPRODUCTS ${header}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADER=${header}
            -P ${SPLOTCHCL_COMMIT_SCRIPT})
  add_dependencies(${target} ${target}_commit)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/commit)
endfunction()
