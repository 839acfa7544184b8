#!/usr/bin/env bash
# Names every source file that is not as clang-format 14 leaves it; other versions format
# differently. Exit status 77 (skipped) where that version is not installed.
set -euo pipefail
cd "$(dirname "$0")/.."

for clang_format in clang-format-14 clang-format ''; do
  [[ $("$clang_format" --version 2>/dev/null) == *'version 14.'* ]] && break
done
if [[ -z $clang_format ]]; then
  echo "clang-format 14 is not installed: formatting not checked"
  exit 77
fi

status=0
while read -r file; do
  if ! "$clang_format" "$file" | cmp --quiet - "$file"; then
    echo "not formatted: $clang_format -i $file"
    status=1
  fi
done < <(find msc_vo apps tests -name '*.h' -o -name '*.cc' | sort)
exit "$status"
