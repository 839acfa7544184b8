"""What a run offers beside its poses: observers, the map, checkpoints, the log."""
import logging
import pathlib
import tempfile
import unittest

import numpy as np

import msc_vo
import support


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)


class TrackingObserver(unittest.TestCase):
    def test_sees_features_and_their_landmarks(self):
        odometry, seen, kept = support.room_odometry(), [], []

        def observe(tracked):
            kept.append(tracked)
            points = tracked.map.window
            ids = tracked.point_landmarks
            seen.append((tracked.frame, len(tracked.points), len(tracked.lines), np.count_nonzero(ids >= 0),
                         np.count_nonzero(tracked.line_landmarks >= 0),
                         np.isin(ids[ids >= 0], points.point_ids).all()))
            self.assertEqual(tracked.point_depths.shape, ids.shape)
            self.assertEqual(tracked.line_depths.shape, (len(tracked.lines), 2))
            np.testing.assert_array_equal(tracked.gray, image.gray)
            np.testing.assert_array_equal(tracked.depth, image.depth)

        odometry.set_tracking_observer(observe)
        frames = []
        for image in support.room_images()[:12]:
            frames.append(odometry.process(image.timestamp, image.gray, image.depth))
        self.assertEqual([entry[0] for entry in seen], frames)
        for frame, points, lines, num_points, num_lines, are_in_map in seen:
            self.assertEqual((points, lines), (frame.num_points, frame.num_lines))
            self.assertEqual((num_points, num_lines), (frame.num_inlier_points, frame.num_inlier_lines))
            self.assertTrue(are_in_map)
        self.assertGreater(seen[-1][3], 20)
        with self.assertRaisesRegex(RuntimeError, "during the call"):
            kept[0].points

    def test_pixels_and_depths_are_those_of_the_landmarks(self):
        odometry, errors, depth_errors = support.room_odometry(), [], []

        def observe(tracked):
            landmarks = tracked.map.window
            where = {id: position for id, position in zip(landmarks.point_ids, landmarks.points)}
            pose = tracked.frame.cam_from_world
            for pixel, depth, id in zip(tracked.points, tracked.point_depths, tracked.point_landmarks):
                if id < 0:
                    continue
                x = pose[:3, :3] @ where[id] + pose[:3, 3]
                projected = support.room().camera.matrix @ (x / x[2])
                errors.append(np.hypot(*(projected[:2] - pixel)))
                if not np.isnan(depth):
                    depth_errors.append(abs(depth - x[2]) / x[2])

        odometry.set_tracking_observer(observe)
        support.process(odometry, support.room_images()[:6])
        self.assertGreater(len(errors), 100)
        self.assertLess(np.median(errors), 2.0)
        self.assertGreater(len(depth_errors), 100)
        self.assertLess(np.median(depth_errors), 0.05)


class Maps(unittest.TestCase):
    def test_is_a_window_that_can_be_solved(self):
        odometry = support.room_odometry()
        support.process(odometry, support.room_images())
        found, result = odometry.map(), odometry.finish()
        window = found.window
        self.assertEqual(len(window.points), len(result.points))
        self.assertEqual(len(window.lines), len(result.lines))
        np.testing.assert_array_equal(found.timestamps, result.keyframes[:, 0])
        observations = window.point_observations
        self.assertEqual(len(observations["points"]), result.point_observations.sum())
        self.assertEqual(set(observations["keyframes"]), set(window.keyframe_ids))
        self.assertEqual(len(window.line_observations["lines"]), result.line_observations.sum())
        np.testing.assert_allclose(found.world_from_axes, result.world_from_axes)
        window.set_keyframe_fixed(window.keyframe_ids[0])
        summary = msc_vo.solve_window(window)
        self.assertTrue(summary.usable)
        self.assertLess(np.abs(window.cam_from_world[:, :3, 3]
                               - found.window.cam_from_world[:, :3, 3]).max(), 0.02)

    def test_axes_reach_the_callbacks(self):
        for mode, found in (("msc-vo", True), ("pl-vo", False)):
            odometry, axes = support.room_odometry(mode=mode), []
            odometry.set_window_factors(lambda window: axes.append(window.world_from_axes))
            support.process(odometry, support.room_images())
            result = odometry.finish()
            self.assertEqual(axes[-1] is not None, found)
            if found:
                np.testing.assert_allclose(axes[-1] @ axes[-1].T, np.eye(3), atol=1e-9)
                np.testing.assert_allclose(axes[-1], result.world_from_axes, atol=0.02)
            else:
                self.assertIsNone(result.world_from_axes)


