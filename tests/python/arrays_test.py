"""Arrays of other byte orders, layouts and kinds: each is read right or refused by name."""
import unittest

import numpy as np

import msc_vo
import support

NUM_IMAGES = 6


def unaligned(array):
    """The same array at an odd address."""
    buffer = np.zeros(array.nbytes + 1, np.uint8)
    moved = buffer[1:].view(array.dtype).reshape(array.shape)
    moved[...] = array
    return moved


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


class Foreign:
    """An object of another library that NumPy converts."""

    def __init__(self, array, **attributes):
        self.array = array
        self.__dict__.update(attributes)

    def __array__(self, dtype=None, copy=None):
        return self.array.copy()


def swapped(array):
    return array.astype(array.dtype.newbyteorder())


# What leaves the numbers as they are.
SAME = {"swapped": swapped, "unaligned": unaligned, "read_only": read_only, "foreign": Foreign,
        "unmasked": np.ma.masked_array, "memory": lambda a: np.ndarray(a.shape, a.dtype, memoryview(a.copy()))}
# What leaves them, and changes their layout.
LAYOUTS = {"reversed": lambda a: a[::-1, ::-1].copy()[::-1, ::-1],
           "columns": np.asfortranarray,
           "strided": lambda a: np.repeat(a, 2, axis=0)[::2],
           "swapped_strided": lambda a: np.repeat(swapped(a), 2, axis=0)[::2]}


class Images(unittest.TestCase):
    def poses(self, gray=lambda a: a, depth=lambda a: a, timestamp=float, scale=None):
        odometry, poses = support.room_odometry(), []
        for image in support.room_images()[:NUM_IMAGES]:
            z = image.depth
            if scale is not None:
                z = np.rint(z * scale).astype(np.uint16)
            poses.append(odometry.process(timestamp(image.timestamp), gray(image.gray), depth(z),
                                          depth_scale=scale).cam_from_world)
        return np.array(poses)

    def test_the_same_numbers_give_the_same_poses(self):
        raw_scale = support.room().depth_scale
        for scale in (None, raw_scale, np.float32(raw_scale), np.array(raw_scale, ">f8"), int(raw_scale)):
            expected = self.poses(scale=scale)
            for name, change in SAME.items():
                with self.subTest(change=name, scale=scale):
                    np.testing.assert_array_equal(self.poses(depth=change, scale=scale), expected)
        for name, change in SAME.items():
            with self.subTest(change=name):
                np.testing.assert_array_equal(self.poses(gray=change), expected)
                np.testing.assert_array_equal(
                    self.poses(gray=lambda a, c=change: c(np.stack([a] * 3, axis=2))), expected)

    def test_masked_depth_is_not_measured(self):
        def zeros(z):
            return np.where(z > 2.0, 0, z).astype(z.dtype)

        def masked(z):
            return np.ma.masked_where(z > 2.0, z)

        expected = self.poses(depth=zeros)
        self.assertFalse(np.array_equal(expected, self.poses()))
        np.testing.assert_array_equal(self.poses(depth=masked), expected)
        np.testing.assert_array_equal(self.poses(depth=lambda z: masked(swapped(z))), expected)

    def test_other_layouts_are_right_or_refused(self):
        expected = self.poses()
        for name, change in LAYOUTS.items():
            for argument in ("gray", "depth"):
                with self.subTest(change=name, argument=argument):
                    try:
                        found = self.poses(**{argument: change})
                    except ValueError as error:
                        self.assertRegex(str(error), f"{argument}: .*ascontiguousarray")
                    else:
                        np.testing.assert_array_equal(found, expected)

    def test_other_kinds_are_refused_by_name(self):
        image = support.room_images()[0]

        def refuse(message, gray=image.gray, depth=image.depth, **arguments):
            with self.assertRaisesRegex(ValueError, message):
                support.room_odometry().process(1.0, gray, depth, **arguments)

        for kind in (np.float16, np.float64, np.longdouble, np.int16, np.int32, np.uint8, np.uint32, bool,
                     np.complex64, object, "U8"):
            with self.subTest(kind=kind):
                refuse("^depth: must be float32", depth=image.depth.astype(kind))
                refuse("^depth: must be float32", depth=image.depth.astype(kind), depth_scale=1000.0)
        for kind in (np.int8, np.uint16, np.float32, bool, object):
            with self.subTest(kind=kind):
                refuse("^gray: must be uint8, is", gray=image.gray.astype(kind))
        refuse("^gray: has masked elements", gray=np.ma.masked_equal(image.gray, image.gray[0, 0]))
        refuse("^depth: has a unit", depth=Foreign(image.depth, unit="mm"))
        refuse("^depth: .*records|^depth: must be float32",
               depth=image.depth.view([("z", np.float32)]))

    def test_impossible_depth_scales_are_refused_with_the_right_one(self):
        units = np.rint(support.room_images()[0].depth * 1000).astype(np.uint16)
        gray = support.room_images()[0].gray
        for scale, message in ((0.001, "1000 units per metre"), (np.float32(0.001), "1000 units per metre"),
                               (0.0002, "5000 units per metre"), (1.0, "1000 units per metre"),
                               (2.0 ** 60, "10 to 100000"), (0.0, "10 to 100000"), (-1000.0, "10 to"),
                               (np.nan, "10 to"), (np.inf, "10 to"),
                               (np.array([1000.0, 1000.0]), "expected a number"),
                               (np.ma.masked, "has masked"), ("1000", "expected")):
            with self.subTest(scale=scale), self.assertRaisesRegex(ValueError, "^depth_scale.*" + message):
                support.room_odometry().process(1.0, gray, units, depth_scale=scale)

    def test_raw_depth_without_its_scale_is_refused(self):
        image = support.room_images()[0]
        for scale in (1000.0, 5000.0):
            with self.assertRaisesRegex(ValueError, "depth must be in metres.*1000 for millimetres"):
                support.room_odometry().process(1.0, image.gray,
                                                np.rint(image.depth * scale).astype(np.float32))


