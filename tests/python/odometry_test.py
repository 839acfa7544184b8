import gc
import os
import pathlib
import subprocess
import tempfile
import threading
import unittest

import numpy as np

import msc_vo
import support


class SequenceTest(unittest.TestCase):
    def test_decodes_images_without_copies(self):
        image = support.room()[3]
        self.assertEqual(image.gray.shape, (480, 640))
        self.assertEqual(image.gray.dtype, np.uint8)
        self.assertEqual(image.depth.dtype, np.float32)
        self.assertFalse(image.depth.flags.writeable)
        depth = image.depth
        copy = depth.copy()
        del image
        gc.collect()
        np.testing.assert_array_equal(depth, copy)  # the array keeps the image

    def test_missing_folders_are_named(self):
        with self.assertRaisesRegex(RuntimeError, "no_such_folder"):
            msc_vo.Sequence("no_such_folder")
        with self.assertRaises(IndexError):
            support.room()[len(support.room())]


class LensTest(unittest.TestCase):
    def test_describes_the_lens_of_a_sequence(self):
        lens = support.room().lens
        self.assertEqual(lens.model, "radial-tangential")
        self.assertEqual(lens.coefficients, support.room().distortion)
        self.assertIsNone(lens.recorded)

    def test_a_wide_lens_has_an_undistorted_camera(self):
        camera = msc_vo.Camera(300.0, 300.0, 319.5, 239.5, 640, 480)
        lens = msc_vo.Lens("fisheye", [0.02, -0.012, 0.006, -0.0015])
        undistorted, cropped = msc_vo.undistorted_camera(camera, lens, field_of_view=90.0)
        self.assertAlmostEqual(undistorted.fx, 319.5)
        self.assertEqual(cropped.recorded.fx, 300.0)
        self.assertEqual(cropped.coefficients, lens.coefficients)
        image = support.room()[0]
        odometry = msc_vo.Odometry(None, undistorted, cropped)
        self.assertTrue(odometry.process(image.timestamp, image.gray, image.depth).is_estimated)

    def test_impossible_lenses_are_named(self):
        with self.assertRaisesRegex(ValueError, "unknown model 'wide'; known: radial-tangential"):
            msc_vo.Lens("wide", [0.0])
        with self.assertRaisesRegex(ValueError, "expected k1 k2 k3 k4 of the model fisheye"):
            msc_vo.Lens("fisheye", [0.0])
        camera = msc_vo.Camera(300.0, 300.0, 319.5, 239.5, 640, 480)
        with self.assertRaisesRegex(ValueError, "field_of_view = 180"):
            msc_vo.undistorted_camera(camera, msc_vo.Lens("fisheye", [0.0] * 4), 180.0)


