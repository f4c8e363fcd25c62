# Puts what `program` is linked with, all the way down, below the prefix.
file(GET_RUNTIME_DEPENDENCIES
  EXECUTABLES ${program}
  RESOLVED_DEPENDENCIES_VAR libraries
  UNRESOLVED_DEPENDENCIES_VAR missing
  POST_EXCLUDE_REGEXES "/lib(c|m|dl|rt|pthread|resolv)\\.so" "/ld-linux")
if(missing)
  message(FATAL_ERROR "libraries that are not found: ${missing}")
endif()
set(prefix "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
foreach(library ${libraries})
  file(INSTALL ${library} DESTINATION ${prefix}/${own_libraries} FOLLOW_SYMLINK_CHAIN)
endforeach()
file(GLOB units /usr/share/xml/udunits/*.xml)
file(INSTALL ${units} DESTINATION ${prefix}/${share}/udunits)
