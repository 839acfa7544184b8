"""Values can be pickled, copied and compared, and keep everything that they have."""
import copy
import inspect
import pathlib
import pickle
import tempfile
import unittest

import numpy as np

import msc_vo
import support

# Handles of running code and of the memory of a run, and views that are valid during a call.
NO_VALUES = {"Sequence", "Odometry", "Localizer", "DepthRegistration", "CostFunction", "CustomFactor",
             "PoseFactor", "TrackedImage", "Map", "WindowContext", "UnreadableImage"}
MUTABLE = {"Options", "WindowOptions", "WindowData"}


def camera(**changes):
    return msc_vo.Camera(**{**dict(fx=525.0, fy=526.0, cx=319.5, cy=239.5, width=640, height=480), **changes})


def depth_camera(x=0.05):
    pose = np.eye(4)
    pose[0, 3] = x
    return msc_vo.DepthCamera(camera(width=320), pose, [0.01, 0.0, 0.0, 0.0], 0.001)


def masked_image(masked):
    """The first image of the room with a mask of the pixels where `masked` is true."""
    pixels = np.where(masked, 255, 0).astype(np.uint8)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "mask.pgm")
        path.write_bytes(b"P5 640 480 255\n" + pixels.tobytes())
        return msc_vo.Sequence(support.ROOM, mask=path)[0]


def window():
    made, _ = msc_vo.read_window(support.WINDOWS / "room.txt")
    made.set_axes(np.eye(3))
    made.add_pose_prior(made.keyframe_ids[0], np.eye(4), np.eye(6))
    made.add([msc_vo.ExtraBlock(1, [0.0, 0.0, 1.0], "sphere", True), msc_vo.ExtraBlock(2, [0.5])])
    return made


def contexts():
    found = {}
    odometry = support.room_odometry(threads=1)

    def keep(name):
        return lambda context: found.setdefault(name, []).append(context)

    odometry.set_window_factors(keep("WindowContext"))
    odometry.set_pose_factors(keep("FrameContext"))
    support.process(odometry, support.room_images())
    found["WindowKeyframe"] = found.pop("WindowContext")[-1].keyframes
    return {name: (values[0], values[-1]) for name, values in found.items()}


def examples():
    """Two different values of every class."""
    result = support.room_result()
    odometry = support.room_odometry()
    support.process(odometry, support.room_images()[:4])
    short = odometry.finish()
    errors = [msc_vo.evaluate(support.room().groundtruth, rows)
              for rows in (result.trajectory, result.trajectory[:30])]
    solved = window()
    summaries = [msc_vo.solve_window(solved) for _ in range(2)]
    return {
        "Camera": (camera(), camera(cy=240.0)),
        "Lens": (msc_vo.Lens("fisheye", [0.1, 0, 0, 0]),
                 msc_vo.undistorted_camera(camera(), msc_vo.Lens("fisheye", [0.1, 0, 0, 0]), 80.0)[1]),
        "DepthCamera": (depth_camera(), depth_camera(0.06)),
        "Options": (msc_vo.Options(mode="pl-vo", **{"mapping.readout_time": 0.02}), msc_vo.Options()),
        "WindowOptions": (msc_vo.WindowOptions(first_iterations=3), msc_vo.WindowOptions()),
        "RgbdImage": (support.room()[0], support.room()[1]),
        "FrameResult": (result.frames[5], result.frames[6]),
        "Result": (result, short),
        "CalibrationEstimate": (result.calibration, short.calibration),
        "BlockId": (msc_vo.BlockId.pose(3), msc_vo.BlockId.point(3)),
        "ExtraBlock": (msc_vo.ExtraBlock(1, [0.0, 0.0, 1.0], "sphere"), msc_vo.ExtraBlock(1, [0.0, 0.0, 1.0])),
        "ErrorStatistics": (errors[0].ape, errors[1].ape),
        "RelativeError": (errors[0].rpe, errors[1].rpe),
        "TrajectoryError": tuple(errors),
        "WindowData": (window(), solved),
        "WindowSummary": tuple(summaries),
        **contexts(),
    }


