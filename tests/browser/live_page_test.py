#!/usr/bin/env python3
"""Watches a replay in headless Chromium while it runs.

    live_page_test.py MSC_VO
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import urllib.request

import browser


class LivePageTest(unittest.TestCase):
    command = None

    @classmethod
    def setUpClass(cls):
        cls.sequences = tempfile.TemporaryDirectory(prefix="msc_vo_live_")
        cls.sequence = str(pathlib.Path(cls.sequences.name) / "room")
        subprocess.run([cls.command, "synthesize", cls.sequence, "--frames", "120", "--width", "160"],
                       check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.sequences.cleanup()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="msc_vo_live_")
        self.browser = browser.Browser()
        self.run = None

    def tearDown(self):
        if self.run is not None:
            self.run.kill()
            self.run.wait()
            self.run.stderr.close()
        self.browser.close()
        self.folder.cleanup()

    def start(self, *arguments):
        """Starts a replay and opens its page."""
        self.run = subprocess.Popen(
            [self.command, "replay", self.sequence, "--output", self.folder.name, "--quiet",
             "--view", "0", *arguments], stderr=subprocess.PIPE, text=True)
        line = self.run.stderr.readline()
        match = re.search(r"live view: (http://127\.0\.0\.1:\d+/)", line)
        self.assertTrue(match, line)
        return match.group(1)

    def count(self):
        match = re.search(r"(\d+) of \d+ frames", self.browser.text("#live-state"))
        return int(match.group(1)) if match else 0

    def test_follows_pauses_and_ends_with_the_report(self):
        # A browser starts slowly: the run waits for it.
        url = self.start()
        self.control(url, "pause")
        self.browser.driver.get(url)
        self.browser.wait_for(lambda: "paused" in self.browser.text("#live-state"), what="pause")
        self.browser.wait_for(lambda: self.count() > 0, what="a frame")
        paused = self.count()
        self.browser.changed_pixels("scene-canvas")
        for _ in range(3):
            self.browser.click("#live-step")
        self.browser.wait_for(lambda: self.count() == paused + 3, what="three steps")
        self.browser.changed_pixels("frame-canvas")
        self.browser.script("""
            const speed = document.getElementById("live-speed");
            speed.value = "0.25"; speed.dispatchEvent(new Event("change"));""")
        self.browser.click("#live-pause")
        self.browser.wait_for(lambda: self.count() > paused + 10, what="more frames")
        # At once: on a slow machine, the run would end during a comparison of pictures.
        self.browser.click("#live-pause")
        self.browser.wait_for(lambda: "paused" in self.browser.text("#live-state"), what="pause")
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 100)
        self.assertNotEqual(self.browser.changed_pixels("frame-canvas"), 0)
        self.browser.wait_for(self.is_still, what="a still picture")
        self.browser.click("button[data-layer=lines]")
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 100)
        following = self.browser.script("return Number(document.getElementById('time-slider').value)")
        self.browser.click("#live-follow")
        self.browser.press(browser.Keys.HOME)
        self.assertGreater(following, 0)
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 5)

        self.control(url, "speed&value=0")
        self.browser.click("#live-pause")
        self.browser.wait_for(lambda: "APE RMSE" in self.browser.text("body"), what="the report")
        self.assertEqual(self.run.wait(timeout=20), 0)
        self.browser.wait_for(lambda: self.browser.find("#viewer").is_displayed(), what="the viewer")
        self.assertFalse(self.browser.find("#live-bar").is_displayed())
        self.browser.changed_pixels("scene-canvas")
        self.browser.press("t")
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 500)
        self.assertEqual(self.browser.errors(), [])

    def is_still(self):
        return self.browser.changed_pixels("scene-canvas") == 0

    def control(self, url, action):
        request = urllib.request.Request(f"{url}control?action={action}", method="POST", data=b"",
                                         headers={"X-Msc-Vo": "control"})
        urllib.request.urlopen(request).close()

    def test_moves_into_the_map_of_an_earlier_run(self):
        home = str(pathlib.Path(self.folder.name) / "home.map")
        subprocess.run([self.command, "replay", self.sequence, "--output", self.folder.name, "--quiet",
                        "--map", home], check=True)
        url = self.start("--localize", home)
        self.control(url, "pause")
        self.browser.driver.get(url)
        self.browser.wait_for(lambda: self.count() > 0, what="a frame")
        self.assertFalse(self.browser.find("#scene-label").is_displayed())
        self.assertFalse(self.browser.find("#place").is_displayed())
        self.browser.script("""
            const speed = document.getElementById("live-speed");
            speed.value = "0.25"; speed.dispatchEvent(new Event("change"));""")
        self.browser.click("#live-pause")
        self.browser.wait_for(lambda: "found in the map" in self.browser.text("#scene-label"),
                              what="the place in the map")
        # The map, and where the frames before lie in it, come with the next keyframe.
        self.browser.wait_for(lambda: self.browser.text("#scene-legend").splitlines() ==
                              ["trajectory", "earlier sessions"], what="the sessions of the map")
        self.assertRegex(self.browser.text("#place"), r"(?s)frame \d+.*keyframe \d+")
        self.control(url, "speed&value=0")
        self.browser.wait_for(lambda: "APE RMSE" in self.browser.text("body"), what="the report")
        self.assertEqual(self.run.wait(timeout=20), 0)

    def test_a_vanished_viewer_does_not_stop_the_run(self):
        url = self.start()
        self.control(url, "speed&value=0.1")  # 40 seconds, enough to open the page
        self.browser.driver.get(url)
        self.browser.wait_for(lambda: self.count() > 0, what="a frame")
        self.browser.driver.get("about:blank")
        self.control(url, "speed&value=0")
        self.assertEqual(self.run.wait(timeout=60), 0)
        self.assertTrue((pathlib.Path(self.folder.name) / "report.html").exists())


if __name__ == "__main__":
    LivePageTest.command = sys.argv[1]
    browser.main(LivePageTest)
