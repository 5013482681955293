# What `cmake --install` puts where. The components are the library of filters and the program.
include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/seifbed)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/seifbedConfig.cmake.in seifbedConfig.cmake
  INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(seifbedConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/seifbedConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/seifbedConfigVersion.cmake
  DESTINATION ${config_folder} COMPONENT seif)

install(TARGETS seif EXPORT seif COMPONENT seif FILE_SET HEADERS COMPONENT seif)
install(EXPORT seif FILE seifbed-seif.cmake NAMESPACE seifbed:: DESTINATION ${config_folder} COMPONENT seif)

if(SEIFBED_PYTHON)
  if(SKBUILD)  # pip
    install(TARGETS _seifbed DESTINATION seifbed COMPONENT python)
  else()
    set(site lib/python3/dist-packages)
    install(TARGETS _seifbed DESTINATION ${site}/seifbed COMPONENT python)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/python/seifbed DESTINATION ${site} COMPONENT python
      FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  endif()
endif()

if(SEIFBED_TESTBED)
  set_target_properties(seifbed PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")  # for BUILD_SHARED_LIBS
  install(TARGETS seifbed EXPORT program COMPONENT program)
  install(EXPORT program FILE seifbed-program.cmake NAMESPACE seifbed:: DESTINATION ${config_folder} COMPONENT program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/worlds/ DESTINATION ${CMAKE_INSTALL_DATADIR}/seifbed/worlds COMPONENT program
    FILES_MATCHING PATTERN *.yaml)
  if(TARGET peers)
    install(TARGETS peers mrpt_filter DESTINATION ${CMAKE_INSTALL_LIBDIR}/seifbed COMPONENT program)
  endif()
  # The program writes its own man page and completion.
  set(share "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}")
  install(CODE "
    file(MAKE_DIRECTORY \"${share}/man/man1\" \"${share}/bash-completion/completions\")
    execute_process(COMMAND \"$<TARGET_FILE:seifbed>\" man
      OUTPUT_FILE \"${share}/man/man1/seifbed.1\" COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND \"$<TARGET_FILE:seifbed>\" completion bash
      OUTPUT_FILE \"${share}/bash-completion/completions/seifbed\" COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT program)
endif()
