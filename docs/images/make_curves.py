#!/usr/bin/env python3
"""Draws the curves of docs/reliability.md from measurements:

    soak.svg              memory and times over a long run
    honest_statuses.svg   errors of tracked frames in sigmas

    docs/images/make_curves.py --soak DIR        what tests/faults/soak.py wrote
    docs/images/make_curves.py --statuses FILE   what HonestStatus of odometry_test printed

Needs python3-matplotlib.
"""
import argparse
import csv
import math
import pathlib

import matplotlib
matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

IMAGES = pathlib.Path(__file__).resolve().parent
GREY = "#808080"  # readable on white and on black
SOAK_CURVES = {"memory_mb": "memory, MB", "tracking_ms": "tracking of an image, ms",
               "mapping_ms": "mapping of a keyframe, ms"}
BIN_WIDTH = 0.25  # sigmas


def begin(num_plots):
    matplotlib.rcParams.update({
        "svg.hashsalt": "msc_vo", "text.color": GREY, "axes.labelcolor": GREY,
        "axes.edgecolor": GREY, "xtick.color": GREY, "ytick.color": GREY, "axes.spines.top": False,
        "axes.spines.right": False, "legend.frameon": False})
    return pyplot.subplots(1, num_plots, figsize=(11, 3), constrained_layout=True)


def save(figure, name):
    figure.savefig(IMAGES / name, transparent=True, metadata={"Date": None})


def draw_soak(folder):
    figure, plots = begin(len(SOAK_CURVES))
    for scene in ("house", "room"):
        with (folder / f"{scene}.csv").open() as file:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        for plot, (name, title) in zip(plots, SOAK_CURVES.items()):
            plot.plot([row["images"] for row in rows], [row[name] for row in rows], marker=".", label=scene)
            plot.set(title=title, xlabel="images so far")
    for plot in plots:
        plot.set_ylim(bottom=0)
    plots[0].legend()
    save(figure, "soak.svg")


def expected_ratio(low, high):
    """Ratio of errors between two numbers of sigmas if the covariance is right: of the root of chi-square
    with six degrees of freedom over six."""
    def ratio_below(sigmas):
        half = 3.0 * sigmas * sigmas
        return 1.0 - math.exp(-half) * (1.0 + half + half * half / 2.0)
    return ratio_below(high) - ratio_below(low)


def draw_statuses(path):
    figure, plots = begin(2)
    begins_with = "histogram of "
    for line in path.read_text().splitlines():
        if not line.startswith(begins_with):
            continue
        worlds, _, numbers = line[len(begins_with):].partition(":")
        counts = [int(number) for number in numbers.split()]
        plot = plots[0 if worlds == "all worlds" else 1]
        lows = [BIN_WIDTH * i for i in range(len(counts))]
        plot.bar(lows, [count / sum(counts) for count in counts], BIN_WIDTH, align="edge", alpha=0.6,
                 label=f"{sum(counts)} tracked frames")
        plot.plot([low + BIN_WIDTH / 2 for low in lows[:-1]],
                  [expected_ratio(low, low + BIN_WIDTH) for low in lows[:-1]], label="expected")
        plot.set(title=worlds, xlabel="error in sigmas (last: over five)", ylabel="ratio of frames")
        plot.legend()
    save(figure, "honest_statuses.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--soak", type=pathlib.Path)
    parser.add_argument("--statuses", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.soak:
        draw_soak(arguments.soak)
    if arguments.statuses:
        draw_statuses(arguments.statuses)


if __name__ == "__main__":
    main()
