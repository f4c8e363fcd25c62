# The folder that runs from anywhere has no prefix, and brings its libraries along; it is of use to
# nobody who compiles.
if(CPACK_GENERATOR STREQUAL TGZ)
  set(CPACK_PACKAGING_INSTALL_PREFIX "/")
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
  if(python IN_LIST CPACK_COMPONENTS_ALL)
    set(folder python_folder)
  endif()
  set(CPACK_COMPONENTS_ALL program set libraries ${folder})
endif()
