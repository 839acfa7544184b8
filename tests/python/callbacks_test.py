import gc
import os
import sys
import tempfile
import threading
import time
import unittest
import weakref

import numpy as np

import msc_vo
import support


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
                    with self.assertRaisesRegex(ValueError,
                                                rf"{name}\(\).* before the first image"):
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


class Owner:
    """Owns an odometry that calls its methods."""

    def __init__(self, setters, **options):
        self.odometry = support.room_odometry(**options)
        for setter in setters:
            getattr(self.odometry, setter)(self.callback)

    def callback(self, *_):
        return []


class Lifetime(unittest.TestCase):
    SETTERS = ("set_window_factors", "set_pose_factors", "set_window_observer", "set_tracking_observer")

    def test_owners_whose_methods_are_callbacks_are_freed(self):
        num_threads = len(os.listdir("/proc/self/task"))
        for setters in ([], *([setter] for setter in self.SETTERS), self.SETTERS):
            for threads in (1, 2):
                with self.subTest(setters=setters, threads=threads):
                    owner = Owner(setters, threads=threads)
                    support.process(owner.odometry, support.room_images()[:6])
                    freed = weakref.ref(owner)
                    del owner
                    gc.collect()
                    self.assertIsNone(freed())
                    self.assertEqual(len(os.listdir("/proc/self/task")), num_threads)

    def test_callbacks_of_an_odometry_in_use_are_not_freed(self):
        owner = Owner(self.SETTERS, threads=2)
        odometry, kept = owner.odometry, weakref.ref(owner)
        del owner
        for image in support.room_images()[:12]:
            gc.collect()
            odometry.process(image.timestamp, image.gray, image.depth)
        odometry.finish()
        self.assertIsNotNone(kept())

    def test_owners_whose_methods_are_cost_functions_are_freed(self):
        for numeric in (False, True):
            with self.subTest(numeric=numeric):
                owner = Owner([])
                owner.cost = msc_vo.CostFunction(owner.callback, 1, [7], numeric)
                freed = weakref.ref(owner)
                del owner
                gc.collect()
                self.assertIsNone(freed())

    def test_cost_functions_of_a_factor_are_not_freed(self):
        class Prior:
            def __init__(self):
                self.cost = msc_vo.CostFunction(self.evaluate, 1, [7])

            def evaluate(self, pose):
                return pose[4:5], [np.eye(1, 7, 4)]

        prior = Prior()
        factor, kept = msc_vo.PoseFactor(prior.cost), weakref.ref(prior)
        del prior
        gc.collect()
        self.assertIsNotNone(kept())
        self.assertIsNotNone(factor)

    def test_callbacks_that_are_replaced_are_freed(self):
        odometry, owner = support.room_odometry(), Owner([])
        freed = weakref.ref(owner)
        odometry.set_pose_factors(owner.callback)
        odometry.set_pose_factors(None)
        del owner
        gc.collect()
        self.assertIsNone(freed())


class OtherThreads(unittest.TestCase):
    def expect_to_run_during(self, action):
        done, ticks = threading.Event(), [0]

        def tick():
            while not done.is_set():
                time.sleep(1e-4)
                ticks[0] += 1

        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000.0)  # seconds: a thread runs only while the other one is without the GIL
        thread = threading.Thread(target=tick)
        thread.start()
        try:
            before = ticks[0]
            for _ in range(200):  # an action may take less than a tick
                action()
                if ticks[0] > before:
                    break
            self.assertGreater(ticks[0], before)
        finally:
            done.set()
            thread.join()
            sys.setswitchinterval(interval)

    def test_run_while_files_are_read(self):
        odometry = support.room_odometry()
        support.process(odometry, support.room_images()[:6])
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "room.map")
            odometry.save_map(file)
            odometry.finish()
            self.expect_to_run_during(lambda: msc_vo.Sequence(support.ROOM))
            self.expect_to_run_during(lambda: msc_vo.map_images(file))
