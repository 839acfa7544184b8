# Manual pages and bash completion of the command, generated from its own declarations and installed
# with it. Pages are compressed where gzip is found, as Debian wants them.
set(pages ${PROJECT_BINARY_DIR}/man)
set(completion ${PROJECT_BINARY_DIR}/completion/msc_vo)
find_program(GZIP gzip)
set(compress)
if(GZIP)
  set(compress COMMAND sh -c "${GZIP} -9 -n '${pages}'/*.1")
endif()
add_custom_command(
  OUTPUT ${completion}
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
  COMMAND msc_vo_command generate man ${pages}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/completion
  ${compress}
  COMMAND msc_vo_command generate completion ${completion}
  DEPENDS msc_vo_command
  COMMENT "Manual pages and bash completion" VERBATIM)
add_custom_target(msc_vo_pages ALL DEPENDS ${completion})
install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        COMPONENT command)