class Times(unittest.TestCase):
    def process(self, timestamp):
        image = support.room_images()[0]
        return support.room_odometry().process(timestamp, image.gray, image.depth).timestamp

    def test_numbers_of_every_kind(self):
        for stamp in (5, np.int64(5), np.uint8(5), np.float32(5), np.array(5.0, ">f8"),
                      np.array([5], ">i4")):
            with self.subTest(stamp=repr(stamp)):
                self.assertEqual(self.process(stamp), 5.0)
        self.assertEqual(self.process(np.array(1305031102.175304, ">f8")), 1305031102.175304)

    def test_what_is_no_time_or_rounds_it_is_refused(self):
        for stamp, message in ((np.float32(1305031102.175304), "rounds"), (np.float16(1000.1), "rounds"),
                               (np.array(1305031102.1, ">f4"), "rounds"), (np.ma.masked, "masked"),
                               (np.datetime64(5, "ns"), "expected a number"),
                               (np.timedelta64(5, "s"), "expected a number"), (np.complex64(5), "expected a number"),
                               (np.array([1.0, 2.0]), "expected a number"), ("5", "expected a number"),
                               (Foreign(np.array(5.0), unit="ms"), "unit")):
            with self.subTest(stamp=repr(stamp)), self.assertRaisesRegex(ValueError, "^timestamp: .*" + message):
                self.process(stamp)
            with self.subTest(stamp=repr(stamp)), self.assertRaisesRegex(ValueError, "^timestamp: "):
                support.room_odometry().drop(stamp)


class Trajectories(unittest.TestCase):
    def setUp(self):
        t = np.linspace(0.0, 4.0, 41)
        self.rows = np.zeros((41, 8))
        self.rows[:, 0] = 1000.0 + t
        self.rows[:, 1:4] = np.stack([np.cos(t), np.sin(t), 0.1 * t], axis=1)
        self.rows[:, 7] = 1.0
        self.moved = self.rows.copy()
        self.moved[:, 1] += 0.25 * t ** 2

    def error(self, change):
        return msc_vo.evaluate(change(self.rows), change(self.moved)).ape.rmse

    def test_the_same_numbers_give_the_same_error(self):
        expected = self.error(lambda rows: rows)
        for name, change in {**SAME, **LAYOUTS, "list": lambda rows: rows.tolist(), "matrix": np.matrix,
                             "unsorted": lambda rows: np.random.default_rng(1).permutation(rows)}.items():
            with self.subTest(change=name):
                self.assertAlmostEqual(self.error(change), expected, places=12)
        self.assertAlmostEqual(self.error(lambda rows: rows.astype(">f4")), expected, places=5)

    def test_rows_without_a_pose_are_left_out(self):
        self.moved[:5, 1:] = np.nan
        self.assertEqual(msc_vo.evaluate(self.rows, self.moved).num_matched, 36)
        for column in (0, 2, 7):
            broken = self.rows.copy()
            broken[7, column] = np.nan
            with self.assertWarnsRegex(UserWarning, "^est: 1 row with nan"):
                self.assertEqual(msc_vo.evaluate(self.rows, broken).num_matched, 40)

    def test_what_would_be_misread_is_refused(self):
        masked = np.ma.masked_array(self.rows, self.rows > 1003.0)
        for est, message in ((masked, "masked"), (list(masked), "masked"), (self.rows.astype(np.complex128), "numbers"),
                             (self.rows.astype("U9"), "numbers"), (self.rows > 0, "numbers"),
                             (Foreign(self.rows, units="mm"), "unit")):
            with self.subTest(message=message), self.assertRaisesRegex(ValueError, "^est: .*" + message):
                msc_vo.evaluate(self.rows, est)
        for kind in (np.float32, ">f4", np.float16):
            late = self.rows.copy()
            late[:, 0] += 59000.0
            with self.subTest(kind=kind), self.assertRaisesRegex(ValueError, "^gt: .*rounds"):
                msc_vo.evaluate(late.astype(kind), late)


