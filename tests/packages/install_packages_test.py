#!/usr/bin/env python3
"""cmake/install_packages.sh on releases with other packages: install_packages_test.py ROOT.

Programs of the same names stand in for those of Debian: they know the packages of a release, and none is
installed.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop())

# All of apt-get, apt-cache and dpkg-query: `release` has the packages, `installed` gets those that are
# installed, and like apt-get it installs none of its arguments if the release lacks one of them.
PROGRAM = """#!/bin/sh
folder=$(dirname "$0")
case $(basename "$0"):$1 in
  dpkg-query:*) for last; do :; done
    grep -qxF "$last" "$folder/installed" && printf installed;;
  apt-cache:show) grep -qxF "$2" "$folder/release";;
  apt-get:*)
    while [ $# -gt 0 ] && [ "$1" != install ] && [ "$1" != update ]; do shift; done
    [ "$1" = update ] && exit 0
    shift
    for package; do
      case $package in -*) continue;; esac
      grep -qxF "$package" "$folder/release" || { echo "E: Unable to locate package $package"; exit 100; }
      grep -qxF "$package" "$folder/broken" && exit 100
    done
    for package; do case $package in -*) ;; *) echo "$package" >> "$folder/installed";; esac; done;;
  sudo:*) exec "$@";;
esac
"""


def packages(name):
    lines = (ROOT / "cmake" / name).read_text().splitlines()
    return {line for line in lines if line and not line.startswith("#")}


NEEDED = packages("debian_packages.txt")
LISTS = {path.stem.removeprefix("debian_packages_"): packages(path.name)
         for path in (ROOT / "cmake").glob("debian_packages_*.txt")}


class InstallPackages(unittest.TestCase):
    def install(self, lists, release, broken=()):
        """Returns the exit code, the output and the packages that are installed then."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for program in ("apt-get", "apt-cache", "dpkg-query", "sudo"):
                (folder / program).write_text(PROGRAM)
                (folder / program).chmod(0o755)
            for file, content in (("release", release), ("installed", ()), ("broken", broken)):
                (folder / file).write_text("".join(f"{package}\n" for package in sorted(content)))
            result = subprocess.run([ROOT / "cmake/install_packages.sh", *lists], text=True,
                                    env={"PATH": f"{name}:{os.environ['PATH']}"},
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            return result.returncode, result.stdout, set((folder / "installed").read_text().split())

    def test_goes_on_without_packages_that_the_release_does_not_have(self):
        wanted = NEEDED.union(*LISTS.values())
        for absent in ({min(content) for content in LISTS.values()}, wanted - NEEDED):
            code, output, installed = self.install(sorted(LISTS), wanted - absent)
            self.assertEqual((code, installed), (0, wanted - absent), output)
            for package in absent:
                self.assertIn(f"Going on without {package}", output)

    def test_goes_on_without_packages_that_cannot_be_installed(self):
        wanted = NEEDED | LISTS["report"] | LISTS["optional"]
        broken = sorted(LISTS["optional"])[0]
        code, output, installed = self.install(["report", "optional"], wanted, {broken})
        self.assertEqual((code, installed), (0, wanted - {broken}), output)
        self.assertIn(f"Going on without {broken}", output)

    def test_ends_where_a_needed_package_is_missing(self):
        package = sorted(NEEDED)[0]
        code, output, _ = self.install(["report"], (NEEDED | LISTS["report"]) - {package})
        self.assertNotEqual(code, 0)
        self.assertIn(package, output)

    def test_refuses_unknown_lists(self):
        self.assertEqual(self.install(["reports"], NEEDED)[0], 2)

    def test_the_demo_needs_no_package_of_developers(self):
        demo = (ROOT / "apps/demo.sh").read_text()
        lists = re.search(r"^cmake/install_packages.sh(.*)$", demo, re.M).group(1).split()
        self.assertTrue(lists)
        release = NEEDED.union(*(LISTS[name] for name in lists))
        self.assertFalse(release & (LISTS["developer"] | LISTS["tests"] | LISTS["clang"]))
        code, output, installed = self.install(lists, release)
        self.assertEqual((code, installed), (0, release), output)

    def test_no_package_is_listed_twice(self):
        names = [name for content in (NEEDED, *LISTS.values()) for name in content]
        self.assertEqual(len(names), len(set(names)))


if __name__ == "__main__":
    unittest.main()
