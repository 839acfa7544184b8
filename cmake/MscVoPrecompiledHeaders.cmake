# Precompiled headers of other libraries, which most source files include. Only targets with the same
# compiler options can share one, so there is one for each kind of target:
#   library  position-independent code; the standard library, Eigen, OpenCV's core
#   program  the same for programs
#   test     the same for tests, with GoogleTest
# They would hide an include that a header lacks: cmake/check_headers.py looks for these by name, and the
# preset clang-shared compiles every public header without them.
option(MSC_VO_PRECOMPILE_HEADERS "Precompile the headers of other libraries" ${PROJECT_IS_TOP_LEVEL})
if(MSC_VO_PRECOMPILE_HEADERS)
  find_package(OpenCV 4.5 REQUIRED COMPONENTS core)
endif()

# msc_vo_precompiled_headers(<kind> [OPTIONS option ...] [HEADERS header ...] [DEPENDS target ...]):
# declares a kind, with headers that it has in addition to cmake/precompiled.h.
function(msc_vo_precompiled_headers kind)
  if(NOT MSC_VO_PRECOMPILE_HEADERS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "OPTIONS;HEADERS;DEPENDS" ${ARGN})
  set(target msc_vo_precompiled_${kind})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}.cc)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Holds the precompiled headers of a kind of target.\n")
  add_library(${target} OBJECT ${source})
  msc_vo_compile_options(${target})
  target_compile_options(${target} PRIVATE ${ARG_OPTIONS})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # The same bytes in every build, for ccache.
    target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
  target_link_libraries(${target} PRIVATE Eigen3::Eigen opencv_core ${ARG_DEPENDS})
  target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h ${ARG_HEADERS})
  if(kind STREQUAL library)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
endfunction()

# Lets a target use the precompiled headers of its kind.
function(msc_vo_use_precompiled_headers target kind)
  if(TARGET msc_vo_precompiled_${kind})
    target_precompile_headers(${target} REUSE_FROM msc_vo_precompiled_${kind})
  endif()
endfunction()
