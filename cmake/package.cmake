# `cpack`, or the target `package`: perifrac_VERSION_amd64.deb and perifrac-VERSION-linux-x86_64.tar.gz.
# Without GPL parts the name says so.
set(CPACK_PACKAGE_NAME perifrac)
if(NOT PERIFRAC_CHOLMOD)
  set(CPACK_PACKAGE_NAME perifrac-nongpl)
  set(CPACK_DEBIAN_PACKAGE_PROVIDES perifrac)
  set(CPACK_DEBIAN_PACKAGE_CONFLICTS perifrac)
  set(CPACK_DEBIAN_PACKAGE_REPLACES perifrac)
else()
  # Of OpenBLAS's flavours the one that is built and tested with.
  set(blas ", libopenblas0-openmp")
endif()
set(CPACK_PACKAGE_VENDOR "The perifrac authors")
set(CPACK_PACKAGE_CONTACT "The perifrac authors <perifrac@localhost>")
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_MONOLITHIC_INSTALL OFF)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_COMPONENTS_ALL program set development)
if(PERIFRAC_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  # Of this version of Python alone.
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(python ", python3-numpy, python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next})")
endif()
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package_kinds.cmake)
set(CPACK_PACKAGE_FILE_NAME ${CPACK_PACKAGE_NAME}-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})

set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_NAME ${CPACK_PACKAGE_NAME})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3-matplotlib, python3-h5py, libudunits2-data${blas}${python}")
# What modules outside the tree are built with.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "cmake, g++, pkgconf, libeigen3-dev, libyaml-cpp-dev, libhdf5-dev, libsundials-dev, libsuitesparse-dev, libopenblas-openmp-dev, libudunits2-dev, libcli11-dev, voro++-dev, libspdlog-dev, libfmt-dev, nlohmann-json3-dev, paraview, python3-xarray")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Points that act on each other over a horizon model porous rock, the fluid in
 its pores, free fluid, and fluid in cracks, as modules coupled through ports.
 .
 The program, its scenes and pages, libraries and headers for modules of one's
 own. It takes the best instruction set that the processor has.")
if(NOT PERIFRAC_CHOLMOD)
  string(APPEND CPACK_DEBIAN_PACKAGE_DESCRIPTION "
 .
 Built without GPL parts: it factors with Eigen, which is slower.")
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
