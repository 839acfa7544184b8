# Sourced by the tests of docs/cluster.md, which set `command` (the program msc_vo) and `source_dir`.
# Changes to a temporary folder with four short sequences, sequences.txt and `expected`, the results of one
# program.
set -euo pipefail
folder=$(mktemp --directory)
cd "$folder"
for i in 1 2 3 4; do
  "$command" synthesize "room_$i" --seed "$i" --frames 6 --width 160 2> /dev/null
  echo "room_$i" >> sequences.txt
done
"$command" benchmark sequences.txt --modes pl-vo --quiet --output expected

# Joins the shares in `out` and compares them with one program.
check_merged() {
  "$command" benchmark --merge out --output out > /dev/null
  "$source_dir/tests/cluster/same_results.py" expected/benchmark.json out/benchmark.json
  for i in 1 2 3 4; do
    grep --quiet "href=\"room_$i/pl-vo/report.html\"" out/index.html
  done
}
