#!/usr/bin/env python3
"""Opens the report of a replay in headless Chromium and uses it.

    report_page_test.py MSC_VO
"""
import array
import base64
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import browser
from browser import Keys

SEQUENCE = pathlib.Path(__file__).resolve().parents[2] / "data" / "room"


class ReportPageTest(unittest.TestCase):
    command = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="msc_vo_report_")
        subprocess.run([cls.command, "replay", SEQUENCE, "--output", cls.folder.name, "--quiet"],
                       check=True)
        cls.report = pathlib.Path(cls.folder.name) / "report.html"
        cls.browser = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def setUp(self):
        self.browser.set_media()
        self.browser.driver.get(self.report.as_uri())
        self.browser.settle()

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])

    def frame(self):
        return int(self.browser.find("#time-slider").get_property("value"))

    def last_frame(self):
        return int(self.browser.find("#time-slider").get_property("max"))

    def test_shows_the_viewer_and_plots(self):
        self.assertTrue(self.browser.find("#viewer").is_displayed())
        self.assertTrue(self.browser.find("figure[data-chart=error] .chart").is_displayed())

    def test_layers_can_be_hidden(self):
        self.browser.changed_pixels("scene-canvas")
        self.browser.click("button[data-layer=lines]")
        hidden = self.browser.changed_pixels("scene-canvas")
        self.assertGreater(hidden, 500)
        self.browser.press("1")  # the key of the same layer
        self.assertEqual(self.browser.changed_pixels("scene-canvas"), hidden)
        button = self.browser.find("button[data-layer=lines]")
        self.assertEqual(button.get_attribute("aria-pressed"), "true")

    def test_every_layer_draws_something(self):
        self.browser.changed_pixels("scene-canvas")
        for layer in ["points", "keyframes", "trajectory", "ground truth", "axes", "camera"]:
            self.browser.click(f"button[data-layer='{layer}']")
            self.assertGreater(self.browser.changed_pixels("scene-canvas"), 5, layer)

    def test_a_fused_surface_is_a_layer(self):
        page = self.report.with_name("with_surface.html")
        shutil.copy(self.report, page)
        fuse = subprocess.run([self.command, "fuse", SEQUENCE, self.report.with_name("trajectory.txt"),
                               "--output", page.with_suffix(".ply"), "--voxel", "0.04", "--quiet",
                               "--report", page], stderr=subprocess.PIPE, text=True)
        if "msc_vo_fusion.so is not installed" in fuse.stderr:
            self.skipTest("built without Open3D")
        self.assertEqual(fuse.returncode, 0, fuse.stderr)
        self.assertFalse(self.browser.find("button[data-layer=surface]").is_displayed())
        self.browser.driver.get(page.as_uri())
        self.assertTrue(self.browser.find("button[data-layer=surface]").is_displayed())
        self.browser.changed_pixels("scene-canvas")
        self.browser.press("8")
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 20_000)
        self.browser.press("c")  # the image is not hidden by the surface
        self.browser.changed_pixels("scene-canvas")
        self.browser.press("8")
        self.assertEqual(self.browser.changed_pixels("scene-canvas"), 0)

    def test_planes_are_a_layer_of_runs_with_planes(self):
        folder = self.report.with_name("with_planes")
        subprocess.run([self.command, "replay", SEQUENCE, "--output", folder, "--quiet"],
                       check=True)
        self.browser.driver.get((folder / "report.html").as_uri())
        self.browser.settle()
        self.assertTrue(self.browser.find("button[data-layer=planes]").is_displayed())
        self.browser.changed_pixels("scene-canvas")
        self.browser.click("button[data-layer=planes]")
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 5_000)

    def open_changed(self, change):
        """Opens a copy of the report whose data block `change` has changed."""
        html = self.report.read_text()
        block = re.search(r'(<script type="application/json" id="run-data">)(.*?)</script>', html)
        data = json.loads(block.group(2))
        change(data)
        page = self.report.with_name("changed.html")
        page.write_text(html[:block.start(2)] + json.dumps(data) + html[block.end(2):])
        self.browser.driver.get(page.as_uri())
        self.browser.settle()

    def legend(self):
        return self.browser.text("#scene-legend").splitlines()

    def pixels_of(self, color):
        """Pixels of the 3-D view in about this color of the style sheet."""
        self.browser.changed_pixels("scene-canvas")
        return self.browser.script("""
            const color = getComputedStyle(document.documentElement)
                .getPropertyValue("--" + arguments[0]).trim();
            const rgb = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
            const pixels = window.keptPixels["scene-canvas"];
            let count = 0;
            for (let i = 0; i < pixels.length; i += 4) {
              if (pixels[i + 3] > 200 && rgb.every((c, k) => Math.abs(pixels[i + k] - c) < 12)) ++count;
            }
            return count;""", color)

    def test_shows_what_loops_have_changed(self):
        self.assertFalse(self.browser.find("#scene-legend").is_displayed())
        for layer in ["loops", "before loops", "earlier sessions", "found"]:
            self.assertFalse(self.browser.find(f"button[data-layer='{layer}']").is_displayed())

        def close_a_loop(data):
            pose = array.array("f", base64.b64decode(data["frames"]["pose"]))
            path = [1.2 * x for i in range(0, len(pose), 7) for x in pose[i:i + 3]]
            path[3:6] = [float("nan")] * 3
            data["odometry"] = base64.b64encode(array.array("f", path)).decode()
            data["loops"] = [[len(pose) // 7 - 1, 0]]

        self.open_changed(close_a_loop)
        self.assertEqual(self.legend(), ["trajectory", "before loops were closed",
                                         "loop: two frames at one place"])
        self.browser.changed_pixels("scene-canvas")
        for layer in ["before loops", "loops"]:
            self.browser.click(f"button[data-layer='{layer}']")
            self.assertGreater(self.browser.changed_pixels("scene-canvas"), 20, layer)

    def test_shows_submaps_in_colors(self):
        def split(data):
            submaps = array.array("H", base64.b64decode(data["frames"]["submap"]))
            half = len(submaps) // 2
            submaps = array.array("H", [65535] * 3 + [0] * (half - 3) + [2] * (len(submaps) - half))
            data["frames"]["submap"] = base64.b64encode(submaps).decode()

        self.assertEqual(self.pixels_of("submap-1"), 0)
        self.open_changed(split)
        half = (self.last_frame() + 1) // 2
        self.assertEqual(self.legend(), ["submap 0, from frame 3", f"submap 2, from frame {half}"])
        self.assertGreater(self.pixels_of("submap-1"), 15)

    def test_shows_where_the_run_was_found_in_the_map(self):
        def find(data):
            pose = array.array("f", base64.b64decode(data["frames"]["pose"]))
            path = [x + 0.1 for i in range(0, len(pose), 7) for x in pose[i:i + 3]]
            positions = base64.b64encode(array.array("f", path)).decode()
            data["map"]["sessions"] = [{"name": "yesterday <b>", "positions": positions},
                                       {"name": "", "positions": positions}]
            data["found"] = 5
            jpegs = [view["jpeg"] for view in data["views"][:2]]
            data["place"] = {"frame": 5, "jpeg": jpegs[0], "keyframe": 17, "keyframe_jpeg": jpegs[1]}

        self.assertFalse(self.browser.find("#place").is_displayed())
        self.open_changed(find)
        self.assertEqual(self.legend(), ["trajectory", "earlier session: yesterday <b>",
                                         "earlier sessions"])
        self.assertRegex(self.browser.text("#place"), r"(?s)frame 5\b.*keyframe 17\b")
        for i in (1, 2):
            self.assertGreater(int(self.browser.script(
                f"return document.querySelector('#place figure:nth-child({i}) img').naturalWidth")),
                100)
        label = self.browser.find("#scene-label")
        self.assertTrue(label.is_displayed())
        self.assertRegex(label.text, r"^found in the map: frame 5, \d\.\d\d s$")
        self.browser.changed_pixels("scene-canvas")
        for layer in ["earlier sessions", "found"]:
            self.browser.click(f"button[data-layer='{layer}']")
            self.assertGreater(self.browser.changed_pixels("scene-canvas"), 20, layer)
        self.assertFalse(label.is_displayed())

    def test_views_differ(self):
        self.browser.changed_pixels("scene-canvas")
        for key in "tsco":
            self.browser.press(key)
            self.assertGreater(self.browser.changed_pixels("scene-canvas"), 500, key)

    def test_the_slider_moves_camera_and_image(self):
        for canvas in ("scene-canvas", "frame-canvas"):
            self.browser.changed_pixels(canvas)
        facts = self.browser.text("#frame-facts")
        self.browser.script(
            "const slider = document.getElementById('time-slider');"
            "slider.value = slider.max; slider.dispatchEvent(new Event('input'));")
        self.browser.settle()
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 5)
        self.assertGreater(self.browser.changed_pixels("frame-canvas"), 500)
        self.assertNotEqual(self.browser.text("#frame-facts"), facts)
        self.assertIn(f"frame {self.last_frame()}", self.browser.text("#time-label"))

    def test_works_by_keyboard(self):
        self.browser.press(Keys.HOME)
        self.assertEqual(self.frame(), 0)
        self.browser.press(Keys.ARROW_RIGHT)
        self.browser.press(Keys.ARROW_RIGHT)
        self.assertEqual(self.frame(), 2)
        self.browser.press(Keys.ARROW_RIGHT, "#time-slider")
        self.assertEqual(self.frame(), 3)
        self.browser.press(Keys.END)
        self.assertEqual(self.frame(), self.last_frame())
        self.browser.changed_pixels("scene-canvas")
        self.browser.press(Keys.ARROW_LEFT, "#scene-canvas")
        self.assertEqual(self.frame(), self.last_frame())  # turns the view instead
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 500)

    def test_shows_tracked_features_in_the_colors_of_their_axes(self):
        colors = self.browser.script("""
            const canvas = document.getElementById("frame-canvas");
            const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
            let count = 0;
            for (let i = 0; i < data.length; i += 4) {
              const spread = Math.max(data[i], data[i + 1], data[i + 2]) -
                             Math.min(data[i], data[i + 1], data[i + 2]);
              if (spread > 60) ++count;
            }
            return count;""")
        self.assertGreater(colors, 300)  # the image itself is grey

    def test_plots_follow_and_zoom(self):
        chart = "figure[data-chart=inliers] .chart"
        actions = browser.webdriver.ActionChains(self.browser.driver)
        element = self.browser.find(chart)
        self.browser.script("arguments[0].scrollIntoView({block: 'center'})", element)
        actions.move_to_element_with_offset(element, -300, 0).perform()
        early = self.frame()
        actions.move_to_element_with_offset(element, 300, 0).perform()
        self.assertGreater(self.frame(), early)

        curve = f"{chart} polyline"
        whole = self.browser.find(curve).get_attribute("points")
        actions.move_to_element_with_offset(element, -200, 0).click_and_hold()
        actions.move_by_offset(300, 0).release().perform()
        zoomed = self.browser.find(curve).get_attribute("points")
        self.assertNotEqual(zoomed, whole)
        actions.double_click(element).perform()
        self.assertEqual(self.browser.find(curve).get_attribute("points"), whole)
        element.send_keys("+")
        self.assertNotEqual(self.browser.find(curve).get_attribute("points"), whole)
        element.send_keys(Keys.ESCAPE)
        self.assertEqual(self.browser.find(curve).get_attribute("points"), whole)

    def test_has_plots_without_webgl(self):
        plain = browser.Browser("--disable-3d-apis")
        try:
            plain.driver.get(self.report.as_uri())
            plain.settle()
            self.assertFalse(plain.find("#scene-canvas").is_displayed())
            self.assertTrue(plain.find("figure[data-chart=error] .chart").is_displayed())
            self.assertTrue(plain.find("figure[data-zoom] > svg").is_displayed())
            plain.press(Keys.END)
            self.assertIn(f"frame {self.last_frame()}", plain.text("#time-label"))
        finally:
            plain.close()

    def test_has_plots_in_print(self):
        self.browser.set_media(type="print")
        self.assertFalse(self.browser.find("#viewer").is_displayed())
        self.assertTrue(self.browser.find("figure[data-chart=error] .chart").is_displayed())
        self.assertTrue(self.browser.find("figure[data-zoom] > svg").is_displayed())

    def test_has_a_dark_theme(self):
        background = "return getComputedStyle(document.body).backgroundColor"
        light = self.browser.script(background)
        self.browser.changed_pixels("scene-canvas")
        self.browser.set_media(prefers_color_scheme="dark")
        self.assertNotEqual(self.browser.script(background), light)
        self.assertGreater(self.browser.changed_pixels("scene-canvas"), 100)


if __name__ == "__main__":
    ReportPageTest.command = sys.argv[1]
    browser.main(ReportPageTest)
