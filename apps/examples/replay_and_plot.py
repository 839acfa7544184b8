#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Replays a folder and plots its trajectory and map from above: replay_and_plot.py FOLDER PLOT.png"""
import sys

import matplotlib.pyplot as plt
import msc_vo

sequence = msc_vo.Sequence(sys.argv[1])
result = msc_vo.replay(sequence, on_frame=print)
if len(sequence.groundtruth) > 0:
    error = msc_vo.evaluate(sequence.groundtruth, result)
    print(f"APE RMSE {1000 * error.ape.rmse:.2f} mm over {error.num_matched} poses")
x, z = result.lines[:, [0, 3]], result.lines[:, [2, 5]]  # of both end points
for line_x, line_z, axis in zip(x, z, result.line_axes):
    plt.plot(line_x, line_z, color=("tab:red", "tab:green", "tab:blue", "0.6")[axis])
plt.plot(result.trajectory[:, 1], result.trajectory[:, 3], color="black", linewidth=2)
plt.gca().set(aspect="equal", xlabel="x, metres", ylabel="z, metres", title=sequence.directory)
plt.savefig(sys.argv[2], dpi=150)
