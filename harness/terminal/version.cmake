# Writes version.cpp: the release and, in a git checkout, the commit. Configures again when the commit changes.
set(SEIFBED_VERSION ${PROJECT_VERSION})
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --absolute-git-dir
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE git_dir ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(commit)
    set(SEIFBED_VERSION "${PROJECT_VERSION} (${commit})")
  endif()
  foreach(file HEAD logs/HEAD)
    if(git_dir AND EXISTS ${git_dir}/${file})
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${git_dir}/${file})
    endif()
  endforeach()
endif()
configure_file(terminal/version.cpp.in version.cpp @ONLY)
