#!/usr/bin/env python3
"""Compares two files of msc_vo benchmark: exit status 1 unless their runs are equal but for times.

    same_results.py ONE.json OTHER.json
"""
import json
import sys

MACHINE = {"stages_ms", "wall_seconds", "frames_per_second", "processor_seconds", "peak_memory_mib"}


def runs(path):
    with open(path, encoding="utf-8") as file:
        results = json.load(file)
    kept = [{key: value for key, value in run.items() if key not in MACHINE}
            for run in results["runs"]]
    return kept, results["geometric_mean"], results["modes"], results["changed_options"]


def main():
    one, other = runs(sys.argv[1]), runs(sys.argv[2])
    if not one[0]:
        sys.exit(f"{sys.argv[1]} has no runs")
    for a, b in zip(one[0], other[0]):
        if a != b:
            differing = [key for key in a if a[key] != b.get(key)]
            sys.exit(f"{a['sequence']}, {a['mode']}: {differing} differ")
    if one != other:
        sys.exit("the numbers of runs, the means or the settings differ")
    print(f"{len(one[0])} equal runs")


if __name__ == "__main__":
    main()
