"""Runs the example and the Python blocks of docs/python.md in a scratch folder."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import support

BLOCK = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def run(arguments, folder):
    return subprocess.run([sys.executable, *arguments], cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "MPLBACKEND": "Agg"})


class Documentation(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_blocks_run_in_order(self):
        (self.folder / "data").symlink_to(support.ROOT / "data")
        (self.folder / "tests").symlink_to(support.ROOT / "tests")
        blocks = BLOCK.findall((support.ROOT / "docs" / "python.md").read_text())
        self.assertGreater(len(blocks), 4)
        done = run(["-c", "\n".join(blocks)], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_example_plots(self):
        script = support.ROOT / "apps" / "examples" / "replay_and_plot.py"
        done = run([script, support.ROOM, "plot.png"], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("APE RMSE", done.stdout)
        self.assertEqual((self.folder / "plot.png").read_bytes()[:4], b"\x89PNG")
