"""A program that has set another locale gets the same texts."""
import locale
import os
import subprocess
import tempfile
import unittest

import numpy as np

import msc_vo
import support


def message(action):
    try:
        action()
    except (ValueError, RuntimeError) as error:
        return str(error)
    raise AssertionError("no error")


def texts(folder):
    """Texts with numbers: files, representations, errors."""
    result = support.room_result()
    result.write_trajectory(os.path.join(folder, "trajectory.txt"))
    window, options = msc_vo.read_window(support.WINDOWS / "room.txt")
    options["solver"] = "ceres"
    summary = msc_vo.solve_window(window, options)
    msc_vo.write_window(os.path.join(folder, "window.txt"), window)
    image = support.room_images()[0]
    raw = np.ones((480, 640), np.uint16)
    odometry = support.room_odometry()
    found = [repr(support.room().camera), repr(result), repr(result.frames[1]), repr(msc_vo.Options(threads=1)),
             repr(msc_vo.evaluate(support.ROOM / "groundtruth.txt", result)),
             repr(msc_vo.evaluate(support.ROOM / "groundtruth.txt", result).ape), repr(summary),
             summary.report(), summary.message,
             message(lambda: msc_vo.Camera(1e6, 525.5, 319.5, 239.5, 640, 480)),
             message(lambda: odometry.process(1.5, image.gray, raw, depth_scale=0.00125)),
             message(lambda: odometry.process(1.5, image.gray, image.depth, depth_delay=1234.5)),
             message(lambda: msc_vo.Options(**{"features.lines.min_length": 1234.5})),
             message(lambda: msc_vo.evaluate(result.trajectory, result.trajectory[:2])),
             message(lambda: msc_vo.Sequence("/dev/null/1.5"))]
    for name in ("trajectory.txt", "window.txt"):
        with open(os.path.join(folder, name)) as file:
            found.append(file.read())
    return found


class Locale(unittest.TestCase):
    def test_texts_are_the_same_in_another_locale(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "de_DE.UTF-8")
            try:
                subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", path], check=False,
                               capture_output=True)
            except FileNotFoundError:
                self.skipTest("there is no localedef")
            if not os.path.exists(path):
                self.skipTest("localedef has no sources of de_DE")
            expected = texts(folder)
            os.environ["LOCPATH"] = folder
            try:
                locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
                self.assertEqual(locale.localeconv()["decimal_point"], ",")
                found = texts(folder)
            finally:
                locale.setlocale(locale.LC_ALL, "C")
                del os.environ["LOCPATH"]
        for a, b in zip(found, expected):
            self.assertEqual(a, b)


if __name__ == "__main__":
    unittest.main()
