"""Headless Chromium for the tests of the pages, and assertions about pictures.

A test that cannot run here ends with exit status 77, which CTest counts as skipped.
"""
import shutil
import sys
import tempfile
import time
import unittest

SKIPPED = 77

try:
    from selenium import webdriver
    from selenium.common.exceptions import NoSuchElementException, StaleElementReferenceException
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    webdriver = Keys = None

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--enable-unsafe-swiftshader", "--window-size=1280,1400", "--hide-scrollbars"]

# Keeps the pixels of a canvas, or counts those that differ from the kept ones.
PIXELS_SCRIPT = """
const canvas = document.getElementById(arguments[0]);
const copy = document.createElement("canvas");
[copy.width, copy.height] = [canvas.width, canvas.height];
const context = copy.getContext("2d");
context.drawImage(canvas, 0, 0);
const pixels = context.getImageData(0, 0, copy.width, copy.height).data;
const kept = (window.keptPixels || {})[arguments[0]];
window.keptPixels = Object.assign(window.keptPixels || {}, {[arguments[0]]: pixels});
if (!kept || kept.length !== pixels.length) return -1;
let count = 0;
for (let i = 0; i < pixels.length; i += 4) {
  if ([0, 1, 2, 3].some((c) => Math.abs(pixels[i + c] - kept[i + c]) > 24)) ++count;
}
return count;
"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def skip_without_browser():
    if webdriver is None:
        skip("selenium is not installed (Debian: python3-selenium)")
    for program in ("chromium", "chromedriver"):
        if not shutil.which(program):
            skip(f"{program} is not installed (Debian: chromium, chromium-driver)")


class Browser:
    """A browser with a profile of its own."""

    def __init__(self, *more_flags):
        self.profile = tempfile.mkdtemp(prefix="msc_vo_browser_")
        options = Options()
        for flag in [*FLAGS, *more_flags, f"--user-data-dir={self.profile}"]:
            options.add_argument(flag)
        options.binary_location = shutil.which("chromium")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)

    def close(self):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def set_media(self, **features):
        """Emulates media features, such as prefers_color_scheme="dark"; `type`: "print"."""
        arguments = {"features": [{"name": name.replace("_", "-"), "value": value}
                                  for name, value in features.items() if name != "type"],
                     "media": features.get("type", "")}
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", arguments)

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.find(selector).text

    def press(self, keys, selector="body"):
        self.find(selector).send_keys(keys)

    def click(self, selector):
        # In one step, since the page may replace the element at any time.
        self.script("document.querySelector(arguments[0]).click()", selector)

    def settle(self):
        """Waits until the page has drawn what it scheduled."""
        self.driver.execute_async_script(
            "const done = arguments[0];"
            "requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30)));")

    def wait_for(self, condition, seconds=20, what="a condition"):
        """Waits until a condition holds. While a page replaces another, elements may be missing."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                value = condition()
            except (NoSuchElementException, StaleElementReferenceException):
                value = None
            if value:
                return value
            time.sleep(0.05)
        raise AssertionError(f"{what} did not become true within {seconds} s")

    def changed_pixels(self, canvas_id):
        """Pixels of a canvas that differ from those at the last call; -1 at the first one."""
        self.settle()
        return self.script(PIXELS_SCRIPT, canvas_id)

    def errors(self):
        """Messages on the console that are errors."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] == "SEVERE"]


def main(test_case):
    """Runs the tests of a class and exits with its status."""
    skip_without_browser()
    suite = unittest.defaultTestLoader.loadTestsFromTestCase(test_case)
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    sys.exit(0 if result.wasSuccessful() else 1)
