# What `cmake --install` puts where, and what CPack makes packages of: a Debian package and a folder
# that runs from anywhere, which brings its libraries along.
include(GNUInstallDirs)

# --- The program ---------------------------------------------------------------------------------
# Libraries that are brought along are found from the program, and those that they need too.
set(perifrac_own_libraries ${CMAKE_INSTALL_LIBDIR}/perifrac/shared)
set_target_properties(perifrac PROPERTIES
  BUILD_WITH_INSTALL_RPATH OFF
  INSTALL_RPATH "$ORIGIN/../../../${perifrac_own_libraries}")
target_link_options(perifrac PRIVATE -Wl,--disable-new-dtags)
if(PERIFRAC_NATIVE)
  set(perifrac_set native)
elseif(PERIFRAC_INSTRUCTIONS)
  set(perifrac_set ${PERIFRAC_INSTRUCTIONS})
else()
  set(perifrac_set x86-64)
endif()

if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64 AND NOT PERIFRAC_NATIVE)
  # One build an instruction set, and a small program that chooses among them (decision 24).
  install(TARGETS perifrac RUNTIME DESTINATION libexec/perifrac/${perifrac_set} COMPONENT set)
  add_executable(perifrac_launcher app/launcher/launcher.cpp)
  target_compile_options(perifrac_launcher PRIVATE -Wall -Wextra -Wshadow -Wconversion)
  target_link_options(perifrac_launcher PRIVATE -static-libstdc++ -static-libgcc -s)
  # Named so when it is installed only: ninja would take it for the target `perifrac`.
  install(PROGRAMS $<TARGET_FILE:perifrac_launcher> DESTINATION ${CMAKE_INSTALL_BINDIR}
          RENAME perifrac COMPONENT program)
else()
  set_target_properties(perifrac PROPERTIES INSTALL_RPATH "$ORIGIN/../${perifrac_own_libraries}")
  install(TARGETS perifrac RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
endif()

include(ExternalProject)
foreach(set ${PERIFRAC_SETS})
  set(tree ${CMAKE_BINARY_DIR}-${set})
  ExternalProject_Add(perifrac_${set}
    SOURCE_DIR ${PROJECT_SOURCE_DIR}
    BINARY_DIR ${tree}
    PREFIX ${CMAKE_BINARY_DIR}/sets/${set}
    CMAKE_ARGS -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DPERIFRAC_NATIVE=OFF
               -DPERIFRAC_INSTRUCTIONS=${set} -DPERIFRAC_CHOLMOD=${PERIFRAC_CHOLMOD}
               -DPERIFRAC_TESTS=OFF -DPERIFRAC_PYTHON=${PERIFRAC_PYTHON} -DCMAKE_INSTALL_PREFIX=${CMAKE_INSTALL_PREFIX}
               -DCMAKE_DISABLE_PRECOMPILE_HEADERS=${CMAKE_DISABLE_PRECOMPILE_HEADERS}
    BUILD_COMMAND ${CMAKE_COMMAND} --build ${tree} --target perifrac $<$<BOOL:${PERIFRAC_PYTHON}>:_perifrac>
    INSTALL_COMMAND "" BUILD_ALWAYS ON)
  foreach(component set python python_folder)
    set(only_by_name)
    if(component STREQUAL python_folder)
      set(only_by_name EXCLUDE_FROM_ALL)
    endif()
    install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" -E env --unset=DESTDIR
                                          \"${CMAKE_COMMAND}\" --install \"${tree}\" --component ${component}
                                          --prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\" \${perifrac_strip}
                                  COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component} ${only_by_name})
  endforeach()
endforeach()

# --- What the program reads, and what its users read -----------------------------------------------
set(share ${CMAKE_INSTALL_DATADIR}/perifrac)
install(DIRECTORY configs DESTINATION ${share} COMPONENT program)
install(DIRECTORY app/writing/templates DESTINATION ${share}/app/writing COMPONENT program)
install(DIRECTORY docs/example_module docs/example_material docs/mesh_to_points DESTINATION ${share}/docs COMPONENT program)
install(DIRECTORY app/report DESTINATION ${share}/app COMPONENT program
        PATTERN "*.?pp" EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN README.md EXCLUDE)
install(DIRECTORY app/study/drawing DESTINATION ${share}/app/study COMPONENT program
        PATTERN __pycache__ EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
        PATTERN __pycache__ EXCLUDE PATTERN "*.py" EXCLUDE)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)

# The program itself writes these from its command line. gzip -n: the same bytes at any time.
set(pages ${CMAKE_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages})
add_custom_command(
  OUTPUT ${pages}/perifrac.1.gz ${pages}/perifrac ${pages}/_perifrac ${pages}/perifrac.fish
  COMMAND perifrac man > ${pages}/perifrac.1
  COMMAND gzip -9nf ${pages}/perifrac.1
  COMMAND perifrac completion bash > ${pages}/perifrac
  COMMAND perifrac completion zsh > ${pages}/_perifrac
  COMMAND perifrac completion fish > ${pages}/perifrac.fish
  DEPENDS perifrac VERBATIM)
add_custom_target(perifrac_pages DEPENDS ${pages}/perifrac.1.gz)
install(FILES ${pages}/perifrac.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${pages}/perifrac
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${pages}/_perifrac
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${pages}/perifrac.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)

# --- Libraries and headers, for modules outside this tree ------------------------------------------
install(TARGETS perifrac_options perifrac_core perifrac_modules perifrac_coupling perifrac_app
        EXPORT perifracTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/perifrac COMPONENT development)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/perifrac)
install(EXPORT perifracTargets NAMESPACE perifrac:: DESTINATION ${config_folder}
        COMPONENT development)
foreach(folder core modules coupling app ${CMAKE_BINARY_DIR}/core)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/perifrac
          COMPONENT development FILES_MATCHING PATTERN "*.hpp" PATTERN CMakeFiles EXCLUDE)
endforeach()
install(FILES tests/contract/module_contract.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/perifrac/tests/contract COMPONENT development)
include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/perifracConfig.cmake.in ${CMAKE_BINARY_DIR}/perifracConfig.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/perifracConfigVersion.cmake
                                 COMPATIBILITY ExactVersion)
configure_file(cmake/perifracModule.cmake.in ${CMAKE_BINARY_DIR}/perifracModule.cmake @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/perifracConfig.cmake ${CMAKE_BINARY_DIR}/perifracModule.cmake
              ${CMAKE_BINARY_DIR}/perifracConfigVersion.cmake
        DESTINATION ${config_folder} COMPONENT development)

# --- Libraries of others, for the folder that runs from anywhere -------------------------------------
# All but those of the C library, which belong to the system's loader; and the units of udunits.
install(CODE "set(own_libraries \"${perifrac_own_libraries}\")
  set(share \"${share}\")
  set(program \"$<TARGET_FILE:perifrac>\")" COMPONENT libraries)
install(SCRIPT cmake/bring_libraries.cmake COMPONENT libraries)

if(PERIFRAC_PYTHON)
  include(cmake/install_python.cmake)
endif()
include(cmake/package.cmake)
