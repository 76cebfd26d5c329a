# splotchcl_built_with(NAME VERSION): a library of others, for what --version says.
function(splotchcl_built_with name version)
  if(version)
    set_property(GLOBAL APPEND PROPERTY SPLOTCHCL_BUILT_WITH "${name} ${version}")
  endif()
endfunction()
