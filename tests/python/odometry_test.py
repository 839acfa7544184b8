import gc
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

import msc_vo
import support

SHARED = os.environ.get("MSC_VO_SHARED") == "1"
OWN_FUNCTIONS = "with shared libraries each program uses the C library's functions of its process"


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

    def test_masks_leave_out_pixels(self):
        self.assertIsNone(support.room()[0].mask)
        pixels = np.zeros((480, 640), np.uint8)
        pixels[:, :320] = 255
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "mask.pgm"
            path.write_bytes(b"P5 640 480 255\n" + pixels.tobytes())
            directory = support.room().directory
            image = msc_vo.Sequence(directory, mask=path)[0]
            inverse = msc_vo.Sequence(directory, mask=path, mask_zero=True)[0]
        np.testing.assert_array_equal(image.mask, pixels)
        self.assertEqual(image.depth[:, :320].max(), 0.0)
        self.assertGreater(image.depth[:, 320:].max(), 0.0)
        self.assertEqual(inverse.depth[:, 320:].max(), 0.0)
        seen = []
        odometry = msc_vo.Odometry(None, support.room().camera)
        odometry.set_tracking_observer(lambda tracked: seen.append(tracked.points))
        odometry.process(image.timestamp, image.gray, support.room()[0].depth, mask=image.mask)
        self.assertGreater(seen[0][:, 0].min(), 320.0 + 17.0)
        for wrong in (pixels[:240], np.dstack([pixels] * 3)):
            with self.assertRaisesRegex(ValueError, "mask"):
                odometry.process(image.timestamp + 1.0, image.gray, image.depth, mask=wrong)

    def test_videos_are_read(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch, "recording")
            source = pathlib.Path(support.room().directory)
            subprocess.run([os.environ["MSC_VO_COMMAND"], "replay", source, "--max-frames", "8", "--quiet",
                            "--output", folder / "run", "--overlay", folder / "color.mp4"], check=True)
            depth = folder / "depth"
            depth.mkdir()
            for image in sorted((source / "depth").iterdir())[:8]:
                (depth / image.name).write_bytes(image.read_bytes())
            (folder / "camera.txt").write_bytes((source / "camera.txt").read_bytes())
            sequence = msc_vo.Sequence(folder)
            self.assertEqual((sequence.format, len(sequence)), ("video-depth", 8))
            self.assertEqual(sequence[7].gray.shape, (480, 640))
            msc_vo.replay(sequence).write_trajectory(folder / "python.txt")
            subprocess.run([os.environ["MSC_VO_COMMAND"], "replay", folder, "--quiet", "--output",
                            folder / "command"], check=True)
            self.assertEqual((folder / "python.txt").read_bytes(),
                             (folder / "command" / "trajectory.txt").read_bytes())

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
    @unittest.skipIf(SHARED, OWN_FUNCTIONS)
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

    def expect_bytes_of_the_command(self, sequence, *arguments):
        """Returns the result of msc_vo.replay()."""
        result = msc_vo.replay(sequence)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            subprocess.run([support.COMMAND, "replay", sequence.directory, "--output", folder / "out", "--quiet",
                            *arguments], check=True)
            result.write_trajectory(folder / "trajectory.txt")
            self.assertEqual((folder / "trajectory.txt").read_bytes(),
                             (folder / "out" / "trajectory.txt").read_bytes())
        return result

    @unittest.skipIf(SHARED, OWN_FUNCTIONS)
    def test_leaves_out_the_pixels_of_a_mask(self):
        with tempfile.TemporaryDirectory() as folder:
            mask = pathlib.Path(folder, "mask.pgm")
            pixels = np.zeros((480, 640), np.uint8)
            pixels[:, :200] = 255
            mask.write_bytes(b"P5 640 480 255\n" + pixels.tobytes())
            self.expect_bytes_of_the_command(msc_vo.Sequence(support.ROOM, mask=mask), "--mask", mask)

    @unittest.skipIf(SHARED, OWN_FUNCTIONS)
    def test_takes_the_depth_sensor_of_the_layout(self):
        self.assertEqual(support.room().depth_sensor, "auto")
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for i, time in enumerate(support.room().timestamps[:10]):
                name, number = f"{time:.6f}", f"{i:05d}"
                shutil.copy(support.ROOM / "rgb" / f"{name}.jpg", folder / f"frame_{number}.jpg")
                shutil.copy(support.ROOM / "depth" / f"{name}.png", folder / f"depth_{number}.png")
                (folder / f"frame_{number}.json").write_text(json.dumps(
                    {"time": time, "intrinsics": support.room().camera.matrix.ravel().tolist(),
                     "cameraPoseARFrame": np.eye(4).ravel().tolist()}))
            sequence = msc_vo.Sequence(folder)
            self.assertEqual((sequence.format, sequence.depth_sensor), ("3d-scanner-app", "lidar"))
            result = self.expect_bytes_of_the_command(sequence, "--no-check")
            self.assertEqual(result.depth_sensor, "lidar")
            given = msc_vo.replay(sequence, {"features.depth_sensor": "tof"})
            self.assertEqual(given.depth_sensor, "tof")

    @unittest.skipIf(SHARED, OWN_FUNCTIONS)
    def test_does_not_search_for_clipped_depth_again(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            shutil.copytree(support.ROOM / "rgb", folder / "rgb")
            for name in ("rgb.txt", "camera.txt"):
                shutil.copy(support.ROOM / name, folder)
            (folder / "depth").mkdir()
            lines = []
            for i, image in enumerate(support.room_images()):
                raw = np.rint(5000.0 * image.depth)
                if i < 4:  # enough for the search in a run, but not for that in a sample of the sequence
                    raw = np.minimum(raw, 10000)
                name = f"depth/{image.timestamp:.6f}.pgm"
                (folder / name).write_bytes(b"P5 640 480 65535\n" + raw.astype(">u2").tobytes())
                lines.append(f"{image.timestamp:.6f} {name}\n")
            (folder / "depth.txt").write_text("".join(lines))
            sequence = msc_vo.Sequence(folder)
            self.assertNotRegex(" ".join(sequence.warnings), "clipped")
            result = self.expect_bytes_of_the_command(sequence)
            searching = msc_vo.Odometry(None, sequence.camera, sequence.lens)
            support.process(searching, sequence)
            self.assertNotEqual(searching.finish(), result)
            with self.assertRaisesRegex(ValueError, "first image"):
                searching.skip_clipped_depth_search()

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
        for covariance in (frame.covariance, frame.world_covariance, frame.odometry_covariance):
            self.assertTrue(np.all(np.linalg.eigvalsh(covariance) > 0.0))
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
        self.assertEqual(result.planes.shape, (0, 4))
        self.assertEqual(result.plane_extents, [])
        for name in ("segment", "line_axes", "plane_axes", "plane_observations"):
            self.assertEqual((getattr(result, name).shape, getattr(result, name).dtype), ((0,), np.int32), name)
        self.assertEqual((result.estimated.shape, result.estimated.dtype), ((0,), np.bool_))
        self.assertIsNone(result.world_from_axes)


    def test_planes_have_extents_and_axes(self):
        odometry = support.room_odometry()
        support.process(odometry, support.room_images())
        result = odometry.finish()
        self.assertGreater(len(result.planes), 2)
        self.assertEqual(len(result.plane_extents), len(result.planes))
        for plane, extent in zip(result.planes, result.plane_extents):
            self.assertAlmostEqual(np.linalg.norm(plane[:3]), 1.0)
            self.assertGreaterEqual(len(extent), 3)
            np.testing.assert_allclose(extent @ plane[:3], -plane[3], atol=1e-9)
        self.assertGreater(result.plane_observations.max(), 2)
        self.assertGreater(np.count_nonzero(result.plane_axes >= 0), 2)


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
