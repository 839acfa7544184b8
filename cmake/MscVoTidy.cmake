# The target `tidy`: clang-tidy 14 with the checks of .clang-tidy over the library and the command.
# Any finding is an error.
find_program(RUN_CLANG_TIDY run-clang-tidy-14)
if(NOT RUN_CLANG_TIDY OR NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
# Without the precompiled headers and the parameters of another compiler.
set(folder ${PROJECT_BINARY_DIR}/tidy)
file(MAKE_DIRECTORY ${folder})
add_custom_target(tidy
  COMMAND sed "s/-include [^ ]*cmake_pch.hxx//; s/--param=[^ ]*//" ${PROJECT_BINARY_DIR}/compile_commands.json
          > ${folder}/compile_commands.json
  COMMAND ${RUN_CLANG_TIDY} -quiet -p ${folder} "^${PROJECT_SOURCE_DIR}/(msc_vo|apps/cli)/"
  COMMENT "clang-tidy over msc_vo/ and apps/cli/" VERBATIM)
