# The Python package: where Debian's Python looks, and in the folder that runs from anywhere in lib/python.
# Builds for several instruction sets lie side by side, a folder each.
if(perifrac_set STREQUAL native)
  set(extension_folder perifrac)
else()
  set(extension_folder perifrac/${perifrac_set})
endif()
# Libraries that are brought along, from the depth of either place.
set(upwards "$ORIGIN/../../..")
if(NOT perifrac_set STREQUAL native)
  set(upwards "${upwards}/..")
endif()
set_target_properties(_perifrac PROPERTIES
  INSTALL_RPATH "${upwards}/${perifrac_own_libraries}")
target_link_options(_perifrac PRIVATE -Wl,--disable-new-dtags)

function(perifrac_install_python component destination)
  install(DIRECTORY python/perifrac DESTINATION ${destination} COMPONENT ${component} ${ARGN}
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  install(TARGETS _perifrac LIBRARY DESTINATION ${destination}/${extension_folder}
          COMPONENT ${component} ${ARGN})
endfunction()
perifrac_install_python(python lib/python3/dist-packages)
perifrac_install_python(python_folder lib/python EXCLUDE_FROM_ALL)
install(DIRECTORY python/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/python COMPONENT python
        PATTERN __pycache__ EXCLUDE)
