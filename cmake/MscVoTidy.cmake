# The target `tidy`: clang-tidy 14 with the checks of .clang-tidy over the library and the command.
# Any finding is an error.
find_program(RUN_CLANG_TIDY run-clang-tidy-14)
if(NOT RUN_CLANG_TIDY OR NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
add_custom_target(tidy
  COMMAND ${RUN_CLANG_TIDY} -quiet -p ${PROJECT_BINARY_DIR} "^${PROJECT_SOURCE_DIR}/(msc_vo|apps/cli)/"
  COMMENT "clang-tidy over msc_vo/ and apps/cli/" VERBATIM)
