import copy
import pathlib
import pickle
import tempfile
import unittest

import numpy as np

import msc_vo
import support

SOLVERS = ("block-schur", "ceres")


def rotation_y(angle):
    pose = np.eye(4)
    pose[:3, :3] = [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    return pose


class Scene:
    """Three cameras that see forty points without noise; the last two poses are disturbed."""

    def __init__(self):
        self.camera = msc_vo.Camera(500.0, 500.0, 319.5, 239.5, 640, 480)
        random = np.random.default_rng(1)
        self.points = random.uniform([-1, -1, 3], [1, 1, 5], (40, 3))
        self.poses = np.stack([rotation_y(0.05 * i) for i in range(3)])
        self.poses[:, 0, 3] = [0.0, -0.1, -0.2]

    def window(self):
        window = msc_vo.WindowData(self.camera)
        start = self.poses.copy()
        start[1:, :3, 3] += [0.03, -0.02, 0.04]
        window.add_keyframes([0, 1, 2], start, fixed=[True, False, False])
        window.add_points(np.arange(40), self.points + 0.02)
        for i, pose in enumerate(self.poses):
            x = self.points @ pose[:3, :3].T + pose[:3, 3]
            pixels = x @ self.camera.matrix.T
            pixels = pixels[:, :2] / pixels[:, 2:]
            window.add_point_observations(np.full(40, i), np.arange(40), pixels, sigmas=1.0,
                                          inverse_depths=1.0 / x[:, 2], inverse_depth_sigmas=0.001)
        return window


# Types and shapes behind the number of items, of all arrays of a window.
ARRAYS = {
    **{f"{kind}_ids": (np.int64, ()) for kind in ("keyframe", "point", "line")},
    **{f"{kind}_fixed": (np.bool_, ()) for kind in ("keyframe", "point", "line")},
    **{name: (np.float64, ()) for name in ("point_noise", "line_noise", "line_depth_offsets")},
    **{f"{kind}_rejected": (np.bool_, ()) for kind in ("point_observation", "line_observation", "parallel",
                                                       "perpendicular", "axis_alignment", "point_depth", "line_depth")},
    "cam_from_world": (np.float64, (4, 4)), "points": (np.float64, (3,)), "lines": (np.float64, (6,))}
IDS, NUMBERS = (np.int64, ()), (np.float64, ())
PAIRS = {"a": IDS, "b": IDS, "sigmas": NUMBERS, "counts": IDS}
TABLES = {
    "point_observations": {"keyframes": IDS, "points": IDS, "pixels": (np.float64, (2,)), "sigmas": NUMBERS,
                           "inverse_depths": NUMBERS, "inverse_depth_sigmas": NUMBERS},
    "line_observations": {"keyframes": IDS, "lines": IDS, "segments": (np.float64, (4,)), "sigmas": NUMBERS,
                          "inverse_depths": (np.float64, (2,)), "depth_covariances": (np.float64, (2, 2))},
    "parallel_pairs": PAIRS, "perpendicular_pairs": PAIRS,
    "axis_alignments": {"lines": IDS, "axes": (np.float64, (3,)), "sigmas": NUMBERS}}


class Arrays(unittest.TestCase):
    def test_types_and_shapes_do_not_depend_on_the_number_of_items(self):
        full, _ = msc_vo.read_window(support.WINDOWS / "room.txt")
        for window in (full, msc_vo.WindowData(full.camera)):
            self.assertEqual({name: (getattr(window, name).dtype, getattr(window, name).shape[1:])
                              for name in ARRAYS}, ARRAYS)
            for table, columns in TABLES.items():
                self.assertEqual({name: (array.dtype, array.shape[1:])
                                  for name, array in getattr(window, table).items()}, columns)
        self.assertEqual(window.lines.size, 0)

    def test_arrays_hold_what_was_added(self):
        window = msc_vo.WindowData(msc_vo.Camera(500.0, 500.0, 319.5, 239.5, 640, 480))
        poses = np.stack([rotation_y(0.1), rotation_y(0.2)])
        poses[:, :3, 3] = [[1, 2, 3], [4, 5, 6]]
        window.add_keyframes([3, 4], poses, fixed=[True, False])
        window.add_lines([7, 8], np.arange(12.0).reshape(2, 6), depth_offsets=[0.1, 0.2])
        covariances = np.array([[[4.0, 1.0], [1.0, 9.0]], np.full((2, 2), np.nan)])
        observations = {"keyframes": [3, 4], "lines": [7, 8], "segments": np.arange(8.0).reshape(2, 4),
                        "sigmas": [1.0, 2.0], "inverse_depths": [[0.5, 0.25], [np.nan, np.nan]],
                        "depth_covariances": covariances}
        window.add_line_observations(**observations)
        np.testing.assert_allclose(window.cam_from_world, poses, atol=1e-12)
        np.testing.assert_array_equal(window.keyframe_fixed, [True, False])
        np.testing.assert_array_equal(window.line_ids, [7, 8])
        np.testing.assert_array_equal(window.lines, np.arange(12.0).reshape(2, 6))
        np.testing.assert_array_equal(window.line_depth_offsets, [0.1, 0.2])
        for name, values in observations.items():
            np.testing.assert_array_equal(window.line_observations[name], values, name)


class Files(unittest.TestCase):
    def test_recorded_windows_are_solved_and_written(self):
        window, options = msc_vo.read_window(support.WINDOWS / "room.txt")
        self.assertEqual(window.points.shape, (113, 3))
        self.assertEqual(window.lines.shape, (53, 6))
        before = window.points
        summary = msc_vo.solve_window(window, options)
        self.assertTrue(summary.usable, summary.message)
        self.assertLess(summary.final_cost, summary.initial_cost)
        self.assertGreater(np.abs(window.points - before).max(), 1e-4)
        self.assertEqual(summary.terms["point_reprojection"]["num_rejected"],
                         np.count_nonzero(window.point_observation_rejected))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "solved.txt"
            msc_vo.write_window(path, window, options)
            again, _ = msc_vo.read_window(path)
            np.testing.assert_array_equal(again.points, window.points)
            np.testing.assert_array_equal(again.cam_from_world, window.cam_from_world)

    def test_missing_files_are_named(self):
        with self.assertRaisesRegex(RuntimeError, "no_such_window"):
            msc_vo.read_window("no_such_window.txt")


class FromArrays(unittest.TestCase):
    def test_recovers_the_truth(self):
        scene = Scene()
        for solver in SOLVERS:
            window = scene.window()
            summary = msc_vo.solve_window(window, msc_vo.WindowOptions(solver=solver))
            self.assertTrue(summary.usable)
            np.testing.assert_allclose(window.cam_from_world, scene.poses, atol=1e-5)
            np.testing.assert_allclose(window.points, scene.points, atol=1e-4)
            self.assertEqual(np.count_nonzero(window.point_observation_rejected), 0)

    def test_marks_tell_where_only_the_depth_is_an_outlier(self):
        scene = Scene()
        window, wrong = msc_vo.WindowData(scene.camera), [3, 20, 50]
        observations = scene.window().point_observations
        observations["inverse_depths"][wrong] *= 0.7
        window.add_keyframes(range(len(scene.poses)), scene.poses, fixed=[True] + [False] * (len(scene.poses) - 1))
        window.add_points(range(len(scene.points)), scene.points)
        window.add_point_observations(**observations)
        for consensus in (False, True):
            solved = copy.copy(window)
            summary = msc_vo.solve_window(solved, msc_vo.WindowOptions(**{"consensus.enabled": consensus}))
            np.testing.assert_array_equal(np.flatnonzero(solved.point_depth_rejected), wrong)
            self.assertEqual(summary.terms["point_depth"]["num_rejected"], len(wrong))
            self.assertFalse(solved.point_observation_rejected.any())
            self.assertEqual(pickle.loads(pickle.dumps(solved)), solved)

    def test_covariances_are_by_id(self):
        window = Scene().window()
        msc_vo.solve_window(window)
        covariance = msc_vo.window_covariance(window, keyframes=[0, 2], points=[5])
        np.testing.assert_array_equal(covariance["keyframes"][0], np.zeros((6, 6)))
        self.assertTrue(np.all(np.linalg.eigvalsh(covariance["keyframes"][2]) > 0.0))
        self.assertEqual(covariance["points"][5].shape, (3, 3))

    def test_lines_and_structure(self):
        scene = Scene()
        window = msc_vo.WindowData(scene.camera)
        window.add_keyframes([0, 1], scene.poses[:2], fixed=[True, True])
        lines = np.array([[-1, 0, 4, 1, 0, 4.0], [-1, 0.5, 4, 1, 0.52, 4.02]])
        window.add_lines([3, 4], lines)
        for i in range(2):
            ends = lines.reshape(-1, 3) @ scene.poses[i, :3, :3].T + scene.poses[i, :3, 3]
            pixels = ends @ scene.camera.matrix.T
            segments = (pixels[:, :2] / pixels[:, 2:]).reshape(-1, 4)
            window.add_line_observations([i, i], [3, 4], segments,
                                         inverse_depths=1.0 / ends[:, 2].reshape(-1, 2),
                                         depth_covariances=np.tile(1e-4 * np.eye(2), (2, 1, 1)))
        window.add_parallel_pairs([3], [4], sigmas=0.001)
        window.add_axis_alignments([3], [[1.0, 0.0, 0.0]])
        summary = msc_vo.solve_window(window)
        self.assertEqual(summary.terms["parallel"]["num_residual_blocks"], 1)
        self.assertEqual(summary.terms["manhattan"]["num_residual_blocks"], 1)
        directions = window.lines[:, 3:] - window.lines[:, :3]
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        self.assertGreater(directions[0] @ directions[1], 0.99999)

    def test_arrays_that_do_not_fit_are_named(self):
        window = Scene().window()
        for message, call in [
                (r"positions: expected shape \(N, 3\), not \(2, 2\)",
                 lambda: window.add_points([1, 2], np.zeros((2, 2)))),
                (r"ids: expected shape \(2,\), not \(3,\)",
                 lambda: window.add_points([1, 2, 3], np.zeros((2, 3)))),
                ("ids: expected whole numbers", lambda: window.add_points([1.5], np.zeros((1, 3)))),
                ("fixed: expected 1 truth values",
                 lambda: window.add_points([1], np.zeros((1, 3)), fixed=[1])),
                (r"cam_from_world\[0\]: .*rotation",
                 lambda: window.add_keyframes([9], [2.0 * np.diag([1, 1, 1, 0.5])])),
                ("not finite", lambda: window.add_points([1], [[0, 0, np.nan]])),
                ("give both or neither",
                 lambda: window.add_line_observations([0], [1], np.zeros((1, 4)),
                                                      inverse_depths=[[1, 1]]))]:
            with self.assertRaisesRegex(ValueError, message):
                call()
        self.assertEqual(len(window.points), 40)
        window.add_point_observations([77], [0], [[1.0, 2.0]])
        with self.assertRaisesRegex(ValueError, "77"):
            msc_vo.solve_window(window)


class Factors(unittest.TestCase):
    def test_built_in_factors_vanish_at_their_measurement(self):
        pose, other = Scene().poses[1:]
        covariance = np.diag([1e-4] * 3 + [1e-2] * 3)

        def block(matrix):
            w = np.sqrt(1.0 + np.trace(matrix[:3, :3])) / 2.0
            r = matrix
            q = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / (4.0 * w)
            return np.concatenate([q, [w], matrix[:3, 3]])

        relative = other @ np.linalg.inv(pose)
        up = pose[:3, :3] @ [0.0, -1.0, 0.0]
        for cost, blocks in [
                (msc_vo.pose_prior(pose, covariance), [block(pose)]),
                (msc_vo.relative_pose(relative, covariance), [block(pose), block(other)]),
                (msc_vo.scaled_relative_pose(relative, covariance),
                 [block(pose), block(other), [1.0]]),
                (msc_vo.gravity_direction(up, 0.01), [block(pose), [0.0, -1.0, 0.0]]),
                (msc_vo.direction_prior([0, 0, 2], 0.01), [[0.0, 0.0, 1.0]])]:
            residuals, jacobians = cost.evaluate(*blocks)
            np.testing.assert_allclose(residuals, 0.0, atol=1e-9)
            self.assertEqual([j.shape for j in jacobians],
                             [(cost.num_residuals, size) for size in cost.block_sizes])
        residuals, _ = msc_vo.pose_prior(pose, covariance).evaluate(
            block(pose) + [0, 0, 0, 0, 0.2, 0, 0])
        np.testing.assert_allclose(residuals, [0, 0, 0, 2, 0, 0], atol=1e-9)

    def test_python_factors_take_part_in_the_solution(self):
        scene = Scene()
        measured = scene.poses[2, :3, 3] + [0.0, 0.0, 0.5]

        def analytic(pose):
            jacobian = np.zeros((3, 7))
            jacobian[:, 4:] = np.eye(3) / 1e-6
            return (pose[4:] - measured) / 1e-6, [jacobian]

        for solver in SOLVERS:
            for numeric in (False, True):
                window = scene.window()
                function = (lambda pose: analytic(pose)[0]) if numeric else analytic
                cost = msc_vo.CostFunction(function, 3, [7], numeric=numeric)
                window.add([msc_vo.CustomFactor(cost, [msc_vo.BlockId.pose(2)], name="position")])
                summary = msc_vo.solve_window(window, msc_vo.WindowOptions(
                    solver=solver, first_iterations=20))
                self.assertEqual(summary.terms["custom"]["num_residual_blocks"], 1)
                np.testing.assert_allclose(window.cam_from_world[2, :3, 3], measured, atol=1e-3)

    def test_the_derivatives_of_numeric_factors(self):
        cost = msc_vo.CostFunction(lambda x, y: np.array([x[0] * y[0], np.sin(x[1])]), 2, [2, 1],
                                   numeric=True)
        residuals, (by_x, by_y) = cost.evaluate([2.0, 0.5], [3.0])
        np.testing.assert_allclose(residuals, [6.0, np.sin(0.5)])
        np.testing.assert_allclose(by_x, [[3.0, 0.0], [0.0, np.cos(0.5)]], atol=1e-6)
        np.testing.assert_allclose(by_y, [[2.0], [0.0]], atol=1e-6)

    def test_extra_blocks_are_estimated(self):
        scene = Scene()
        for solver in SOLVERS:
            window = scene.window()
            relative = scene.poses[2] @ np.linalg.inv(scene.poses[0])
            relative[:3, 3] *= 0.5  # of a wheel of half the radius
            window.add([
                msc_vo.ExtraBlock(0, [1.0]),
                msc_vo.CustomFactor(msc_vo.scaled_relative_pose(relative, 1e-6 * np.eye(6)),
                                    [msc_vo.BlockId.pose(0), msc_vo.BlockId.pose(2),
                                     msc_vo.BlockId.extra(0)], huber=2.0, name="wheels")])
            msc_vo.solve_window(window, msc_vo.WindowOptions(solver=solver, first_iterations=20))
            self.assertAlmostEqual(window.extra_blocks[0][0], 2.0, places=3)

    def test_covariances_of_directions_are_in_square_radians(self):
        window, up = Scene().window(), np.array([0.0, 0.6, 0.8])
        window.add([msc_vo.ExtraBlock(5, up, "sphere"),
                    msc_vo.CustomFactor(msc_vo.direction_prior(up, 0.02), [msc_vo.BlockId.extra(5)])])
        covariance = msc_vo.window_covariance(window, extra_blocks=[5])["extra_blocks"][5]
        np.testing.assert_allclose(covariance, 0.0004 * np.eye(2), atol=1e-12)

    def test_exceptions_pass_through_the_solver(self):
        class Broken(Exception):
            pass

        for solver in SOLVERS:
            for numeric in (False, True):
                for failing_call in (1, 3, 6):
                    calls = [0]

                    def fail(pose):
                        calls[0] += 1
                        if calls[0] == failing_call:
                            raise Broken("on purpose")
                        return np.zeros(1) if numeric else (np.zeros(1), [np.zeros((1, 7))])

                    window = Scene().window()
                    before = window.points
                    window.add([msc_vo.CustomFactor(
                        msc_vo.CostFunction(fail, 1, [7], numeric=numeric),
                        [msc_vo.BlockId.pose(1)])])
                    with self.assertRaisesRegex(Broken, "on purpose"):
                        msc_vo.solve_window(window, msc_vo.WindowOptions(solver=solver))
                    np.testing.assert_array_equal(window.points, before)

    def test_results_of_the_wrong_shape_are_named(self):
        for message, result in [
                (r"residuals: expected shape \(1,\), not \(2,\)", (np.zeros(2), [np.zeros((1, 7))])),
                (r"Jacobian 0: expected shape \(1, 7\), not \(1, 6\)", (np.zeros(1), [np.zeros((1, 6))])),
                ("expected 1 Jacobians", (np.zeros(1), [])),
                ("the tuple", np.zeros(1))]:
            window = Scene().window()
            window.add([msc_vo.CustomFactor(
                msc_vo.CostFunction(lambda pose, result=result: result, 1, [7]),
                [msc_vo.BlockId.pose(1)])])
            with self.assertRaisesRegex(ValueError, message):
                msc_vo.solve_window(window)

    def test_factors_that_do_not_fit_are_named(self):
        window = Scene().window()
        window.add([msc_vo.CustomFactor(msc_vo.CostFunction(lambda pose: None, 1, [7]),
                                        [msc_vo.BlockId.pose(1)], name="nowhere")])
        with self.assertRaisesRegex(ValueError, "nowhere"):
            msc_vo.solve_window(window)
        with self.assertRaisesRegex(ValueError, "covariance"):
            msc_vo.pose_prior(np.eye(4), np.zeros((6, 6)))
        with self.assertRaisesRegex(ValueError, "manifold"):
            msc_vo.ExtraBlock(0, [1.0], "torus")
        with self.assertRaisesRegex(ValueError, "block size"):
            msc_vo.CostFunction(lambda pose: None, 1, [0])
