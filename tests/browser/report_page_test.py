#!/usr/bin/env python3
"""Opens the report of a replay in headless Chromium and uses it.

    report_page_test.py MSC_VO
"""
import pathlib
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
