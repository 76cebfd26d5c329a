# splotchcl_find_python(): Python for the module and its tests. Where the caller does not name one
# (Python_EXECUTABLE), the first that has numpy and pytest, since others could not run the tests.
macro(splotchcl_find_python)
  if(NOT Python_EXECUTABLE)
    foreach(candidate IN ITEMS python3 /usr/bin/python3)
      execute_process(COMMAND ${candidate} -c "import numpy, pytest, sys; print(sys.executable)"
        RESULT_VARIABLE failed OUTPUT_VARIABLE found ERROR_QUIET
        OUTPUT_STRIP_TRAILING_WHITESPACE)
      if(NOT failed)
        set(Python_EXECUTABLE ${found} CACHE FILEPATH "Python that the module is made for")
        break()
      endif()
    endforeach()
  endif()
  find_package(Python 3.10 REQUIRED COMPONENTS Interpreter Development.Module)
endmacro()
