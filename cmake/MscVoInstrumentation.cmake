# Sanitizers and coverage, for everything that is built here; CMakePresets.json uses both.
# Instrumented libraries link only into instrumented programs.
set(MSC_VO_SANITIZE "" CACHE STRING
    "Sanitizers to build with, as for -fsanitize: address,undefined or thread; empty: none")
option(MSC_VO_COVERAGE "Count the lines that the tests execute, for gcov" OFF)

if(MSC_VO_SANITIZE)
  # Recovering from undefined behaviour would let a test pass that meets it.
  set(flags -fsanitize=${MSC_VO_SANITIZE} -fno-sanitize-recover=all)
  # GCC 12 takes Eigen's fixed-size matrices for uninitialized where they are instrumented.
  add_compile_options(${flags} -fno-omit-frame-pointer -Wno-error=maybe-uninitialized)
  add_link_options(${flags})
endif()
if(MSC_VO_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
