# Writes live_page_files.cpp: the files of page/ as strings. Configures again when one of them changes. Each script is a
# string of its own, because compilers limit the length of one.
set(page_folder ${CMAKE_CURRENT_LIST_DIR}/page)
file(READ ${page_folder}/page.html LIVE_HTML)
file(READ ${page_folder}/page.css LIVE_CSS)
file(GLOB scripts CONFIGURE_DEPENDS ${page_folder}/*.js)
list(SORT scripts)
set(LIVE_SCRIPTS "")
foreach(script ${scripts})
  file(READ ${script} text)
  string(APPEND LIVE_SCRIPTS "  script += R\"~page~(${text})~page~\";\n")
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_folder}/page.html ${page_folder}/page.css ${scripts})
configure_file(${CMAKE_CURRENT_LIST_DIR}/live_page_files.cpp.in live/live_page_files.cpp @ONLY)
