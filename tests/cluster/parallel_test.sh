#!/usr/bin/env bash
# The line for GNU parallel in docs/cluster.md: parallel_test.sh MSC_VO SOURCE_DIR. Exit status 77: skipped.
command=$1
source_dir=$2
if [[ $(parallel --version 2> /dev/null) != *"GNU parallel"* ]]; then
  echo "skipped: GNU parallel is not installed"
  exit 77
fi
source "$source_dir/tests/cluster/prepare.sh"
trap 'rm -rf "$folder"' EXIT
line=$(grep '^parallel --jobs' "$source_dir/docs/cluster.md")
PATH=$(dirname "$command"):$PATH
export PARALLEL_HOME=$folder/parallel
mkdir "$PARALLEL_HOME"
touch "$PARALLEL_HOME/will-cite"
eval "${line/--quiet/--quiet --modes pl-vo}"
check_merged
