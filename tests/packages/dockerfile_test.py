#!/usr/bin/env python3
"""The steps of cmake/Dockerfile are those of the scripts that are tested: dockerfile_test.py ROOT."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop())


def read(name):
    return (ROOT / name).read_text()


class Dockerfile(unittest.TestCase):
    def setUp(self):
        text = re.sub(r"\\\n", " ", re.sub(r"(?m)^#.*\n", "", read("cmake/Dockerfile")))
        self.build, self.image = re.split(r"(?m)^FROM ", text)[1:]

    def test_both_stages_are_the_tested_debian(self):
        default = re.search(r"(?m)^ARG DEBIAN=(\d+)$", read("cmake/Dockerfile"))
        self.assertIn(default.group(1), re.findall(r"debian:(\d+)", read(".github/workflows/ci.yml")))
        for stage in (self.build, self.image):
            self.assertTrue(stage.startswith("debian:${DEBIAN}"))

    def test_builds_with_the_package_script(self):
        self.assertIn("RUN cmake/make_packages.sh /packages\n", self.build)
        self.assertLess(self.build.index("debian_packages"), self.build.index("COPY . ."))
        self.assertIn("fakeroot dpkg-dev", self.build)
        for name in ("debian_packages.txt", "debian_packages_report.txt",
                     "debian_packages_optional.txt"):
            self.assertIn(f"cmake/{name}", self.build)
            self.assertTrue((ROOT / "cmake" / name).exists())
        # As cmake/install_packages.sh reads the lists.
        pattern = "--extended-regexp '^(#|$)'"
        self.assertIn(pattern, self.build)
        self.assertIn(pattern, read("cmake/install_packages.sh"))

    def test_installs_the_packages_that_are_built(self):
        names = set(re.findall(r"msc_vo_package\(\w+ ([\w-]+)", read("cmake/MscVoPackages.cmake")))
        copied = set(re.findall(r"/packages/([\w-]+)_\*\.deb", self.image))
        self.assertEqual(copied, names - {"libmsc-vo-dev"})
        self.assertIn("apt-get install --yes --no-install-recommends /packages/*.deb", self.image)
        for name in names:
            self.assertIn(f"/packages/{name}_*.deb", read("tests/packages/run.sh"))
            self.assertIn(f"`{name}`", read("docs/packages.md"))
        self.assertIn('ENTRYPOINT ["msc_vo"]', self.image)


if __name__ == "__main__":
    unittest.main()
