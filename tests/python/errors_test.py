"""Errors are in the terms of Python: names of arguments, types of NumPy, sizes as width x height."""
import os
import pathlib
import shutil
import tempfile
import unittest

import numpy as np

import msc_vo
import support

# Words of the code behind the module.
FOREIGN = r"OpenCV|CV_\d|FrameBuilder|Eigen|std::|::|\bcv\b|pybind11|PYBIND11|C\+\+|\bk[A-Z][a-z]+\b"


def calls():
    """Wrong calls, and what their messages must contain."""
    gray, depth = np.zeros((480, 640), np.uint8), np.ones((480, 640), np.float32)
    odometry, camera = support.room_odometry(), support.room().camera
    pose, covariance = np.eye(4), np.eye(6)
    window = msc_vo.WindowData(camera)
    solved, _ = msc_vo.read_window(support.WINDOWS / "room.txt")
    rows = support.room_result().trajectory
    cost = msc_vo.pose_prior(pose, covariance)
    registration = msc_vo.DepthRegistration(msc_vo.DepthCamera(camera, pose), camera)

    def process(g=gray, d=depth, t=1.0, **arguments):
        return lambda: odometry.process(t, g, d, **arguments)

    def with_factors(setter, factors):
        def run():
            running = support.room_odometry(threads=1)
            getattr(running, setter)(lambda context: factors)
            support.process(running, support.room_images()[:16])
            running.finish()
        return run

    def solve(factor):
        def run():
            copy, options = msc_vo.read_window(support.WINDOWS / "room.txt")
            copy.add([factor])
            msc_vo.solve_window(copy, options)
        return run

    def with_cost(function, numeric=False):
        made = msc_vo.CostFunction(function, 1, [7], numeric)
        return solve(msc_vo.CustomFactor(made, [msc_vo.BlockId.pose(solved.keyframe_ids[~solved.keyframe_fixed][0])]))

    yield process(g=gray[:240]), "gray: image is 640x240, camera is 640x480"
    yield process(g=np.zeros((480, 641, 3), np.uint8)), "gray: image is 641x480, camera is 640x480"
    yield process(d=np.ones((240, 320), np.float32)), "depth: image is 320x240, camera is 640x480"
    yield process(g=gray.astype(np.float32)), "gray: must be uint8, is float32"
    yield process(g=np.zeros((480, 640, 4), np.uint8)), r"gray: must be of shape .* is \(480, 640, 4\) of uint8"
    yield process(d=depth.astype(float)), "depth: must be float32 in metres, or uint16 .*, is float64"
    yield process(d=np.ones((480, 640, 1), np.float32)), r"depth: must be of shape .* is \(480, 640, 1\)"
    yield process(d=np.ones((480, 640), np.uint16)), "depth: uint16 needs depth_scale"
    yield process(d=depth, depth_scale=1000), "depth_scale is for uint16"
    yield process(g=None), "gray: "
    yield process(g="image.png"), "gray: "
    yield process(d=[[1.0]]), "depth: must be float32"
    yield process(mask=gray.astype(bool)), "mask: must be uint8, is bool"
    yield process(mask=np.zeros((480, 640, 3), np.uint8)), r"mask: must be of shape \(height, width\), is \(480, 640, 3\)"
    yield process(t="now"), "timestamp: expected a number"
    yield process(t=float("nan")), "time stamp must be a finite number"
    yield process(t=1.7e18), r"time stamp 1.7e\+18 must be in seconds: .* nanoseconds by 1e9"
    yield process(depth_delay="late"), "depth_delay: expected a number"
    yield process(depth_delay=5.0), "depth_delay = 5 must be from -1 to 1 seconds"
    yield lambda: odometry.drop("now"), "timestamp: expected a number"
    yield lambda: odometry.drop(1.0, "tracked"), "status: must be 'dropped' or 'unreadable'"
    yield lambda: msc_vo.Camera(0, 1, 1, 1, 640, 480), "fx"
    yield lambda: msc_vo.Camera(500, 500, 1, 1, 0, 480), "width"
    yield lambda: msc_vo.Lens("fish", [1, 2, 3, 4]), "unknown model 'fish'"
    yield lambda: msc_vo.Odometry(None, camera, [0.1]), "distortion: expected k1 k2 p1 p2"
    yield lambda: msc_vo.Odometry(None, camera, "none"), "distortion: expected numbers"
    yield lambda: msc_vo.Options(mode=3), "mode must be one of"
    yield lambda: msc_vo.evaluate(rows, rows[:, :7]), r"est: expected shape \(N, 8\)"
    yield lambda: msc_vo.evaluate(rows, None), "est: "
    yield lambda: msc_vo.evaluate(rows, rows, align="scale"), "alignment must be"
    yield lambda: msc_vo.evaluate(rows, rows, max_dt=-1.0), "max_dt"
    yield lambda: window.add_keyframes([0], [pose, pose]), "ids: expected shape"
    yield lambda: window.add_keyframes([0.5], [pose]), "ids: expected whole numbers"
    yield lambda: window.add_keyframes([0], [np.diag([2.0, 2.0, 2.0, 1.0])]), r"cam_from_world\[0\]: the upper left"
    yield lambda: window.add_points([0], [[1, 2]]), r"positions: expected shape \(N, 3\)"
    yield lambda: window.add_points([0], [[1, 2, 3]], fixed=[1]), "fixed: expected 1 truth values"
    yield lambda: window.add_line_observations([0], [0], [[0, 0, 1, 1]], inverse_depths=[[1, 1]]), "give both"
    yield lambda: window.add(5), "items: expected CustomFactor and ExtraBlock objects, not 5"
    yield lambda: window.add([5]), "items: expected CustomFactor and ExtraBlock objects, not 5"
    yield lambda: msc_vo.solve_window(window), "keyframe"
    yield lambda: msc_vo.pose_prior(pose, -covariance), "covariance: "
    yield lambda: msc_vo.gravity_direction([0, 0, 0], 0.1), "direction: must not be zero"
    yield lambda: msc_vo.gravity_direction([0, 0, 1], 0.0), "sigma: must be positive"
    yield lambda: msc_vo.PoseFactor(cost, huber=-1.0), "huber: must be positive"
    yield lambda: msc_vo.ExtraBlock(0, [1.0], "torus"), "manifold: must be"
    yield lambda: msc_vo.ExtraBlock(0, [0.0, 0.0, 9.81], "sphere"), "value: not a unit vector"
    yield lambda: msc_vo.CostFunction(print, 0, [1]), "num_residuals and every block size must be positive"
    yield lambda: cost.evaluate([1, 2]), r"block 0: expected shape \(7,\)"
    yield lambda: registration.register(depth[:240]), "depth: image is 640x240, depth camera is 640x480"
    yield lambda: registration.register(1500 + np.indices(depth.shape, np.float32)[0]), "whole numbers, up to 1972"
    yield lambda: msc_vo.set_log_level("loud"), "level: must be one of"
    yield with_factors("set_pose_factors", 5), "pose factors: expected PoseFactor objects, not 5"
    yield with_factors("set_pose_factors", [cost]), "pose factors: expected PoseFactor objects, not <"
    yield with_factors("set_window_factors", 5), "window factors: expected CustomFactor and ExtraBlock objects, not 5"
    yield with_cost(lambda pose: 1.0), "cost function: expected the tuple"
    yield with_cost(lambda pose: ([1.0], 2.0)), "cost function: Jacobians: expected a list"
    yield with_cost(lambda pose: ([1.0], [[1.0]])), r"cost function: Jacobian 0: expected shape \(1, 7\)"
    yield with_cost(lambda pose: [1.0, 2.0], numeric=True), r"cost function: residuals: expected shape \(1,\)"
    yield with_cost(lambda pose: "x", numeric=True), "cost function: residuals: expected numbers"


