# Writes report_world.cpp: worlds/report2002.yaml as a text of the program. Configures again when it changes.
set(report2002 ${PROJECT_SOURCE_DIR}/worlds/report2002.yaml)
file(READ ${report2002} REPORT2002_YAML)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${report2002})
configure_file(paper/report_world.cpp.in report_world.cpp @ONLY)
