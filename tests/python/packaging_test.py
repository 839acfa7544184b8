"""`pip install .` and `pip wheel .` of the checkout, without a network. A stand-in for CMake installs
the module of this build, so that the test does not compile."""
import email
import hashlib
import base64
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

import msc_vo
import support

PACKAGE = pathlib.Path(msc_vo.__file__).parent
STAND_IN = """#!{python}
import pathlib, shutil, sys
arguments = sys.argv[1:]
with open({log!r}, "a") as log:
    print(*arguments, file=log)
if "--target" in arguments and "help" in arguments:
    print("... msc_vo_python" if {has_module} else "... all")
if "--install" in arguments:
    prefix = pathlib.Path(arguments[arguments.index("--prefix") + 1])
    shutil.copytree({package!r}, prefix / "package" / "msc_vo",
                    ignore=shutil.ignore_patterns("__pycache__"))
"""


class Packaging(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.write_stand_in(True)
        if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True).returncode:
            self.skipTest("there is no pip (python3-pip)")

    def write_stand_in(self, has_module):
        program = self.folder / "bin" / "cmake"
        program.parent.mkdir(exist_ok=True)
        program.write_text(STAND_IN.format(python=sys.executable, log=str(self.folder / "log"),
                                           has_module=has_module, package=str(PACKAGE)))
        program.chmod(0o755)

    def run_python(self, *arguments, python=sys.executable, **environment):
        clean = {name: value for name, value in os.environ.items()
                 if name != "PYTHONPATH" and not name.startswith("PIP_")}
        clean |= {"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "PIP_NO_INDEX": "1",
                  "PIP_NO_CACHE_DIR": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", **environment}
        return subprocess.run([python, *map(str, arguments)], env=clean, cwd=self.folder, text=True,
                              capture_output=True)

    def wheel(self, *arguments):
        done = self.run_python("-m", "pip", "wheel", "--no-deps", "-w", "out", *arguments, support.ROOT)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        found, = (self.folder / "out").glob("*.whl")
        return found

    def test_wheels_are_complete(self):
        path = self.wheel()
        again = path.read_bytes()
        name, version, python, abi, platform = path.stem.split("-")
        self.assertEqual((name, version), ("msc_vo", msc_vo.__version__))
        self.assertEqual(python, f"cp{sys.version_info[0]}{sys.version_info[1]}")
        self.assertEqual(abi, python)
        self.assertRegex(platform, "^linux_")
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            self.assertLessEqual({f"msc_vo/{entry.name}" for entry in PACKAGE.iterdir() if entry.is_file()},
                                 set(names))
            info = f"msc_vo-{version}.dist-info"
            metadata = email.message_from_bytes(archive.read(f"{info}/METADATA"))
            self.assertEqual((metadata["Name"], metadata["Version"]), ("msc-vo", version))
            self.assertEqual(metadata.get_all("Requires-Dist"), ["numpy"])
            self.assertEqual(metadata["License"], "BSD-3-Clause")
            self.assertIn("RGB-D", metadata["Summary"])
            self.assertTrue(metadata.get_payload().startswith("# msc_vo"))
            marks = email.message_from_bytes(archive.read(f"{info}/WHEEL"))
            self.assertEqual(marks["Root-Is-Purelib"], "false")
            self.assertEqual(marks["Tag"], f"{python}-{abi}-{platform}")
            self.assertEqual(archive.read(f"{info}/LICENSE"), (support.ROOT / "LICENSE").read_bytes())
            record = dict(line.rsplit(",", 2)[:2] for line in
                          archive.read(f"{info}/RECORD").decode().splitlines())
            self.assertEqual(set(record), set(names))
            for entry in names:
                digest = base64.urlsafe_b64encode(hashlib.sha256(archive.read(entry)).digest())
                if not entry.endswith("RECORD"):
                    self.assertEqual(record[entry], "sha256=" + digest.decode().rstrip("="), entry)
        path.unlink()
        self.assertEqual(self.wheel("--no-build-isolation").read_bytes(), again)

    def test_installs_into_a_virtual_environment(self):
        if subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", self.folder / "venv"],
                          capture_output=True).returncode:
            self.skipTest("there is no venv (python3-venv)")
        python = self.folder / "venv" / "bin" / "python"
        for arguments in ([], ["--no-build-isolation"]):
            done = self.run_python("-m", "pip", "install", *arguments, support.ROOT, python=python)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            code = ("import msc_vo, importlib.metadata as m; print(msc_vo.__file__, m.version('msc-vo'), "
                    "msc_vo.Camera(500, 500, 320, 240, 640, 480))")
            done = self.run_python("-c", code, python=python)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(str(self.folder / "venv"), done.stdout)
            self.assertIn(msc_vo.__version__, done.stdout)
            done = self.run_python("-m", "pip", "uninstall", "-y", "msc-vo", python=python)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertNotEqual(self.run_python("-c", "import msc_vo", python=python).returncode, 0)

    def test_builds_for_the_interpreter_and_leaves_the_checkout_as_it_is(self):
        def state():
            folders = [support.ROOT, support.ROOT / "apps" / "python",
                       support.ROOT / "apps" / "python" / "packaging"]
            return {path for folder in folders for path in folder.iterdir()} - {
                folders[-1] / "__pycache__"}

        before = state()
        self.wheel("--config-settings", f"build-dir={self.folder / 'kept'}",
                   "--config-settings", "cmake-args=-DMSC_VO_NATIVE=ON -DX='a b'")
        log = (self.folder / "log").read_text()
        self.assertRegex(log, r"-DMSC_VO_PYTHON_EXECUTABLE=\S*python")
        self.assertIn(f"-B {self.folder / 'kept'}", log)
        self.assertIn("-DMSC_VO_NATIVE=ON -DX=a b", log)
        self.assertIn("--target msc_vo_python", log)
        self.assertEqual(state(), before)

    def test_what_is_missing_is_named(self):
        def failure(*arguments, **environment):
            done = self.run_python("-m", "pip", "wheel", "--no-deps", "-w", "out", *arguments,
                                   support.ROOT, **environment)
            self.assertNotEqual(done.returncode, 0)
            return done.stdout + done.stderr

        self.assertIn("unknown setting 'build-folder'", failure("--config-settings", "build-folder=x"))
        self.write_stand_in(False)
        self.assertIn("pybind11-dev", failure())
        (self.folder / "bin" / "cmake").write_text("#!/bin/sh\nexit 3\n")
        self.assertIn("cmake has failed", failure())
        (self.folder / "empty").mkdir()
        self.assertIn("apt install cmake", failure(PATH=str(self.folder / "empty")))

    def call_back_end(self, call):
        code = f"import sys; sys.path.insert(0, sys.argv[1]); import msc_vo_build; msc_vo_build.{call}"
        return self.run_python("-B", "-c", code, support.ROOT / "apps" / "python" / "packaging")

    def test_settings_may_be_lists(self):
        """As pip 23.1 and later give those that occur several times."""
        done = self.call_back_end("""build_wheel('.', {'cmake-args': ['-DX=1', '-DY="a b"']})""")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("-DX=1 -DY=a b", (self.folder / "log").read_text())
        done = self.call_back_end("build_wheel('.', {'build-dir': ['x', 'y']})")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("build-dir", done.stderr)

    def test_there_is_no_source_distribution(self):
        done = self.call_back_end("build_sdist('.')")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("git archive", done.stderr)


if __name__ == "__main__":
    unittest.main()