class Windows(unittest.TestCase):
    def setUp(self):
        self.camera = msc_vo.Camera(525.0, 525.0, 319.5, 239.5, 640, 480)

    def filled(self, change):
        window = msc_vo.WindowData(self.camera)
        poses = np.stack([np.eye(4)] * 3)
        poses[:, 0, 3] = [0.0, 0.1, 0.2]
        points = np.arange(12.0).reshape(4, 3) + 1.0
        window.add_keyframes(change(np.arange(3)), change(poses), change(np.array([True, False, False])))
        window.add_points(change(np.arange(4)), change(points))
        window.add_lines(change(np.arange(2)), change(np.arange(12.0).reshape(2, 6)))
        window.add_point_observations(change(np.arange(3)), change(np.arange(3)),
                                      change(np.arange(6.0).reshape(3, 2)), change(np.array([1.0, 2.0, 3.0])))
        covariances = np.stack([np.eye(2)] * 2) * 1e-4
        window.add_line_observations(change(np.arange(2)), change(np.arange(2)),
                                     change(np.arange(8.0).reshape(2, 4)), 1.0,
                                     change(np.full((2, 2), 0.5)), change(covariances))
        window.add_parallel_pairs(change(np.array([0])), change(np.array([1])), 0.03, change(np.array([4])))
        path = "window.txt"
        msc_vo.write_window(path, window)
        with open(path) as file:
            return file.read()

    def test_the_same_numbers_give_the_same_window(self):
        expected = self.filled(lambda a: a)
        one_axis = {name: change for name, change in SAME.items()}
        one_axis["reversed"] = lambda a: a[::-1].copy()[::-1]
        one_axis["columns"] = np.asfortranarray
        one_axis["list"] = lambda a: a.tolist()
        for name, change in one_axis.items():
            with self.subTest(change=name):
                self.assertEqual(self.filled(change), expected)

    def test_what_would_be_misread_is_refused(self):
        window = msc_vo.WindowData(self.camera)
        points = np.ones((2, 3))
        for ids, message in ((np.array([0, 2 ** 63], np.uint64), "64 bits"), (np.array([0.0, 1.0]), "whole"),
                             (np.ma.masked_array([0, 1], [False, True]), "masked"), ([0, 2 ** 70], "whole")):
            with self.subTest(message=message), self.assertRaisesRegex(ValueError, "^ids: .*" + message):
                window.add_points(ids, points)
        with self.assertRaisesRegex(ValueError, "^positions: .*masked"):
            window.add_points([0, 1], [np.ma.masked_array(row, [False, True, False]) for row in points])
        with self.assertRaisesRegex(ValueError, "^cam_from_world.*masked"):
            window.add_keyframes([0], np.ma.masked_equal(np.eye(4)[None], 1.0))
        with self.assertRaisesRegex(ValueError, "^counts: 4294967297 must be"):
            window.add_parallel_pairs([0], [1], counts=[2 ** 32 + 1])
        self.assertEqual(len(window.point_ids), 0)

    def test_results_of_cost_functions(self):
        def cost(change):
            return msc_vo.CostFunction(lambda x: (change(2.0 * x), [change(2.0 * np.eye(2))]), 2, [2])

        for name, change in SAME.items():
            with self.subTest(change=name):
                residuals, jacobians = cost(change).evaluate([1.0, 3.0])
                np.testing.assert_array_equal(residuals, [2.0, 6.0])
                np.testing.assert_array_equal(jacobians[0], 2.0 * np.eye(2))
        for change in (lambda a: a.astype(complex), lambda a: a.astype("U9"), lambda a: np.ma.masked_equal(a, 2.0)):
            with self.assertRaisesRegex(ValueError, "^cost function: residuals"):
                cost(change).evaluate([1.0, 3.0])


if __name__ == "__main__":
    unittest.main()
