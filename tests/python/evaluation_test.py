import json
import subprocess
import unittest
import warnings

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
    def test_what_makes_errors_doubtful(self):
        straight, still = path(), path()
        straight[:, 1:4] = straight[:, :1] * [1, 2, 3]
        still[:, 1:4] = 1.0
        with self.assertWarnsRegex(UserWarning, "straight line"):
            error = msc_vo.evaluate(straight, straight)
        self.assertEqual(len(error.warnings), 1)
        for gt, est, name in [(still, path(), "reference"), (path(), still, "estimate")]:
            with self.assertRaisesRegex(ValueError, f"of the {name} are the same"):
                msc_vo.evaluate(gt, est, align="sim3")
            with self.assertWarnsRegex(UserWarning, f"of the {name} are the same"):
                msc_vo.evaluate(gt, est)
        longer = path()
        longer[:, 1:4] *= 5.0
        with self.assertWarnsRegex(UserWarning, "reference path is 5.0 times as long"):
            msc_vo.evaluate(longer, path())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(msc_vo.evaluate(path(), path()).warnings, [])

    def test_files_in_other_formats(self):
        rows = path()
        euroc = np.column_stack([rows[:, 0] * 1e9, rows[:, 1:4], rows[:, 7], rows[:, 4:7]])
        np.savetxt("euroc.csv", euroc, delimiter=",", header="timestamp [ns],x,y,z,qw,qx,qy,qz")
        self.assertLess(msc_vo.evaluate("euroc.csv", rows).ape.max, 1e-9)
        kitti = np.tile([1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], (101, 1))
        kitti[:, 3::4] = rows[:, 1:4]
        np.savetxt("kitti.txt", kitti)
        self.assertLess(msc_vo.evaluate(rows, "kitti.txt").ape.max, 1e-9)

    def test_rows_that_are_not_finite_are_left_out_as_those_of_files(self):
        broken = path()
        broken[3, 2] = np.nan
        broken[50, 0] = np.inf
        broken[70, 1:] = np.nan  # a frame without a pose
        np.savetxt("broken.txt", np.delete(broken, 70, axis=0))
        for est in (broken, "broken.txt"):
            with self.assertWarnsRegex(UserWarning, "est: 2 rows with nan"):
                error = msc_vo.evaluate(path(), est)
            self.assertEqual((error.num_estimate, error.num_matched), (98, 98))
            self.assertEqual(len(error.warnings), 1)
        with self.assertWarnsRegex(UserWarning, "gt: 2 rows"):
            self.assertEqual(msc_vo.evaluate(broken, path()).num_reference, 98)

    def test_stamps_in_other_units_are_converted_as_those_of_files(self):
        for factor, unit in [(1e3, "milliseconds"), (1e6, "microseconds"), (1e9, "nanoseconds")]:
            other = path()
            other[:, 0] *= factor
            np.savetxt("other.txt", other)
            for est in (other, "other.txt"):
                with self.assertWarnsRegex(UserWarning, f"est: the time stamps are {unit}"):
                    error = msc_vo.evaluate(path(), est)
                self.assertEqual(error.num_matched, 101)
                self.assertAlmostEqual(error.per_pose[-1, 0], 10.0)
                with self.assertWarnsRegex(UserWarning, f"gt: the time stamps are {unit}"):
                    self.assertEqual(msc_vo.evaluate(est, path()).num_matched, 101)

    def test_other_clocks_are_asked_about(self):
        later = path()
        later[:, 0] += 1e6
        with self.assertRaisesRegex(ValueError, "three are needed; are the time stamps of both in"):
            msc_vo.evaluate(path(), later)

    def test_wrong_options_are_named_alone(self):
        for options, problem in [({"rpe_delta": -1}, "rpe_delta: must be a whole number"),
                                 ({"rpe_delta": 1.5}, "rpe_delta: must be a whole number"),
                                 ({"rpe_delta": 0.0, "rpe_unit": "metres"}, "rpe_delta: must be p"),
                                 ({"max_dt": -1.0}, "max_dt: must not be negative"),
                                 ({"max_dt": np.nan}, "max_dt: must not be negative")]:
            with self.assertRaisesRegex(ValueError, "^" + problem):
                msc_vo.evaluate(path(), path(), **options)

    def test_equal_stamps_go_in_order(self):
        rows = path()
        rows[:, 0] = np.floor(rows[:, 0] / 0.5) * 0.5
        error = msc_vo.evaluate(rows, rows)
        self.assertEqual(error.num_matched, 101)
        self.assertLess(error.ape.max, 1e-9)

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
