#!/usr/bin/env python3
"""Manual pages and bash completion against --help: command_pages_test.py MSC_VO."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

COMMAND = sys.argv.pop()


def run(*arguments, **options):
    return subprocess.run(arguments, capture_output=True, text=True, **options)


def help_of(*command):
    return run(COMMAND, *command, "--help", check=True).stdout


def options_of(*command):
    """The options that --help lists: words that begin a line of its list, separated by commas."""
    names = re.findall(r"^\s+(?:-\w,)?(--[\w,-]+)", help_of(*command), re.MULTILINE)
    return {name for listed in names for name in listed.split(",")}


def commands():
    listed = help_of().split("Subcommands:\n")[1].split("\n\n")[0]
    return re.findall(r"^  ([\w-]+)", listed, re.MULTILINE)


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        run(COMMAND, "generate", "man", cls.folder / "man", check=True)
        run(COMMAND, "generate", "completion", cls.folder / "completion", check=True)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def page(self, name):
        return (self.folder / "man" / f"{name}.1").read_text().replace("\\-", "-")

    def test_every_command_has_a_page(self):
        self.assertGreaterEqual(len(commands()), 6)
        self.assertNotIn("generate", commands())
        pages = {path.name for path in (self.folder / "man").iterdir()}
        self.assertEqual(pages, {"msc_vo.1"} | {f"msc_vo-{name}.1" for name in commands()})
        for name in commands():
            self.assertIn(f"\\fB{name}\\fR", self.page("msc_vo"))

    def test_every_option_is_on_its_page(self):
        for name in commands():
            listed = options_of(name)
            self.assertIn("--help", listed)
            on_page = set(re.findall(r"\\fB(--[\w-]+)\\fR", self.page(f"msc_vo-{name}")))
            self.assertEqual(on_page, listed, name)
        self.assertIn("\\fB--version\\fR", self.page("msc_vo"))

    def test_pages_have_examples_and_exit_codes(self):
        for name in commands():
            page = self.page(f"msc_vo-{name}")
            for section in ("NAME", "SYNOPSIS", "OPTIONS", "EXAMPLES", "EXIT STATUS", "SEE ALSO"):
                self.assertIn(f".SH {section}\n", page, name)
            self.assertIn(f"msc_vo {name} ", page.split(".SH EXAMPLES")[1])

    @unittest.skipUnless(shutil.which("man") and shutil.which("groff"), "man is not installed")
    def test_man_has_no_warnings(self):
        for page in sorted((self.folder / "man").iterdir()):
            done = run("man", "--warnings", "-E", "UTF-8", "-l", page,
                       env={"LC_ALL": "C.UTF-8", "MANWIDTH": "80", "PATH": "/usr/bin:/bin"})
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name)
            self.assertIn("SYNOPSIS", done.stdout)
            self.assertNotIn("\\f", done.stdout)

    def complete(self, *words):
        """What bash offers for the last of `words` after msc_vo."""
        script = (f'source "{self.folder}/completion"; COMP_WORDS=(msc_vo "$@"); '
                  'COMP_CWORD=$#; _msc_vo; printf "%s\\n" "${COMPREPLY[@]}"')
        done = run("bash", "--norc", "-c", script, "bash", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return set(done.stdout.split())

    def test_completion_offers_every_command_and_option(self):
        self.assertLessEqual(set(commands()), self.complete(""))
        self.assertEqual(self.complete("rep"), {"replay"})
        for name in commands():
            self.assertEqual({word for word in self.complete(name, "--") if word != "-h"},
                             options_of(name), name)

    def test_completion_offers_values(self):
        self.assertEqual(self.complete("replay", "--mode", ""), {"pl-vo", "pl-vo-depth", "msc-vo"})
        self.assertEqual(self.complete("replay", "folder", "--mode", "m"), {"msc-vo"})
        self.assertEqual(self.complete("evaluate", "--align", "n"), {"none"})
        self.assertEqual(self.complete("replay", "--output", ""), set())  # left to file names
        self.assertEqual(self.complete("replay", ""), set())
        self.assertIn("debug", self.complete("--log-level", ""))

    def test_completion_is_registered(self):
        script = f'source "{self.folder}/completion"; complete -p msc_vo'
        self.assertIn("-F _msc_vo msc_vo", run("bash", "--norc", "-c", script).stdout)


if __name__ == "__main__":
    unittest.main()
