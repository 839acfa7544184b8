# The target `doxygen`: the reference of the public headers as HTML in the build folder. A warning is
# an error, so that the documentation stays in step with the code.
find_program(DOXYGEN doxygen)
if(NOT DOXYGEN OR NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
msc_vo_include_closure(headers "${MSC_VO_PUBLIC_HEADERS}")
list(TRANSFORM headers PREPEND "${PROJECT_SOURCE_DIR}/")
list(JOIN headers " \\\n  " DOXYGEN_INPUT)
configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
add_custom_target(doxygen COMMAND ${DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile
                  COMMENT "API reference in ${PROJECT_BINARY_DIR}/doxygen/html" VERBATIM)
