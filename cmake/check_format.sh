#!/usr/bin/env bash
# Shows every place that clang-format 14 would change; other versions format differently. With
# --fix, formats all files. Exit status 77 (skipped) if that version is not installed.
set -euo pipefail
mode=${1:-check}
if [[ $# -gt 1 || ($mode != check && $mode != --fix) ]]; then
  echo "usage: cmake/check_format.sh [--fix]" >&2
  exit 2
fi
cd "$(dirname "$0")/.."

for clang_format in clang-format-14 clang-format ''; do
  [[ $("$clang_format" --version 2>/dev/null) == *'version 14.'* ]] && break
done
if [[ -z $clang_format ]]; then
  echo "clang-format 14 is not installed (Debian 12 has it, Debian 13 has not): formatting not checked"
  exit 77
fi

mapfile -t files < <(find msc_vo apps tests -name '*.h' -o -name '*.cc' | sort)
if [[ $mode == --fix ]]; then
  exec "$clang_format" -i "${files[@]}"
fi

if ! "$clang_format" --dry-run --Werror "${files[@]}"; then
  echo "cmake/check_format.sh --fix formats all files"
  exit 1
fi
