# Fails unless the standard output of a command is the content of a file.
#
#   cmake -DFILE=path "-DCOMMAND=program;argument;..." -P compare_output.cmake
execute_process(COMMAND ${COMMAND} OUTPUT_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the command failed: ${COMMAND}")
endif()
file(READ ${FILE} content)
if(NOT output STREQUAL content)
  list(JOIN COMMAND " " command)
  message(FATAL_ERROR "${FILE} is out of date; write it with: ${command} > ${FILE}")
endif()
