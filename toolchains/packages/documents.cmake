# What there is to read: READMEs of the source tree (pack_documents), licence, and what make_pages makes (manual pages, changelogs), where it has run.
set(documents share/doc)
get_property(installed GLOBAL PROPERTY EARSHOT_INSTALLED)
file(WRITE ${PROJECT_BINARY_DIR}/installed.txt "${installed}")
set(packed ${CMAKE_CURRENT_BINARY_DIR}/documents)
install(CODE "execute_process(COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/pack_documents ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/installed.txt ${packed} COMMAND_ERROR_IS_FATAL ANY)"
        COMPONENT runtime)
install(DIRECTORY ${packed}/ DESTINATION ${documents}/earshot COMPONENT runtime)

foreach(component runtime sil tools hil dev)
  set(package earshot-${component})
  if(component STREQUAL runtime)
    set(package earshot)
  endif()
  install(FILES copyright DESTINATION ${documents}/${package} COMPONENT ${component})
  install(DIRECTORY ${PROJECT_BINARY_DIR}/pages/${component}/ DESTINATION share COMPONENT ${component} OPTIONAL)
endforeach()
