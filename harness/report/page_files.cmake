# Writes page_files.cpp: page.html, page.css and page.js as strings. Configures again when one of them changes.
foreach(file page.html page.css page.js)
  string(TOUPPER ${file} name)
  string(REPLACE "." "_" name ${name})
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${file} ${name})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/${file})
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/page_files.cpp.in report/page_files.cpp @ONLY)
