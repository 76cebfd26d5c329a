# Packages for Debian by CPack, which scripts/package calls: a package per component of the
# installation.
set(SPLOTCHCL_MAINTAINER "the splotchcl authors <splotchcl@users.noreply.example.org>" CACHE STRING
    "Name and address in Debian's packages")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME splotchcl)
set(CPACK_PACKAGE_VENDOR "the splotchcl authors")
# Each package has its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_PACKAGE_CONTACT ${SPLOTCHCL_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# What each file needs, as dpkg-shlibdeps finds it.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/packages_script.cmake)

# splotchcl_package(COMPONENT NAME SECTION SUMMARY TEXT...): a package of a component.
macro(splotchcl_package component name section summary)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  string(JOIN "\n" text ${ARGN})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${text}")
endmacro()

set(about
  "splotchcl draws particle simulations of the universe with OpenCL, on a GPU"
  "or on any processor: gas that glows and absorbs light, with stars in it.")
set(library libsplotchcl${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(opencl "pocl-opencl-icd | opencl-icd")
set(CPACK_COMPONENTS_ALL)
splotchcl_package(program splotchcl science "renderer of particle simulations" ${about})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
    "${opencl}, splotchcl-openimageio, ffmpeg, fonts-dejavu-core")
splotchcl_package(library ${library} libs "renderer of particle simulations - library" ${about}
  "." "This is the library for C and C++.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "${opencl}, splotchcl-openimageio")
set(control ${PROJECT_BINARY_DIR}/packages)
file(WRITE ${control}/shlibs
  "libsplotchcl ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} ${library} (>= ${PROJECT_VERSION})\n")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)
splotchcl_package(dev libsplotchcl-dev libdevel "renderer of particle simulations - headers" ${about}
  "." "These are the headers of its library.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "${library} (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), libboost-dev")
splotchcl_package(openimageio splotchcl-openimageio science
  "renderer of particle simulations - other picture formats" ${about}
  "." "This lets it read and write the formats of pictures that OpenImageIO knows.")
# Several processes, for each MPI that was there.
get_property(mpis GLOBAL PROPERTY SPLOTCHCL_MPIS)
foreach(mpi IN LISTS mpis)
  splotchcl_package(${mpi} splotchcl-${mpi} science
    "renderer of particle simulations - several processes" ${about}
    "." "This lets several processes draw a picture together, by ${mpi}.")
endforeach()
# A module for another Python than Debian's own would not be found.
if(SPLOTCHCL_PYTHON AND Python_EXECUTABLE MATCHES "^/usr/bin/")
  get_property(minor GLOBAL PROPERTY SPLOTCHCL_PYTHON_MINOR)
  math(EXPR next ${minor}+1)
  splotchcl_package(python3 python3-splotchcl python
    "renderer of particle simulations - Python module" ${about}
    "." "This is the module for Python: arrays in, picture out.")
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_DEPENDS
      "python3 (>= 3.${minor}~), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_RECOMMENDS "${opencl}, splotchcl-openimageio")
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_SUGGESTS "python3-matplotlib")
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_CONTROL_EXTRA
      ${PROJECT_SOURCE_DIR}/scripts/packaging/debian/python3-splotchcl/postinst
      ${PROJECT_SOURCE_DIR}/scripts/packaging/debian/python3-splotchcl/prerm)
endif()
include(CPack)
