#!/usr/bin/env bash
# Checks that every source file is as clang-format 14 leaves it; other versions format differently.
# Exit status 77 (skipped) where that version is not installed.
set -euo pipefail
cd "$(dirname "$0")/.."

for clang_format in clang-format-14 clang-format ''; do
  [[ $("$clang_format" --version 2>/dev/null) == *'version 14.'* ]] && break
done
if [[ -z $clang_format ]]; then
  echo "clang-format 14 is not installed: formatting not checked"
  exit 77
fi
find msc_vo apps tests \( -name '*.h' -o -name '*.cc' \) -print0 | sort -z |
  xargs -0 "$clang_format" --dry-run --Werror