class Replay(unittest.TestCase):
    @unittest.skipIf(os.environ.get("MSC_VO_SHARED") == "1",
                     "with shared libraries each program uses the C library's functions of its process")
    def test_writes_the_bytes_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            subprocess.run([support.COMMAND, "replay", support.ROOM, "--output", folder / "out",
                            "--quiet"], check=True)
            support.room_result().write_trajectory(folder / "trajectory.txt")
            expected = (folder / "out" / "trajectory.txt").read_bytes()
            self.assertEqual((folder / "trajectory.txt").read_bytes(), expected)
            self.assertEqual(np.loadtxt(folder / "trajectory.txt").shape,
                             support.room_result().trajectory.shape)
            np.testing.assert_allclose(support.room_result().trajectory,
                                       np.loadtxt(folder / "out" / "trajectory.txt"), atol=1e-6)

    def test_raw_depth_and_colour_give_the_same_trajectory(self):
        images = support.room_images()[:12]
        metric, raw = support.room_odometry(), support.room_odometry()
        scale = support.room().depth_scale
        for image in images:
            units = np.rint(image.depth * scale).astype(np.uint16)
            a = metric.process(image.timestamp, image.gray, image.depth)
            b = raw.process(image.timestamp, np.stack([image.gray] * 3, axis=2), units,
                            depth_scale=scale)
            np.testing.assert_array_equal(a.cam_from_world, b.cam_from_world)

    def test_saturated_raw_depth_is_not_measured(self):
        image = support.room()[0]
        scale = support.room().depth_scale
        zeros = np.rint(image.depth * scale).astype(np.uint16)
        zeros[100:200] = 0
        saturated = zeros.copy()
        saturated[saturated == 0] = 65535
        a, b = [support.room_odometry().process(image.timestamp, image.gray, depth,
                                                depth_scale=scale) for depth in (zeros, saturated)]
        self.assertEqual((a.num_points, a.num_lines), (b.num_points, b.num_lines))
        np.testing.assert_array_equal(a.covariance, b.covariance)

    def test_swapped_bytes_are_refused(self):
        for scale in (1000, 5000):
            units = np.rint(support.room()[0].depth * scale).astype(np.uint16)
            odometry = support.room_odometry()
            gray = support.room()[0].gray
            with self.assertRaisesRegex(ValueError, "depth: the two bytes .*byteswap"):
                odometry.process(0.0, gray, units.byteswap(), depth_scale=scale)
            self.assertEqual(odometry.process(0.0, gray, units, depth_scale=scale).id, 0)

    def test_depth_that_is_not_a_number_is_not_measured(self):
        images = support.room_images()[:6]
        zeros, nans = support.room_odometry(), support.room_odometry()
        for image in images:
            depth = image.depth.copy()
            depth[depth == 0.0] = np.nan
            a = zeros.process(image.timestamp, image.gray, image.depth)
            b = nans.process(image.timestamp, image.gray, depth)
            np.testing.assert_array_equal(a.cam_from_world, b.cam_from_world)


class Results(unittest.TestCase):
    def test_frames_have_poses_and_covariances(self):
        frames = support.process(support.room_odometry(), support.room_images()[:3])
        frame = frames[-1]
        self.assertEqual([f.id for f in frames], [0, 1, 2])
        self.assertEqual(frame.status, "tracked")
        self.assertTrue(frame.is_estimated)
        self.assertEqual(frame.cam_from_world.shape, (4, 4))
        np.testing.assert_allclose(frame.cam_from_world @ frame.world_from_cam, np.eye(4),
                                   atol=1e-12)
        self.assertTrue(np.all(np.linalg.eigvalsh(frame.covariance) > 0.0))
        self.assertGreater(frame.num_inlier_points, 20)
        self.assertGreater(frame.times["tracking"], 0.0)
        self.assertIn("tracked", repr(frame))

    def test_arrays_are_views_that_keep_the_result(self):
        result = support.room_result()
        self.assertEqual(result.trajectory.shape, (len(support.room()), 8))
        self.assertEqual(result.points.shape[1], 3)
        self.assertEqual(result.lines.shape[1], 6)
        self.assertEqual(len(result.line_axes), len(result.lines))
        self.assertGreater(np.count_nonzero(result.line_axes >= 0), 5)
        self.assertTrue(np.all(result.estimated))
        self.assertEqual(result.axes_state, "refined")
        self.assertEqual(result.depth_sensor, "structured-light")
        self.assertTrue(np.shares_memory(result.points, result.points))
        self.assertFalse(result.points.flags.writeable)
        odometry = support.room_odometry()
        support.process(odometry, support.room_images()[:3])
        points = odometry.finish().points
        copy = points.copy()
        del odometry
        gc.collect()
        np.testing.assert_array_equal(points, copy)

    def test_a_run_without_images_is_empty(self):
        result = support.room_odometry().finish()
        self.assertEqual(result.trajectory.shape, (0, 8))
        self.assertEqual(result.points.shape, (0, 3))
        self.assertEqual(result.lines.shape, (0, 6))
        self.assertIsNone(result.world_from_axes)


