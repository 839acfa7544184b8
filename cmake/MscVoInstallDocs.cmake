# Installs the documentation so that its links resolve: the documents and what they link to, examples that
# build with the installed package, and public headers where they are installed. Links to files that are
# not installed become plain text.

# Writes a document, whose links begin with `up` to the root of the source tree, to the build tree.
function(msc_vo_installed_document document up)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${document})
  file(READ ${PROJECT_SOURCE_DIR}/${document} text)
  string(REPLACE . "\\." up_pattern "${up}")
  msc_vo_include_closure(headers "${MSC_VO_PUBLIC_HEADERS}")
  cmake_path(GET document PARENT_PATH folder)
  msc_vo_installed_path(includes ${CMAKE_INSTALL_DOCDIR}/${folder} ${CMAKE_INSTALL_INCLUDEDIR})
  string(REGEX MATCHALL "${up_pattern}msc_vo/[a-z0-9_/]+\\.h" links "${text}")
  list(REMOVE_DUPLICATES links)
  foreach(link ${links})
    string(REGEX MATCH "msc_vo/[a-z0-9_/]+\\.h$" header ${link})
    if(header IN_LIST headers)
      string(REPLACE "(${link})" "(${includes}/${header})" text "${text}")
    endif()
  endforeach()
  string(REGEX REPLACE "\\[([^]]*)\\]\\(${up_pattern}(tests|cmake|msc_vo|apps/python)/[^)]*\\)" "\\1"
         text "${text}")
  file(WRITE ${PROJECT_BINARY_DIR}/installed/${document} "${text}")
endfunction()

# Call once, after all public headers are known.
function(msc_vo_install_documents)
  file(GLOB documents RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS docs/*.md docs/lab/*.md)
  foreach(document README.md CHANGELOG.md CONTRIBUTING.md)
    msc_vo_installed_document(${document} "")
  endforeach()
  foreach(document ${documents} data/README.md)
    string(REGEX REPLACE "[^/]+/" "../" up ${document})
    string(REGEX REPLACE "[^/]+$" "" up ${up})
    msc_vo_installed_document(${document} ${up})
  endforeach()
  install(DIRECTORY ${PROJECT_BINARY_DIR}/installed/ DESTINATION ${CMAKE_INSTALL_DOCDIR}
          COMPONENT command)
  install(FILES CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
  install(DIRECTORY docs/images DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT command
          PATTERN *.py EXCLUDE)
  install(DIRECTORY data/benchmarks data/cameras DESTINATION ${CMAKE_INSTALL_DOCDIR}/data COMPONENT command)
  install(PROGRAMS data/make_room.sh DESTINATION ${CMAKE_INSTALL_DOCDIR}/data COMPONENT command)
  install(DIRECTORY apps/cluster apps/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/apps
          COMPONENT command)
endfunction()
