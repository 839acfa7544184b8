#!/usr/bin/env bash
# Fuzzes the readers and solvers with libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer
# (docs/reliability.md). Builds the targets into ./build-fuzz with clang++-14.
#
#   tests/fuzz/run.sh [SECONDS | --runs N] [TARGET...]     60 seconds of every target by default
#
# Inputs that reach new code are kept in build-fuzz/corpus/TARGET and used by the next run; an input
# with a finding is written to build-fuzz/findings. Environment: JOBS, the number of parallel
# processes (default: one per processor).
set -euo pipefail
cd "$(dirname "$0")/../.."
jobs=${JOBS:-$(nproc)}

limit=-max_total_time=60
if [[ ${1:-} == --runs ]]; then
  limit=-runs=${2:?tests/fuzz/run.sh: --runs needs a number}
  shift 2
elif [[ ${1:-} =~ ^[0-9]+$ ]]; then
  limit=-max_total_time=$1
  shift
fi
targets=("$@")
if [[ ${#targets[@]} -eq 0 ]]; then
  for folder in tests/fuzz/corpus/*/; do targets+=("$(basename "$folder")"); done
fi
for target in "${targets[@]}"; do
  [[ -f tests/fuzz/${target}_target.cc ]] && continue
  echo "tests/fuzz/run.sh: no target '$target'; targets: $(ls tests/fuzz/corpus | xargs)" >&2
  exit 2
done

cmake --preset fuzz > /dev/null
cmake --build build-fuzz --parallel "$jobs" --target "${targets[@]/#/fuzz_}"

findings=$PWD/build-fuzz/findings
mkdir -p "$findings" build-fuzz/logs
fuzz() {
  local target=$1 limit=$2 findings=$3
  local corpus=build-fuzz/corpus/$target log=build-fuzz/logs/$target.log
  mkdir -p "$corpus"
  # Ceres reports through glog that a solver failed, which is expected here.
  if GLOG_minloglevel=3 UBSAN_OPTIONS=print_stacktrace=1 \
     "build-fuzz/tests/fuzz/fuzz_$target" "$limit" -max_len=2048 -timeout=10 -rss_limit_mb=4096 \
     -dict=tests/fuzz/tokens.dict -print_final_stats=1 -artifact_prefix="$findings/$target-" \
     "$corpus" "tests/fuzz/corpus/$target" > "$log" 2>&1; then
    printf '%-24s %12s executions, no finding\n' "$target" \
           "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
  else
    printf '%-24s FINDING, see %s\n' "$target" "$log"
    return 1
  fi
}
export -f fuzz
printf '%s\n' "${targets[@]}" |
  xargs -P "$jobs" -I TARGET bash -c "fuzz TARGET $limit '$findings'"