class Errors(unittest.TestCase):
    def test_are_in_the_terms_of_python(self):
        for number, (call, expected) in enumerate(calls()):
            with self.subTest(number=number, expected=expected):
                with self.assertRaisesRegex(ValueError, expected) as raised:
                    call()
                self.assertNotRegex(str(raised.exception), FOREIGN)

    def test_arguments_of_another_type_are_type_errors(self):
        camera = support.room().camera
        for call in (lambda: msc_vo.Camera("wide", 1, 1, 1, 640, 480),
                     lambda: msc_vo.Odometry({"mode": "pl-vo"}, camera),
                     lambda: msc_vo.Odometry(None, 5), lambda: msc_vo.solve_window(None),
                     lambda: msc_vo.window_covariance(None), lambda: msc_vo.write_window("file", None),
                     lambda: msc_vo.BlockId.pose("first"), lambda: msc_vo.Sequence(5),
                     lambda: msc_vo.DepthCamera(None, np.eye(4)), lambda: msc_vo.read_window(5),
                     lambda: support.room()["first"], lambda: msc_vo.replay(5)):
            with self.assertRaises(TypeError) as raised:
                call()
            self.assertNotRegex(str(raised.exception), FOREIGN)

    def test_objects_are_not_used_before_they_are_initialised(self):
        window, _ = msc_vo.read_window(support.WINDOWS / "room.txt")
        classes = [kind for kind in vars(msc_vo).values() if isinstance(kind, type(msc_vo.Odometry))]
        self.assertGreater(len(classes), 20)
        for kind in classes:
            for name, member in vars(kind).items():
                if isinstance(member, property):
                    with self.subTest(kind=kind.__name__, name=name), self.assertRaisesRegex(TypeError, "initialised"):
                        getattr(kind.__new__(kind), name)
        for call in (lambda: len(msc_vo.Sequence.__new__(msc_vo.Sequence)),
                     lambda: msc_vo.Odometry.__new__(msc_vo.Odometry).finish(),
                     lambda: msc_vo.write_window("file", msc_vo.WindowData.__new__(msc_vo.WindowData)),
                     lambda: window.add([msc_vo.CustomFactor.__new__(msc_vo.CustomFactor)])):
            with self.assertRaisesRegex(TypeError, "initialised"):
                call()

    def test_paths_need_not_be_utf8(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(os.fsencode(folder), b"\xff")
            for name in (path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))):
                for call in (msc_vo.Sequence, msc_vo.read_window, msc_vo.Options.read, msc_vo.map_images):
                    with self.assertRaises(RuntimeError) as raised:
                        call(name)
                    self.assertIn(os.fsdecode(path), str(raised.exception))
            shutil.copytree(os.fsencode(support.ROOM), path)
            sequence = msc_vo.Sequence(path)
            self.assertEqual(sequence.directory, os.fsdecode(path))
            self.assertIn(os.fsdecode(path), repr(sequence))
            os.truncate(sorted(pathlib.Path(os.fsdecode(path), "rgb").iterdir())[3], 100)
            with self.assertRaises(msc_vo.UnreadableImage) as raised:
                sequence[3]
            self.assertIn(os.fsdecode(path), str(raised.exception))
        with self.assertRaisesRegex(ValueError, "null"):
            msc_vo.Sequence("folder\0")


if __name__ == "__main__":
    unittest.main()
