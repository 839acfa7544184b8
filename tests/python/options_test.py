import unittest

import numpy as np

import msc_vo


class Options(unittest.TestCase):
    def test_sets_options_by_name_and_type(self):
        options = msc_vo.Options(mode="pl-vo",
                                 **{"features.points.num_points": np.int64(800)})
        self.assertEqual(options["mode"], "pl-vo")
        self.assertEqual(options["features.points.num_points"], 800)
        self.assertIs(options["use_lines"], True)
        options["use_lines"] = np.bool_(False)
        self.assertIs(options["use_lines"], False)

    def test_optional_numbers_can_be_unset(self):
        options = msc_vo.Options(**{"mapping.readout_time": 0.026})
        self.assertEqual(options["mapping.readout_time"], 0.026)
        options["mapping.readout_time"] = None
        self.assertIsNone(options["mapping.readout_time"])

    def test_unknown_names_and_invalid_values_are_value_errors(self):
        with self.assertRaisesRegex(ValueError, "did you mean 'features.points.num_points'"):
            msc_vo.Options(**{"features.points.num_point": 800})
        with self.assertRaisesRegex(ValueError, "num_points must be a whole number from"):
            msc_vo.Options(**{"features.points.num_points": -1})
        with self.assertRaisesRegex(ValueError, "mode must be one of pl-vo"):
            msc_vo.Options(mode="orb")
        with self.assertRaisesRegex(ValueError, "threads must be .*, not True"):
            msc_vo.Options(threads=True)
        with self.assertRaises(KeyError):
            msc_vo.Options()["unknown"]

    def test_is_a_mapping_of_all_options(self):
        options = msc_vo.Options(mode="pl-vo")
        values = dict(options)
        self.assertEqual(len(values), len(options))
        self.assertGreater(len(values), 50)
        self.assertEqual(dict(msc_vo.Options(**values)), values)
        self.assertEqual(repr(options), "Options(mode='pl-vo')")
        self.assertIn("realtime", options)

    def test_window_options_have_short_names(self):
        options = msc_vo.WindowOptions(first_iterations=3)
        self.assertEqual(options["first_iterations"], 3)
        self.assertIs(options["landmark_noise.enabled"], False)
        self.assertIn("mapping.window.first_iterations", msc_vo.Options())
        # What a run leaves at its default, and a window file holds.
        self.assertEqual(msc_vo.WindowOptions(**{"parallel.huber": 3})["parallel.huber"], 3)
        self.assertNotIn("mapping.window.parallel.huber", msc_vo.Options())
        with self.assertRaisesRegex(ValueError, "unknown option"):
            msc_vo.WindowOptions(mode="pl-vo")

    def test_cameras_are_checked(self):
        with self.assertRaises(ValueError):
            msc_vo.Camera(0.0, 525.0, 319.5, 239.5, 640, 480)
        camera = msc_vo.Camera(525.0, 526.0, 319.5, 239.5, 640, 480)
        np.testing.assert_array_equal(camera.matrix, [[525, 0, 319.5], [0, 526, 239.5], [0, 0, 1]])
        with self.assertRaisesRegex(ValueError, "distortion"):
            msc_vo.Odometry(None, camera, [0.1, 0.2, 0.3])