class Arrays(unittest.TestCase):
    def setUp(self):
        self.odometry = support.room_odometry()
        self.image = support.room_images()[0]

    def refuse(self, message, gray=None, depth=None, **arguments):
        gray = self.image.gray if gray is None else gray
        depth = self.image.depth if depth is None else depth
        with self.assertRaisesRegex(ValueError, message):
            self.odometry.process(1.0, gray, depth, **arguments)

    def test_arrays_that_do_not_fit_are_refused(self):
        gray, depth = self.image.gray, self.image.depth
        self.refuse("gray: must be uint8, is float64$", gray=gray / 255.0)
        self.refuse(r"gray: .*\(480, 640, 4\)", gray=np.zeros((480, 640, 4), np.uint8))
        self.refuse("gray: the array is not C-contiguous.*ascontiguousarray", gray=gray[:, ::-1])
        self.refuse("gray: the image is empty", gray=gray[:0])
        self.refuse("depth: must be float32 .* is float64$", depth=depth.astype(np.float64))
        self.refuse("depth: the array is not C-contiguous", depth=depth[:, ::2])
        self.refuse("depth: uint16 needs depth_scale", depth=np.zeros((480, 640), np.uint16))
        self.refuse("depth_scale is for uint16", depth_scale=5000.0)
        self.refuse("depth_scale", depth=np.zeros((480, 640), np.uint16), depth_scale=0.0)
        self.refuse("gray: image is 640x240, camera is 640x480$", gray=gray[:240], depth=depth[:240])
        self.refuse("depth: image is 640x240, camera is 640x480$", depth=depth[:240])
        self.refuse("gray: must be uint8", gray="image")

    def test_continues_after_an_error(self):
        self.refuse("gray", gray=self.image.depth)
        frame = self.odometry.process(1.0, self.image.gray, self.image.depth)
        self.assertEqual(frame.id, 0)
        self.refuse("time stamp")  # 1.0 again
        self.odometry.drop(1.1)
        self.assertEqual([f.status for f in self.odometry.finish().frames][1], "dropped")
        with self.assertRaisesRegex(ValueError, "status"):
            self.odometry.drop(1.2, "tracked")


class ExternalMapping(unittest.TestCase):
    def test_the_budget_does_not_change_the_result(self):
        images = support.room_images()[:16]
        expected = support.room_odometry(threads=1)
        support.process(expected, images)
        odometry = support.room_odometry(threads=1, external_mapping=True)
        threads, num_pending = set(), 0
        odometry.set_window_observer(lambda *_: threads.add(threading.get_ident()))
        for image in images:
            odometry.process(image.timestamp, image.gray, image.depth)
            num_pending += odometry.mapping_pending
            odometry.run_mapping(0.005)
        np.testing.assert_array_equal(odometry.finish().trajectory, expected.finish().trajectory)
        self.assertGreater(num_pending, 0)
        self.assertFalse(odometry.mapping_pending)
        self.assertEqual(threads, {threading.get_ident()})

    def test_misuse_is_named(self):
        with self.assertRaisesRegex(ValueError, "external_mapping"):
            support.room_odometry().run_mapping(0.005)
        with self.assertRaisesRegex(ValueError, "budget"):
            support.room_odometry(external_mapping=True).run_mapping(-1.0)

    def test_callbacks_cannot_run_the_mapping(self):
        odometry = support.room_odometry(threads=1, external_mapping=True)
        odometry.set_window_observer(lambda *_: odometry.run_mapping(1.0))
        with self.assertRaisesRegex(RuntimeError, "in use"):
            for image in support.room_images():
                odometry.process(image.timestamp, image.gray, image.depth)
                odometry.run_mapping(1.0)


