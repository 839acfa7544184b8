import json
import subprocess
import unittest

import numpy as np

import msc_vo
import support


def path():
    t = np.linspace(0.0, 10.0, 101)
    rows = np.zeros((101, 8))
    rows[:, 0] = t
    rows[:, 1:4] = np.stack([np.cos(t), np.sin(t), 0.1 * t], axis=1)
    rows[:, 7] = 1.0
    return rows


class Evaluate(unittest.TestCase):
    def test_alignment(self):
        moved = path()
        moved[:, 1] += 0.5
        self.assertLess(msc_vo.evaluate(path(), moved).ape.max, 1e-9)
        self.assertAlmostEqual(msc_vo.evaluate(path(), moved, align="none").ape.rmse, 0.5)
        error = msc_vo.evaluate(path(), moved, align="origin")
        np.testing.assert_allclose(error.reference_from_estimate[:3, 3], [-0.5, 0, 0], atol=1e-9)
        self.assertEqual(error.per_pose.shape, (101, 3))
        self.assertEqual(error.coverage, 1.0)
        with self.assertRaisesRegex(ValueError, "se3, sim3, origin or none"):
            msc_vo.evaluate(path(), moved, align="scale")

    def test_agrees_with_the_command(self):
        error = msc_vo.evaluate(support.ROOM / "groundtruth.txt", support.room_result())
        again = msc_vo.evaluate(support.room().groundtruth, support.room_result().trajectory)
        self.assertAlmostEqual(error.ape.rmse, again.ape.rmse, places=12)
        self.assertLess(error.ape.rmse, 0.01)
        support.room_result().write_trajectory("evaluated.txt")
        output = subprocess.run([support.COMMAND, "evaluate", support.ROOM / "groundtruth.txt",
                                 "evaluated.txt", "--json"], check=True, capture_output=True)
        self.assertAlmostEqual(json.loads(output.stdout)["ape_rmse"], error.ape.rmse, places=7)

    def test_what_cannot_be_compared_is_an_error(self):
        with self.assertRaisesRegex(ValueError, "three are needed"):
            msc_vo.evaluate(path(), path()[:2])
        with self.assertRaisesRegex(ValueError, r"est: expected shape \(N, 8\), not \(101, 7\)"):
            msc_vo.evaluate(path(), path()[:, 1:])
        broken = path()
        broken[3, 7] = 2.0
        with self.assertRaisesRegex(ValueError, "row 3"):
            msc_vo.evaluate(path(), broken)