def properties(value):
    """Everything that can be read of a value, in a form that compares."""
    if isinstance(value, dict):
        return {name: properties(item) for name, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [properties(item) for item in value]
    if isinstance(value, np.ndarray):
        return value.shape, str(value.dtype), value.tobytes()
    if type(value).__module__.startswith("msc_vo"):
        if hasattr(value, "keys"):
            return dict(value)
        return {name: properties(getattr(value, name)) for name, _ in
                inspect.getmembers(type(value), lambda member: isinstance(member, property))}
    return value


class Values(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.examples = examples()

    def test_every_class_has_examples(self):
        classes = {name for name, value in vars(msc_vo).items() if isinstance(value, type)}
        self.assertEqual(set(self.examples) | NO_VALUES, classes)

    def test_copies_are_equal_and_have_everything(self):
        copies = {"pickle": lambda value: pickle.loads(pickle.dumps(value)), "copy": copy.copy,
                  "deepcopy": copy.deepcopy, "old pickle": lambda value: pickle.loads(pickle.dumps(value, 2))}
        for name, values in self.examples.items():
            for way, make in copies.items():
                for value in values:
                    with self.subTest(name=name, way=way):
                        made = make(value)
                        self.assertIsNot(made, value)
                        self.assertIs(type(made), type(value))
                        self.assertEqual(made, value)
                        self.assertFalse(made != value)
                        self.assertEqual(properties(made), properties(value))

    def test_others_differ(self):
        for name, (a, b) in self.examples.items():
            with self.subTest(name=name):
                self.assertNotEqual(a, b)
                self.assertFalse(a == b)
                self.assertNotEqual(a, "something else")
                self.assertNotEqual(a, None)

    def test_only_what_does_not_change_has_a_hash(self):
        for name, (a, b) in self.examples.items():
            with self.subTest(name=name):
                if name in MUTABLE:
                    with self.assertRaises(TypeError):
                        hash(a)
                else:
                    self.assertEqual(hash(copy.copy(a)), hash(a))
                    self.assertEqual(len({a, copy.copy(a), b}), 2)

    def test_every_number_of_a_camera_counts(self):
        for name, value in dict(fx=500.0, fy=500.0, cx=300.0, cy=200.0, width=639, height=479).items():
            self.assertNotEqual(camera(), camera(**{name: value}), name)
        self.assertEqual(camera(cx=0.0), camera(cx=-0.0))

    def test_the_mask_of_an_image_counts(self):
        plain = support.room()[0]
        # Depth is removed where the mask is, so that these images differ in their masks only.
        masked = masked_image(plain.depth == 0.0)
        with_zeros = masked_image(np.zeros_like(plain.depth))
        self.assertGreater(masked.mask.max(), 0)
        for image in (plain, masked, with_zeros):
            np.testing.assert_array_equal(image.depth, plain.depth)
            for made in (pickle.loads(pickle.dumps(image)), copy.copy(image), copy.deepcopy(image)):
                self.assertEqual(made, image)
                self.assertEqual(properties(made), properties(image))
        self.assertEqual(len({plain, masked, with_zeros}), 3)

    def test_a_copy_does_not_follow(self):
        for value in (msc_vo.Options(), msc_vo.WindowOptions()):
            made = copy.deepcopy(value)
            name = next(name for name in made if isinstance(made[name], int) and made[name] > 1)
            made[name] += 1
            self.assertNotEqual(made, value)
        original = window()
        made = copy.copy(original)
        made.set_keyframe_fixed(made.keyframe_ids[-1], not made.keyframe_fixed[-1])
        self.assertNotEqual(made, original)

    def test_equal_runs_are_equal(self):
        def run():
            odometry = support.room_odometry()
            support.process(odometry, support.room_images()[:6])
            return odometry.finish()

        a, b = run(), run()
        self.assertNotEqual(a.frames[3].times, b.frames[3].times)
        self.assertEqual(a, b)
        self.assertEqual(a.frames, b.frames)
        self.assertEqual(hash(a), hash(b))

    def test_code_is_not_pickled(self):
        made = window()
        cost = msc_vo.CostFunction(lambda x: x, 1, [1], numeric=True)
        made.add([msc_vo.CustomFactor(cost, [msc_vo.BlockId.extra(2)])])
        self.assertEqual(copy.copy(made), made)
        self.assertNotEqual(window(), made)
        with self.assertRaisesRegex(TypeError, "custom factors"):
            pickle.dumps(made)
        for value in (cost, support.room(), support.room_odometry()):
            with self.assertRaisesRegex(TypeError, "pickle"):
                pickle.dumps(value)

    def test_other_versions_are_named(self):
        function, arguments, state = support.room_result().frames[0].__reduce_ex__(2)[:3]
        self.assertEqual(state[0], msc_vo.__version__)
        with self.assertRaisesRegex(ValueError, "pickled by msc_vo 0.0.1"):
            function(*arguments).__setstate__(("0.0.1", state[1]))
        with self.assertRaises(RuntimeError):
            function(*arguments).__setstate__((state[0], state[1][:-1]))


if __name__ == "__main__":
    unittest.main()
