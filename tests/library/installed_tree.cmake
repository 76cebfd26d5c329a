# Run by the test installed_tree, with the variables that tests/library/CMakeLists.txt gives.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

function(expect_picture path)
  if(NOT EXISTS ${path})
    message(FATAL_ERROR "${path} was not drawn")
  endif()
  # One that is black all over compresses to less.
  file(SIZE ${path} size)
  if(size LESS 5000)
    message(FATAL_ERROR "${path} has ${size} bytes: it shows nothing")
  endif()
endfunction()

execute_process(COMMAND ${BUILD}/splotchcl devices RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(NOT result EQUAL 0)
  message("no OpenCL device here: the programs cannot be run")
  return()
endif()

file(REMOVE_RECURSE ${FOLDER})
set(prefix ${FOLDER}/prefix)
set(build ${FOLDER}/build)
set(pictures ${FOLDER}/pictures)
file(MAKE_DIRECTORY ${pictures} ${build})

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${prefix}/bin/splotchcl --version)

# Of its parts none looks for libraries in the folder that is current.
file(GLOB_RECURSE objects ${prefix}/bin/splotchcl ${prefix}/lib*/*.so)
foreach(object IN LISTS objects)
  execute_process(COMMAND readelf -d ${object} OUTPUT_VARIABLE dynamic)
  if(dynamic MATCHES "R(UN)?PATH[^\n]*: \\[([^\n]*)\\]")
    set(folders ":${CMAKE_MATCH_2}:")
    if(folders MATCHES "::|:[^/$:]")
      message(FATAL_ERROR "${object} looks for libraries in what is no absolute folder: ${folders}")
    endif()
  endif()
endforeach()

# Through the CMake package.
run(${CMAKE_COMMAND} -S ${SOURCE}/examples/in_situ -B ${build} -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_C_COMPILER=${CC} -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${build})
run(${build}/in_situ_cpp ${pictures})
run(${build}/in_situ_c ${pictures})
foreach(i RANGE 2)
  expect_picture(${pictures}/in_situ_${i}.png)
  expect_picture(${pictures}/collapse_${i}.png)
endforeach()

# Through pkg-config, with only the C header.
file(GLOB_RECURSE pc ${prefix}/splotchcl.pc)
get_filename_component(pc_folder "${pc}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
execute_process(COMMAND pkg-config --modversion splotchcl OUTPUT_VARIABLE version
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT version STREQUAL VERSION)
  message(FATAL_ERROR "pkg-config says version '${version}', expected ${VERSION}")
endif()
execute_process(COMMAND pkg-config --cflags --libs splotchcl OUTPUT_VARIABLE flags
                OUTPUT_STRIP_TRAILING_WHITESPACE)
separate_arguments(flags)
execute_process(COMMAND pkg-config --variable=libdir splotchcl OUTPUT_VARIABLE libdir
                OUTPUT_STRIP_TRAILING_WHITESPACE)
run(${CC} -std=c99 -Wall -Wextra -Werror -pedantic ${SOURCE}/examples/in_situ/in_situ.c
    -o ${build}/collapse ${flags} -Wl,-rpath,${libdir} -lm)
file(REMOVE ${pictures}/collapse_0.png)
run(${build}/collapse ${pictures})
expect_picture(${pictures}/collapse_0.png)

# Distributed ones, of each MPI that the library was built for.
set(mpirun_openmpi mpirun.openmpi --oversubscribe -n)
set(mpirun_mpich mpirun.mpich -n)
# Containers and test machines have one user.
set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)
separate_arguments(MPIS)
foreach(mpi IN LISTS MPIS)
  find_program(mpicc_${mpi} mpicc.${mpi})
  find_program(mpicxx_${mpi} mpicxx.${mpi})
  find_program(mpirun_of_${mpi} mpirun.${mpi})
  if(NOT mpicc_${mpi} OR NOT mpicxx_${mpi} OR NOT mpirun_of_${mpi})
    message("no mpicc.${mpi}, mpicxx.${mpi} or mpirun.${mpi} here: its simulations are not run")
    continue()
  endif()
  set(build ${FOLDER}/build_${mpi})
  run(${CMAKE_COMMAND} -S ${SOURCE}/examples/in_situ_mpi -B ${build} -G ${GENERATOR}
      -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_C_COMPILER=${CC} -DCMAKE_PREFIX_PATH=${prefix}
      -DMPI_C_COMPILER=${mpicc_${mpi}} -DMPI_CXX_COMPILER=${mpicxx_${mpi}})
  run(${CMAKE_COMMAND} --build ${build})
  foreach(ranks 1 3)
    set(pictures ${FOLDER}/pictures_${mpi}_${ranks})
    file(MAKE_DIRECTORY ${pictures})
    run(${mpirun_${mpi}} ${ranks} ${build}/in_situ_mpi_cpp ${pictures})
    run(${mpirun_${mpi}} ${ranks} ${build}/in_situ_mpi_c ${pictures})
    foreach(i RANGE 2)
      expect_picture(${pictures}/disk_${i}.png)
      expect_picture(${pictures}/collapse_${i}.png)
    endforeach()
  endforeach()
  # Whoever has them, the particles of the ball are in the same order.
  foreach(i RANGE 2)
    foreach(ranks 1 3)
      file(SHA256 ${FOLDER}/pictures_${mpi}_${ranks}/collapse_${i}.png sum_of_${ranks})
    endforeach()
    if(NOT sum_of_1 STREQUAL sum_of_3)
      message(FATAL_ERROR "collapse_${i}.png of three ranks is not that of one")
    endif()
  endforeach()
endforeach()
