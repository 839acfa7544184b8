import ast
import importlib.util
import inspect
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import msc_vo
import support

PACKAGE = pathlib.Path(msc_vo.__file__).parent
VALUES = {"__copy__", "__deepcopy__", "__eq__", "__hash__"}


def public(names):
    return {name for name in names if not name.startswith("_")}


def public_objects():
    """All public classes, functions, methods and properties, by their full name."""
    for name in public(vars(msc_vo)):
        value = getattr(msc_vo, name)
        if inspect.ismodule(value):
            continue
        yield name, value
        if isinstance(value, type):
            for member in public(vars(value)):
                if not issubclass(value, Exception):
                    found = inspect.getattr_static(value, member)
                    yield f"{name}.{member}", getattr(found, "__func__", found)


class Stubs(unittest.TestCase):
    """The stubs name what the module has, and nothing else."""

    def setUp(self):
        body = ast.parse((PACKAGE / "__init__.pyi").read_text()).body
        self.classes = {node.name: node for node in body if isinstance(node, ast.ClassDef)}
        self.functions = {node.name: node for node in body if isinstance(node, ast.FunctionDef)}

    def members(self, name):
        node = self.classes[name]
        members = {m.name: m for m in node.body if isinstance(m, ast.FunctionDef)}
        members |= {m.target.id: m for m in node.body if isinstance(m, ast.AnnAssign)}
        for base in node.bases:
            if base.id in self.classes:
                members = {**self.members(base.id), **members}
        return members

    def test_names_of_the_module(self):
        modules = {name for name, value in vars(msc_vo).items() if inspect.ismodule(value)}
        self.assertEqual(public(self.classes) | public(self.functions), public(dir(msc_vo)) - modules)

    def test_members_of_the_classes(self):
        for name in public(self.classes):
            value = getattr(msc_vo, name)
            bases = [base for base in value.__mro__ if base.__module__.startswith("msc_vo")]
            actual = {member for base in bases for member in vars(base)}
            if name == "UnreadableImage":
                actual = set()
            self.assertEqual(public(self.members(name)), public(actual), name)

    def test_properties_are_read_only(self):
        """They are Final or properties in the stubs, and nothing else is."""
        for name, value in public_objects():
            if "." not in name:
                continue
            owner, member = name.split(".")
            node = self.members(owner)[member]
            if isinstance(node, ast.AnnAssign):
                is_read_only = re.match(r"Final\[.+\]$", ast.unparse(node.annotation)) is not None
            else:
                is_read_only = [ast.unparse(d) for d in node.decorator_list] == ["property"]
            self.assertEqual(is_read_only, isinstance(value, property) and value.fset is None, name)

    def test_arguments(self):
        for name, value in public_objects():
            node = self.functions.get(name)
            if "." in name:
                owner, member = name.split(".")
                node = self.members(owner)[member]
            if not isinstance(node, ast.FunctionDef) or isinstance(value, property):
                continue
            documented = re.match(r"\w+\(((?:[^()]|\([^()]*\))*)\)", value.__doc__ or "")
            if documented is None:  # written in Python
                actual = set(inspect.signature(value).parameters)
            else:
                actual = set(re.findall(r"(?:^|, )\*?(\w+): ", documented.group(1)))
            arguments = {a.arg for a in node.args.args + node.args.kwonlyargs}
            self.assertEqual(arguments - {"self"}, actual - {"self", "arg0"}, name)

    def test_everything_is_documented(self):
        for name, value in public_objects():
            text = value.fget.__doc__ if isinstance(value, property) else value.__doc__
            text = re.sub(r"^\w+\(.*\) -> .*$", "", text or "", flags=re.MULTILINE)
            self.assertTrue(text.strip(), f"{name} has no docstring")

    def test_documentation_names_python_types(self):
        for name, value in public_objects():
            self.assertNotIn("::", value.__doc__ or "", name)

    def test_the_package_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())


PROGRAM = '''
import copy
import pathlib
import pickle
from typing import Dict, List, Optional

import numpy as np

import msc_vo

sequence: msc_vo.Sequence = msc_vo.Sequence(pathlib.Path("room"))
stamps: List[float] = [image.timestamp for image in sequence]
result = msc_vo.replay("room", {"mode": "pl-vo"}, on_frame=lambda frame: print(frame.status))
result = msc_vo.replay(sequence, msc_vo.Options(mode="pl-vo"))
last: msc_vo.FrameResult = copy.deepcopy(result.frames[-1])
same: bool = pickle.loads(pickle.dumps(sequence.camera)) == sequence.camera
seen: Dict[msc_vo.Camera, int] = {sequence.camera: len(sequence)}
lens: Optional[msc_vo.Camera] = sequence.lens.recorded
odometry = msc_vo.Odometry(None, sequence.camera, [0.0, 0.0, 0.0, 0.0])
odometry.set_pose_factors(lambda frame: None)
odometry.set_tracking_observer(lambda tracked: print(tracked.points.shape))
frame = odometry.process(0.0, np.zeros((480, 640), np.uint8), np.zeros((480, 640), np.float32))
sigma: float = result.covariances[0, 0, 0] + result.trajectory[0, 0]
window = msc_vo.WindowData(sequence.camera)
window.add_point_observations(**odometry.map().window.point_observations)
'''
WRONG = [("msc_vo.Camera('wide')", "Camera"), ("odometry.process(0.0)", "process"),
         ("result.covariance", "covariance"), ("window.add_points([1])", "add_points"),
         ("msc_vo.Lens('wide', [])", "Lens"), ("sequence.camera.fx = 500.0", "fx"),
         ("frame.cam_from_world = np.eye(4)", "cam_from_world"), ("odometry.frames = []", "frames"),
         ("window.points = np.zeros((0, 3))", "points"),
         ("width: str = sequence.camera.width", "int")]


class Mypy(unittest.TestCase):
    """mypy accepts right programs, the example among them, and finds the errors of wrong ones."""

    def setUp(self):
        self.mypy = [sys.executable, "-m", "mypy"]
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("there is no mypy (python3-mypy)")

    def check(self, *arguments):
        with tempfile.TemporaryDirectory() as cache:
            return subprocess.run(
                [*self.mypy, "--strict", "--no-error-summary", "--cache-dir", cache, *arguments],
                env={**os.environ, "MYPYPATH": str(PACKAGE.parent)}, capture_output=True, text=True)

    def test_programs(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "program.py")
            program.write_text(PROGRAM + "".join(f"{line}\n" for line, _ in WRONG))
            example = support.ROOT / "apps" / "examples" / "replay_and_plot.py"
            done = self.check("--disable-error-code", "import", str(program), str(example))
        errors = [line for line in done.stdout.splitlines() if ": error:" in line]
        first = PROGRAM.count("\n") + 1
        for number, (line, name) in enumerate(WRONG):
            mine = [error for error in errors if f"program.py:{first + number}:" in error]
            self.assertTrue(any(name in error for error in mine), (line, done.stdout))
            errors = [error for error in errors if error not in mine]
        self.assertEqual(errors, [], done.stdout + done.stderr)

    def test_the_stubs_themselves(self):
        done = self.check("-p", "msc_vo")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
