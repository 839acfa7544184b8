#!/usr/bin/env python3
"""Errors of a trajectory by their definitions, as the program evo computes them, written with numpy
only. Both files are in TUM format with the same time stamps.

    reference_errors.py TRUTH ESTIMATE se3|sim3|origin|none DELTA frames|metres|seconds consecutive|all
"""
import json
import sys

import numpy as np


def read(path):
    rows = np.loadtxt(path)
    poses = []
    for _, tx, ty, tz, x, y, z, w in rows:
        pose = np.eye(4)
        pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
        pose[:3, 3] = tx, ty, tz
        poses.append(pose)
    return rows[:, 0], poses


def umeyama(x, y, with_scale):
    """The similarity y = c R x + t of Umeyama 1991; rows are points."""
    mean_x, mean_y = x.mean(0), y.mean(0)
    covariance = (y - mean_y).T @ (x - mean_x) / len(x)
    u, d, vt = np.linalg.svd(covariance)
    s = np.eye(3)
    if np.linalg.det(u) * np.linalg.det(vt) < 0:
        s[2, 2] = -1
    r = u @ s @ vt
    c = np.trace(np.diag(d) @ s) / ((x - mean_x) ** 2).sum(1).mean() if with_scale else 1.0
    return r, mean_y - c * r @ mean_x, c


def align(truth, estimate, mode):
    scale = 1.0
    transform = np.eye(4)
    if mode in ("se3", "sim3"):
        points = [np.array([pose[:3, 3] for pose in poses]) for poses in (estimate, truth)]
        transform[:3, :3], transform[:3, 3], scale = umeyama(*points, mode == "sim3")
    elif mode == "origin":
        transform = truth[0] @ np.linalg.inv(estimate[0])
    aligned = []
    for pose in estimate:
        scaled = pose.copy()
        scaled[:3, 3] *= scale
        aligned.append(transform @ scaled)
    return aligned, scale


def pairs(stamps, poses, delta, unit, all_pairs):
    n = len(poses)
    if unit == "frames":
        step = int(delta)
        starts = range(n) if all_pairs else range(0, n, step)
        return [(i, i + step) for i in starts if i + step < n]
    if unit == "seconds":
        result, i = [], 0
        while i < n - 1:
            j = i + 1 + int(np.argmin(np.abs(stamps[i + 1:] - stamps[i] - delta)))
            close = abs(stamps[j] - stamps[i] - delta) <= 0.02
            if close:
                result.append((i, j))
            i = j if close and not all_pairs else i + 1
        return result
    steps = [0.0] + [np.linalg.norm(b[:3, 3] - a[:3, 3]) for a, b in zip(poses, poses[1:])]
    if not all_pairs:
        ends, travelled = [], 0.0
        for i, step in enumerate(steps):
            travelled += step
            if travelled >= delta:
                ends.append(i)
                travelled = 0.0
        return list(zip(ends, ends[1:]))
    path = np.cumsum(steps)
    result = []
    for i in range(n - 1):
        j = i + 1 + int(np.argmin(np.abs(path[i + 1:] - path[i] - delta)))
        if abs(path[j] - path[i] - delta) <= 0.1 * delta:
            result.append((i, j))
    return result


def angle(rotation):
    """Degrees; accurate for small angles, unlike the arc cosine of the trace."""
    axis = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0],
                     rotation[1, 0] - rotation[0, 1]])
    return np.degrees(np.arctan2(np.linalg.norm(axis), np.trace(rotation) - 1))


def statistics(errors):
    errors = np.array(errors)
    return {"rmse": np.sqrt(np.mean(errors ** 2)), "mean": errors.mean(),
            "median": np.median(errors), "std": errors.std(), "min": errors.min(),
            "max": errors.max(), "sse": np.sum(errors ** 2)}


def main():
    truth_path, estimate_path, mode, delta, unit, selection = sys.argv[1:]
    stamps, truth = read(truth_path)
    _, estimate = read(estimate_path)
    estimate, scale = align(truth, estimate, mode)
    relative = []
    for i, j in pairs(stamps, estimate, float(delta), unit, selection == "all"):
        truth_motion = np.linalg.inv(truth[i]) @ truth[j]
        motion = np.linalg.inv(estimate[i]) @ estimate[j]
        relative.append(np.linalg.inv(truth_motion) @ motion)
    errors = [np.linalg.norm(a[:3, 3] - b[:3, 3]) for a, b in zip(truth, estimate)]
    print(json.dumps({
        "ape": statistics(errors), "scale": scale, "pairs": len(relative),
        "rpe": statistics([np.linalg.norm(e[:3, 3]) for e in relative]),
        "rpe_deg": statistics([angle(e[:3, :3]) for e in relative])}))


if __name__ == "__main__":
    main()