class Callbacks(unittest.TestCase):
    def test_the_gil_is_released_while_images_are_processed(self):
        odometry = support.room_odometry()
        running, count = threading.Event(), [0]
        running.set()

        def work():
            while running.is_set():
                count[0] += 1

        thread = threading.Thread(target=work)
        thread.start()
        during = 0
        for image in support.room_images():  # a busy machine may not run the thread during one of them
            before = count[0]
            odometry.process(image.timestamp, image.gray, image.depth)
            during = max(during, count[0] - before)
        running.clear()
        thread.join()
        self.assertGreater(during, 1000)

    def test_pose_factors_pull_the_pose(self):
        odometry = support.room_odometry(threads=1)
        contexts = []

        def factors(frame):
            contexts.append(frame)
            prior = msc_vo.pose_prior(frame.predicted_cam_from_world, 1e-12 * np.eye(6))
            return [msc_vo.PoseFactor(prior, name="prediction")]

        odometry.set_pose_factors(factors)
        frames = support.process(odometry, support.room_images()[:4])
        self.assertEqual(len(contexts), 3)  # none before the first keyframe
        np.testing.assert_allclose(frames[1].cam_from_world,
                                   contexts[0].predicted_cam_from_world, atol=1e-3)
        self.assertAlmostEqual(contexts[-1].timestamp, frames[-1].timestamp)

    def test_window_factors_use_extra_blocks(self):
        for threads in (1, 2):
            odometry = support.room_odometry(threads=threads)

            def factors(window):
                cost = msc_vo.CostFunction(lambda x: ((x - 2.0) / 0.1, [np.eye(1) / 0.1]), 1, [1])
                return [msc_vo.ExtraBlock(7, [1.0]),
                        msc_vo.CustomFactor(cost, [msc_vo.BlockId.extra(7)])]

            odometry.set_window_factors(factors)
            support.process(odometry, support.room_images()[:16])
            blocks = odometry.finish().extra_blocks
            self.assertAlmostEqual(blocks[7][0], 2.0, places=6)

    def test_window_factors_use_landmarks(self):
        for threads in (1, 2):
            odometry = support.room_odometry(threads=threads)
            kept, unread, counts = [], [], []

            def factors(window):
                points = window.data
                counts.append(len(points.point_ids))
                kept.append(window)
                known = points.points[0]
                cost = msc_vo.CostFunction(lambda x: ((x - known) / 0.01, [np.eye(3) / 0.01]), 3,
                                           [3])
                return [msc_vo.CustomFactor(cost, [msc_vo.BlockId.point(points.point_ids[0])])]

            odometry.set_window_factors(factors)
            support.process(odometry, support.room_images()[:16])
            odometry.finish()
            self.assertGreater(min(counts), 20)
            self.assertEqual(len(kept[0].data.point_ids), counts[0])  # was read in the callback
            odometry = support.room_odometry(threads=threads)
            odometry.set_window_factors(unread.append)  # returns None: no factors
            support.process(odometry, support.room_images()[:16])
            odometry.finish()
            with self.assertRaisesRegex(RuntimeError, "during the callback"):
                unread[0].data
            self.assertTrue(unread[0].keyframes)

    def test_exceptions_arrive_as_they_are(self):
        class Broken(Exception):
            pass

        def fail(*_):
            raise Broken("on purpose")

        for threads in (1, 2):
            for setter in ("set_pose_factors", "set_window_factors", "set_window_observer"):
                odometry = support.room_odometry(threads=threads)
                getattr(odometry, setter)(fail)
                with self.assertRaisesRegex(Broken, "on purpose"):
                    support.process(odometry, support.room_images())
                    odometry.finish()

    def test_what_is_no_factor_is_named(self):
        odometry = support.room_odometry(threads=1)
        odometry.set_window_factors(lambda window: ["not a factor"])
        with self.assertRaisesRegex(ValueError, "not a factor"):
            support.process(odometry, support.room_images())

    def test_callbacks_of_the_mapper_cannot_use_the_odometry(self):
        # It would wait for the thread that it runs on.
        for use in (lambda odometry: odometry.map(), lambda odometry: odometry.frames):
            odometry = support.room_odometry(threads=2)
            odometry.set_window_observer(lambda *_: use(odometry))
            with self.assertRaisesRegex(RuntimeError, "in use"):
                support.process(odometry, support.room_images())
                odometry.finish()

    def test_callbacks_cannot_use_the_odometry(self):
        odometry = support.room_odometry(threads=1)
        odometry.set_pose_factors(lambda frame: odometry.finish())
        with self.assertRaisesRegex(RuntimeError, "in use"):
            support.process(odometry, support.room_images()[:4])

    def test_callbacks_are_set_before_the_first_image(self):
        image = support.room_images()[0]
        steps = [lambda odometry: odometry.process(image.timestamp, image.gray, image.depth),
                 lambda odometry: odometry.drop(image.timestamp)]
        for step in steps:
            odometry = support.room_odometry()
            step(odometry)
            for name in ("set_pose_factors", "set_window_factors", "set_window_observer"):
                for callback in (None, lambda *_: None):
                    with self.assertRaisesRegex(ValueError, "before the first image"):
                        getattr(odometry, name)(callback)

    def test_a_frame_whose_callback_raises_is_complete(self):
        for threads in (1, 2):
            for setter in ("set_pose_factors", "set_window_factors", "set_window_observer"):
                odometry = support.room_odometry(threads=threads)
                calls = []

                def fail_once(*_):
                    calls.append(None)
                    if len(calls) == 1:
                        raise KeyError("on purpose")

                getattr(odometry, setter)(fail_once)
                num_errors = 0
                for image in support.room_images():
                    try:
                        odometry.process(image.timestamp, image.gray, image.depth)
                    except KeyError:
                        num_errors += 1
                        with self.assertRaisesRegex(ValueError, "not later than"):
                            odometry.process(image.timestamp, image.gray, image.depth)
                    self.assertEqual(odometry.frames[-1].timestamp, image.timestamp)
                    self.assertEqual(odometry.frames[-1].status, "tracked")
                self.assertEqual(num_errors, 1)
                ids = [frame.id for frame in odometry.finish().frames]
                self.assertEqual(ids, list(range(len(support.room_images()))))

    def test_frames_know_their_world_and_cause(self):
        odometry = support.room_odometry()
        images = support.room_images()
        black = np.zeros_like(images[0].gray)
        frames = [odometry.process(image.timestamp, black if 5 <= i < 8 else image.gray,
                                   image.depth) for i, image in enumerate(images[:12])]
        self.assertIsNone(frames[0].covariance)  # it defines the world
        self.assertEqual(frames[1].covariance.shape, (6, 6))
        np.testing.assert_array_equal(frames[0].cam_from_odometry, np.eye(4))
        for i, frame in enumerate(frames):
            is_black = 5 <= i < 8
            self.assertEqual(frame.cause, "uniform_image" if is_black else None)
            self.assertEqual(frame.covariance is None, is_black or i == 0)
            self.assertEqual(frame.world, 0)
            self.assertIsNone(frame.world_changed)
            np.testing.assert_allclose(frame.cam_from_world @ frame.world_from_odometry,
                                       frame.cam_from_odometry, atol=1e-12)

    def test_pose_factors_see_extra_blocks(self):
        values = {}
        for threads in (1, 2):
            odometry = support.room_odometry(threads=threads)
            seen = values.setdefault(threads, [])

            def window_factors(window):
                self.assertEqual(window.world, 0)
                target = 2.0 + 0.01 * len(window.keyframes)
                cost = msc_vo.CostFunction(lambda x: (x - target, [np.eye(1)]), 1, [1])
                return [msc_vo.ExtraBlock(7, [1.0]),
                        msc_vo.CustomFactor(cost, [msc_vo.BlockId.extra(7)])]

            def pose_factors(frame):
                self.assertEqual(frame.world, 0)
                seen.append({id: tuple(value) for id, value in frame.extra_blocks.items()})

            odometry.set_window_factors(window_factors)
            odometry.set_pose_factors(pose_factors)
            support.process(odometry, support.room_images())
        self.assertEqual(values[1][0], {})
        self.assertGreater(len(set(str(blocks) for blocks in values[1])), 2)
        self.assertEqual(values[1], values[2])

    def test_observers_see_windows(self):
        odometry = support.room_odometry()
        windows = []
        odometry.set_window_observer(lambda *arguments: windows.append(arguments))
        support.process(odometry, support.room_images())
        odometry.finish()
        self.assertGreater(len(windows), 2)
        keyframe, window, options = windows[-1]
        self.assertIn(keyframe, window.keyframe_ids)
        self.assertIs(options["landmark_noise.enabled"], True)
        self.assertTrue(msc_vo.solve_window(window, options).usable)

    def test_an_odometry_can_go_while_its_mapper_calls_python(self):
        for _ in range(3):
            odometry = support.room_odometry(threads=2)
            odometry.set_window_observer(lambda *_: [sum(range(1000)) for _ in range(200)])
            support.process(odometry, support.room_images()[:8])
            del odometry
