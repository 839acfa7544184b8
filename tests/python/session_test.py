"""What a new user does in one session, from a folder to an own camera."""
import contextlib
import multiprocessing
import pathlib
import pickle
import sqlite3
import tempfile
import unittest

import numpy as np

import msc_vo
import support


class Session(unittest.TestCase):
    def test_a_session(self):
        # A folder: replay, arrays, errors.
        sequence = msc_vo.Sequence(support.ROOM)
        result = msc_vo.replay(str(support.ROOM))
        poses, covariances, status = result.trajectory, result.covariances, result.status
        self.assertEqual((poses.shape, covariances.shape, status.shape),
                         ((len(sequence), 8), (len(sequence), 6, 6), (len(sequence),)))
        self.assertTrue(np.all(status == "tracked"))
        sigmas = np.sqrt(np.diagonal(covariances[1:], axis1=1, axis2=2))
        self.assertTrue(np.all((sigmas > 0.0) & (sigmas < 0.1)))
        error = msc_vo.evaluate(sequence.groundtruth, result)
        self.assertLess(error.ape.rmse, 0.01)
        self.assertLess(error.rpe.translation.rmse, 0.01)

        # Results go to another process and to a file, and are the same there.
        self.assertEqual(pickle.loads(pickle.dumps(result)), result)
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            self.assertEqual(pool.apply(first_pose, (result,)), poses[0].tolist())

        # An own camera: depth of a second camera is registered, each pose is used as it comes.
        camera = msc_vo.Camera(*(getattr(sequence.camera, name) for name in
                                 ("fx", "fy", "cx", "cy", "width", "height")))
        self.assertEqual(camera, sequence.camera)
        registration = msc_vo.DepthRegistration(msc_vo.DepthCamera(camera, np.eye(4)), camera)
        options = msc_vo.Options(mode="msc-vo")
        odometry, seen = msc_vo.Odometry(options, camera, sequence.lens), []
        odometry.set_tracking_observer(lambda tracked: seen.append(len(tracked.points)))
        with tempfile.TemporaryDirectory() as folder:
            half = len(sequence) // 2
            for i, image in enumerate(sequence):
                raw = np.rint(image.depth * 1000).astype(np.uint16)
                frame = odometry.process(image.timestamp, image.gray.copy(),
                                         registration.register(raw, depth_scale=1000))
                self.assertTrue(frame.is_estimated)
                if i + 1 == half:
                    odometry.save(pathlib.Path(folder, "run"))
            live = odometry.finish()
            self.assertLess(msc_vo.evaluate(sequence.groundtruth, live).ape.rmse, 0.01)
            self.assertEqual(len(seen), len(sequence))

            # The same from the middle on.
            again = msc_vo.Odometry(options, camera, sequence.lens)
            again.restore(pathlib.Path(folder, "run"))
            for image in list(sequence)[half:]:
                raw = np.rint(image.depth * 1000).astype(np.uint16)
                again.process(image.timestamp, image.gray, registration.register(raw, depth_scale=1000))
            self.assertEqual(again.finish(), live)

        # The map, and how well its newest keyframe is known.
        window = again.map().window
        window.set_keyframe_fixed(window.keyframe_ids[0])
        newest = int(window.keyframe_ids[-1])
        known = msc_vo.window_covariance(window, keyframes=[newest])["keyframes"][newest]
        self.assertTrue(np.all(np.linalg.eigvalsh(known) > 0.0))

    def test_a_map_outlives_a_run(self):
        sequence = msc_vo.Sequence(support.ROOM)
        options = msc_vo.Options()
        first = msc_vo.Odometry(options, sequence.camera, sequence.lens)
        for image in sequence:
            first.process(image.timestamp, image.gray, image.depth)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "home.map")
            first_id, other_id = first.map().window.keyframe_ids[:2].tolist()
            jpeg = b"\xff\xd8\xff of a camera"
            first.save_map(path, session="first", images={first_id: jpeg, 10**9: b"of no keyframe"})
            self.assertEqual(msc_vo.map_images(path), {first_id: jpeg})
            with self.assertRaisesRegex(ValueError, "JPEG"):
                first.save_map(path, session="first", images={first_id: b"no picture"})
            with self.assertRaisesRegex(RuntimeError, "none.map"):
                msc_vo.map_images(pathlib.Path(folder, "none.map"))
            second = msc_vo.Odometry(options, sequence.camera, sequence.lens)
            with self.assertRaisesRegex(RuntimeError, "none.map"):
                second.load_map(pathlib.Path(folder, "none.map"))
            with self.assertRaisesRegex(ValueError, "home.map.*no keyframes"):
                second.save_map(path)
            self.assertEqual(msc_vo.map_images(path), {first_id: jpeg})
            second.load_map(path)
            with self.assertRaisesRegex(ValueError, r"load_map\(\)"):
                second.load_map(path)
            unseen = pathlib.Path(folder, "unseen.map")
            second.save_map(unseen, session="second")  # has no keyframe of its own yet
            self.assertEqual(sessions(unseen), ["first"])
            for image in sequence:
                second.process(image.timestamp, image.gray, image.depth)
            with self.assertRaisesRegex(ValueError, r"load_map\(\).*first image"):
                second.load_map(path)
            second.save_map(path, images={other_id: jpeg + b" later"})
            kept = second.map().window.keyframe_ids
            expected = {first_id: jpeg, other_id: jpeg + b" later"}
            self.assertEqual(msc_vo.map_images(path),
                             {id: jpeg for id, jpeg in expected.items() if id in kept})
            self.assertIn(first_id, kept)
            third = msc_vo.Localizer(options, sequence.camera, path, distortion=sequence.lens)
            images = list(sequence)
            status = [third.process(image.timestamp, image.gray, image.depth).status
                      for image in images[:5]]
            self.assertEqual([frame.status for frame in third.frames], status)
            third.save(pathlib.Path(folder, "run"))
            third = msc_vo.Localizer(options, sequence.camera, path, distortion=sequence.lens)
            third.restore(pathlib.Path(folder, "run"))
        status += [third.process(image.timestamp, image.gray, image.depth).status
                   for image in images[5:]]
        begin = third.finish().first_localized_frame
        adopted = status.index("tracked")  # the first frame that sees the joined map
        self.assertTrue(0 < begin <= adopted < len(sequence) // 2)
        self.assertEqual(status, ["lost"] * adopted + ["tracked"] * (len(sequence) - adopted))
        result = second.finish()
        self.assertIsNone(first.finish().first_localized_frame)
        found = result.first_localized_frame
        self.assertLess(found, len(sequence) // 2)
        self.assertEqual([segment["is_earlier_session"] for segment in result.segments], [True, False])
        self.assertEqual(result.segments[1]["world"], 0)
        (session,) = result.earlier_sessions
        self.assertEqual((session["name"], session["world"]), ("first", 0))
        positions = np.array(session["world_from_cam"])[:, :3, 3]
        known = first.finish().keyframes[:, 1:4]
        apart = np.linalg.norm(positions[:, None] - known[None], axis=2).min(axis=1)
        self.assertLess(apart.max(), 0.01)
        apart = np.linalg.norm(result.trajectory[:, 1:4] - first.finish().trajectory[:, 1:4], axis=1)
        self.assertLess(apart.max(), 0.01)


def sessions(path):
    with contextlib.closing(sqlite3.connect(path)) as file:
        return [name for name, in file.execute("SELECT name FROM session")]


def first_pose(result):
    return result.trajectory[0].tolist()


if __name__ == "__main__":
    unittest.main()
