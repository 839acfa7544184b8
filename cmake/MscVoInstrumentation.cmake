# Sanitizers and coverage, for everything that is built here; CMakePresets.json uses both.
# Instrumented libraries link only into instrumented programs.
set(MSC_VO_SANITIZE "" CACHE STRING
    "Sanitizers to build with, as for -fsanitize: address,undefined or thread; empty: none")
option(MSC_VO_COVERAGE "Count the lines that the tests execute, for gcov" OFF)
option(MSC_VO_BUILD_FUZZERS "Build the targets of tests/fuzz for libFuzzer; needs Clang" OFF)

if(MSC_VO_SANITIZE)
  # Recovering from undefined behaviour would let a test pass that meets it.
  set(flags -fsanitize=${MSC_VO_SANITIZE} -fno-sanitize-recover=all)
  add_compile_options(${flags} -fno-omit-frame-pointer)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 takes Eigen's fixed-size matrices for uninitialized where they are instrumented.
    add_compile_options(-Wno-error=maybe-uninitialized)
  endif()
  add_link_options(${flags})
  if(MSC_VO_SANITIZE MATCHES address)
    # Eigen would align memory by itself then, and could not free what Ceres has allocated.
    add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
endif()
if(MSC_VO_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
if(MSC_VO_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "MSC_VO_BUILD_FUZZERS needs Clang: configure with --preset fuzz")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)  # counts the branches, which guides the mutations
endif()
