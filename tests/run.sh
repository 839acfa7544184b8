#!/usr/bin/env bash
# Builds everything into ./build and runs every test. On Debian and Ubuntu it first installs missing packages.
#
#   tests/run.sh                       everything
#   tests/run.sh --sanitize address    the tests under AddressSanitizer and UndefinedBehaviorSanitizer,
#                                      in ./build-address
#   tests/run.sh --sanitize readers    of these, only the fuzz targets of the readers of sequences
#   tests/run.sh --sanitize thread     the tests that start threads under ThreadSanitizer, in
#                                      ./build-thread
#   tests/run.sh --sanitize pipeline   of these, only those of mapping beside tracking
#   tests/run.sh --preset debug        everything, in ./build-debug with assertions
#   tests/run.sh --preset clang-shared everything, in ./build-clang-shared with Clang and shared libraries
#
# Environment: JOBS, the number of parallel processes (default: one per processor); TESTS, a regular
# expression of folders for --sanitize address and thread ("odometry|text"; default: all that it covers); LIMIT,
# seconds in which everything should be done (default: none): tests that can be left out do not begin in the last
# eight minutes of them.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

# Test programs with threads: mapping beside tracking, reading ahead, the live view, shared recordings.
threaded='odometry|datasets|live|ros_bag|apps'
# Tests that link or preload libraries that are not instrumented.
not_instrumented='^(consumer|free_ceres|python)\.'

sanitize=
preset=
case "$#:$*" in
  0:) ;;
  2:--sanitize\ address | 2:--sanitize\ readers | 2:--sanitize\ thread | 2:--sanitize\ pipeline)
    sanitize=$2
    ;;
  2:--preset\ debug | 2:--preset\ clang-shared)
    preset=$2
    ;;
  *)
    echo "usage: tests/run.sh [--sanitize address|readers|thread|pipeline | --preset debug|clang-shared]" >&2
    exit 2
    ;;
esac

step=none
begin() {
  step=$1
  printf '\n== %s (%d s)\n' "$step" "$SECONDS"
}
summary() {
  local status=$?
  if [[ $status -eq 0 ]]; then
    printf '\ntests/run.sh: everything passed in %d s\n' "$SECONDS"
  else
    printf '\ntests/run.sh: FAILED in step "%s" after %d s\n' "$step" "$SECONDS" >&2
  fi
}
trap summary EXIT

# test_sanitized SANITIZER PRESET EXPRESSION TARGET...: builds the targets with the flags of a preset
# (CMakePresets.json) and runs the tests whose names fit the expression.
test_sanitized() {
  local folder=build-$1 preset=$2 expression=$3
  shift 3
  begin "configure $folder"
  cmake --preset "$preset" -B "$folder"
  begin "build $folder"
  cmake --build "$folder" --parallel "$jobs" --target "$@"
  begin "test $folder"
  ASAN_OPTIONS=abort_on_error=1 UBSAN_OPTIONS=print_stacktrace=1 \
    TSAN_OPTIONS="suppressions=$PWD/cmake/tsan_suppressions.txt" \
    ctest --test-dir "$folder" --parallel "$jobs" --output-on-failure --no-tests=error \
          --tests-regex "$expression" --exclude-regex "$not_instrumented"
}

# Names of the build targets of test programs.
targets_of() { echo "$1" | tr '|' '\n' | sed 's/$/_test/'; }

begin "packages"
lists=(report optional developer tests)
if [[ $preset == clang-shared ]]; then lists+=(clang); fi
cmake/install_packages.sh "${lists[@]}"
case $sanitize in
  address)
    if [[ -n ${TESTS:-} ]]; then
      test_sanitized address asan-ubsan "^($TESTS)\." $(targets_of "$TESTS")
    else
      test_sanitized address asan-ubsan '.*' all
    fi
    ;;
  readers)
    readers='image_lists|associations|trajectory|camera_file|accelerometer|image_names|images'
    test_sanitized address asan-ubsan "^fuzz\.($readers)$|^text\." \
                   $(echo "$readers" | tr '|' '\n' | sed 's/^/fuzz_/') text_test
    ;;
  thread)
    test_sanitized thread tsan "^(${TESTS:-$threaded})\." $(targets_of "${TESTS:-$threaded}")
    ;;
  pipeline)
    pipeline='.*RunnerTest\.|SideWorkers|SnapshotSchedule.*|SegmentsTest\.AreTheSameAtAnyThreadCount'
    test_sanitized thread tsan "^odometry\.($pipeline)" odometry_test
    ;;
  *)
    preset=${preset:-release}
    folder=build-$preset
    if [[ $preset == release ]]; then folder=build; fi
    begin "configure"
    options=()
    # Compiles several files of the library at a time, as apps/demo.sh does.
    if [[ $preset == release && ! -f build/CMakeCache.txt ]]; then options+=(-DCMAKE_UNITY_BUILD=ON); fi
    cmake --preset "$preset" "${options[@]}"
    begin "build"
    cmake --build "$folder" --parallel "$jobs"
    begin "test"
    if [[ -n ${LIMIT:-} ]]; then
      left=$((LIMIT - SECONDS))
      printf '%d of %d s are left\n' "$left" "$LIMIT"
      export MSC_VO_TESTS_DEADLINE=$(($(date +%s) + left - 480))
    fi
    ctest --test-dir "$folder" --parallel "$jobs" --output-on-failure --no-tests=error
    grep '^left out for lack of time' "$folder/Testing/Temporary/LastTest.log" || true
    ;;
esac