class Checkpoints(Scratch):
    def test_a_restored_run_continues_bit_by_bit(self):
        images = support.room_images()[:24]
        whole = support.room_odometry()
        support.process(whole, images)
        expected = whole.finish()
        for threads in (1, 2):
            first = support.room_odometry(threads=threads)
            for i, image in enumerate(images[:14]):
                support.process(first, [image])
                if i in (3, 9, 13):
                    first.save(self.folder / "run")  # the last one counts
            second = support.room_odometry(threads=3 - threads)
            second.restore(str(self.folder / "run"))
            frames = support.process(second, images[14:])
            self.assertEqual(frames[0].id, 14)
            found = second.finish()
            np.testing.assert_array_equal(found.trajectory, expected.trajectory)
            np.testing.assert_array_equal(found.lines, expected.lines)
            self.assertEqual(found.frames, expected.frames)

    def test_other_runs_are_refused(self):
        odometry = support.room_odometry()
        support.process(odometry, support.room_images()[:3])
        odometry.save(self.folder)
        with self.assertRaisesRegex(ValueError, "option mode was 'msc-vo' and is 'pl-vo' now"):
            support.room_odometry(mode="pl-vo").restore(self.folder)
        other = msc_vo.Camera(500.0, 500.0, 319.5, 239.5, 640, 480)
        refused = msc_vo.Odometry(None, other, support.room().lens)
        with self.assertRaisesRegex(ValueError, "camera was .* and is '500 500 319.5 239.5 640x480'"):
            refused.restore(self.folder)
        image = support.room_images()[0]
        with self.assertRaisesRegex(RuntimeError, "make another Odometry"):
            refused.process(image.timestamp, image.gray, image.depth)
        with self.assertRaisesRegex(ValueError, "lens was"):
            msc_vo.Odometry(None, support.room().camera, [0.1, 0, 0, 0]).restore(self.folder)
        with self.assertRaisesRegex(ValueError, "precede the first image"):
            odometry.restore(self.folder)

    def test_files_that_are_missing_or_damaged_are_named(self):
        with self.assertRaisesRegex(RuntimeError, "nowhere.*run$|nowhere"):
            support.room_odometry().restore(self.folder / "nowhere")
        odometry = support.room_odometry()
        support.process(odometry, support.room_images()[:3])
        odometry.save(self.folder)
        state = next(self.folder.glob("state.bin"))
        content = bytearray(state.read_bytes())
        content[len(content) // 2] ^= 1
        state.write_bytes(content)
        with self.assertRaisesRegex(RuntimeError, "state.bin") as raised:
            support.room_odometry().restore(self.folder)
        self.assertNotIn("--", str(raised.exception))


class Log(unittest.TestCase):
    def tearDown(self):
        msc_vo.set_log_level("off")

    def messages(self, level, threads=2):
        msc_vo.set_log_level(level)
        with self.assertLogs("msc_vo", logging.DEBUG) as log:
            logging.getLogger("msc_vo").error("one")
            odometry = support.room_odometry(threads=threads)
            support.process(odometry, support.room_images()[:8])
            odometry.process(9e9, np.zeros((480, 640), np.uint8), np.zeros((480, 640), np.float32))
            odometry.finish()
        return [record.levelname for record in log.records][1:]

    def test_goes_to_the_module_logging(self):
        for threads in (1, 2):
            levels = self.messages("debug", threads)
            self.assertLessEqual({"DEBUG", "INFO", "WARNING"}, set(levels))
            self.assertEqual(set(self.messages("warning", threads)), {"WARNING"})
            self.assertEqual(self.messages("off", threads), [])

    def test_levels_are_named(self):
        with self.assertRaisesRegex(ValueError, "'debug', 'info', 'warning', 'error', 'off', not 'all'"):
            msc_vo.set_log_level("all")


class Registration(unittest.TestCase):
    def test_a_plane_is_registered_exactly(self):
        color = msc_vo.Camera(500.0, 500.0, 319.5, 239.5, 640, 480)
        depth = msc_vo.Camera(300.0, 300.0, 159.5, 119.5, 320, 240)
        pose = np.eye(4)
        pose[0, 3] = -0.05
        registration = msc_vo.DepthRegistration(msc_vo.DepthCamera(depth, pose), color)
        plane = np.full((240, 320), 2.0, np.float32)
        registered = registration.register(plane)
        self.assertEqual((registered.shape, registered.dtype), ((480, 640), np.float32))
        inside = registered[100:380, 100:540]
        np.testing.assert_allclose(inside, 2.0, atol=1e-5)
        raw = registration.register((plane * 1000).astype(np.uint16), depth_scale=1000)
        np.testing.assert_allclose(raw, registered, atol=1e-6)
        # The same through a camera that turns: the plane z = 2 of the depth camera is not z = 2 here.
        turn = np.radians(2.0)
        pose[:3, :3] = [[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]]
        turned = msc_vo.DepthRegistration(msc_vo.DepthCamera(depth, pose), color).register(plane)
        u = np.arange(640)
        ray = np.stack([(u - 319.5) / 500.0, np.zeros(640), np.ones(640)])
        normal = pose[2, :3]
        expected = (2.0 - pose[2, 3]) / (normal @ ray)
        np.testing.assert_allclose(turned[240, 150:490], expected[150:490], rtol=1e-4)

    def test_arguments_are_checked(self):
        color, small = support.room().camera, msc_vo.Camera(300.0, 300.0, 159.5, 119.5, 320, 240)
        registration = msc_vo.DepthRegistration(msc_vo.DepthCamera(small, np.eye(4)), color)
        with self.assertRaisesRegex(ValueError, "depth: image is 640x480, depth camera is 320x240"):
            registration.register(np.zeros((480, 640), np.float32))
        with self.assertRaisesRegex(ValueError, "depth: must be float32"):
            registration.register(np.zeros((240, 320)))
        with self.assertRaisesRegex(ValueError, "depth_from_color: the upper left"):
            msc_vo.DepthCamera(small, np.diag([2.0, 2.0, 2.0, 1.0]))
        with self.assertRaisesRegex(ValueError, "distortion: expected k1"):
            msc_vo.DepthRegistration(msc_vo.DepthCamera(small, np.eye(4)), color, [0.1])
        with self.assertRaises(ValueError):
            msc_vo.DepthRegistration(msc_vo.DepthCamera(small, np.eye(4)), color, [-9.0, 0, 0, 0])


class Calibration(unittest.TestCase):
    def test_the_result_has_what_was_used(self):
        result = support.room_result()
        self.assertEqual(result.camera, support.room().camera)
        self.assertEqual(result.lens, support.room().lens)
        self.assertEqual(result.depth_camera.camera, support.room().camera)
        self.assertEqual(set(result.calibration.is_corrected.values()), {False})
        self.assertEqual(set(result.calibration.is_corrected), set(result.calibration.log_odds))
        self.assertEqual(set(result.calibration.correction), set(result.calibration.sigma))
        self.assertEqual(set(result.calibration.correction.values()), {0.0})
        self.assertGreater(result.noise_scale["point_depth"], 0.0)
        self.assertGreater(result.axes_sigma, 0.0)
        self.assertTrue(result.last_window.usable)
        self.assertEqual(result.map_world, 0)


class Frames(unittest.TestCase):
    def test_covariances_and_status_are_arrays(self):
        odometry = support.room_odometry()
        support.process(odometry, support.room_images()[:4])
        odometry.drop(support.room_images()[4].timestamp)
        result = odometry.finish()
        self.assertEqual(result.covariances.shape, (5, 6, 6))
        self.assertEqual(result.status.tolist(), [frame.status for frame in result.frames])
        self.assertEqual(np.count_nonzero(result.status == "dropped"), 1)
        for name in ("covariance", "world_covariance", "odometry_covariance"):
            covariances = getattr(result, name + "s")
            for frame, covariance in zip(result.frames, covariances):
                if getattr(frame, name) is not None:
                    np.testing.assert_array_equal(getattr(frame, name), covariance)
                else:
                    self.assertTrue(np.isnan(covariance).all())
            self.assertTrue(np.all(np.linalg.eigvalsh(covariances[1:4]) > 0.0))
        drift = result.world_covariances[1:4] - result.covariances[1:4]
        self.assertTrue(np.all(np.trace(drift, axis1=1, axis2=2) >= 0.0))
        empty = support.room_odometry().finish()
        self.assertEqual((empty.covariances.shape, empty.status.shape), ((0, 6, 6), (0,)))
        self.assertEqual(empty.status.dtype.kind, "U")


class Windows(unittest.TestCase):
    def test_measurements_can_be_read_and_added(self):
        window, options = msc_vo.read_window(support.WINDOWS / "room.txt")
        self.assertGreater(len(window.line_observations["lines"]), 20)
        depths = window.line_observations["inverse_depths"]
        self.assertTrue(np.isnan(depths).all(axis=1).any() or not np.isnan(depths).any())
        copy = msc_vo.WindowData(window.camera)
        copy.add_keyframes(window.keyframe_ids, window.cam_from_world, window.keyframe_fixed)
        copy.add_points(window.point_ids, window.points, window.point_fixed, window.point_noise)
        copy.add_lines(window.line_ids, window.lines, window.line_fixed, window.line_noise,
                       window.line_depth_offsets)
        copy.add_point_observations(**window.point_observations)
        copy.add_line_observations(**window.line_observations)
        copy.add_parallel_pairs(**window.parallel_pairs)
        copy.add_perpendicular_pairs(**window.perpendicular_pairs)
        copy.add_axis_alignments(**window.axis_alignments)
        for prior in window.pose_priors:
            copy.add_pose_prior(**prior)
        solved = [msc_vo.solve_window(part, options) for part in (window, copy)]
        self.assertAlmostEqual(solved[0].initial_cost / solved[1].initial_cost, 1.0, places=9)
        np.testing.assert_allclose(copy.lines, window.lines, atol=1e-6)

    def test_lines_may_lack_their_depth(self):
        window, _ = msc_vo.read_window(support.WINDOWS / "room.txt")
        arguments = window.line_observations
        arguments["inverse_depths"][::2] = np.nan
        arguments["depth_covariances"][::2] = np.nan
        made = msc_vo.WindowData(window.camera)
        made.add_line_observations(**arguments)
        found = made.line_observations
        for name, values in arguments.items():
            np.testing.assert_array_equal(found[name], values)

    def test_unknown_keyframes_are_named(self):
        window, _ = msc_vo.read_window(support.WINDOWS / "room.txt")
        with self.assertRaisesRegex(ValueError, "keyframe: 123456 is not in the window"):
            window.set_keyframe_fixed(123456)


class ReplayTest(Scratch):
    def test_takes_a_path(self):
        for path in (support.ROOM, str(support.ROOM)):
            self.assertEqual(msc_vo.replay(path), support.room_result())

    def test_is_observed(self):
        ids = []
        msc_vo.replay(support.room(), on_tracked=lambda tracked: ids.append(tracked.frame.id))
        self.assertEqual(ids, list(range(len(support.room()))))

    def test_a_sequence_iterates(self):
        stamps = [image.timestamp for image in support.room()]
        np.testing.assert_array_equal(stamps, support.room().timestamps)



class RelativeErrors(unittest.TestCase):
    def test_rpe_from_frame_to_frame(self):
        result, truth = support.room_result(), support.room().groundtruth
        error = msc_vo.evaluate(truth, result)
        estimate, reference = error.matched_estimate, error.matched_reference
        self.assertEqual(error.rpe.translation.count, error.num_matched - 1)
        steps = np.linalg.norm(np.diff(estimate[:, 1:4], axis=0), axis=1)
        self.assertLess(error.rpe.translation.rmse, steps.max())
        self.assertGreater(error.rpe.translation.rmse, 0.0)
        np.testing.assert_allclose(np.sqrt(np.mean(np.sum((estimate - reference)[:, 1:4] ** 2, axis=1))),
                                   error.ape.rmse, rtol=1e-9)
        second = msc_vo.evaluate(truth, result, rpe_delta=0.5, rpe_unit="seconds")
        self.assertNotEqual(second.rpe, error.rpe)
        every = msc_vo.evaluate(truth, result, rpe_delta=5, rpe_all_pairs=True)
        self.assertEqual(every.rpe.translation.count, error.num_matched - 5)
        with self.assertRaisesRegex(ValueError, "rpe_unit: must be 'frames', 'metres' or 'seconds', not 'm'"):
            msc_vo.evaluate(truth, result, rpe_unit="m")
        with self.assertRaisesRegex(ValueError, "rpe_delta"):
            msc_vo.evaluate(truth, result, rpe_delta=0.5)


if __name__ == "__main__":
    unittest.main()
