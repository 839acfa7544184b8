#!/usr/bin/env python3
"""Creates the pictures of the README and of docs/usage.md from the house that apps/demo.sh renders:

    house_light.png, house_dark.png     its map, trajectory and surface in three dimensions
    house_walk.webp                     the walk through it in the report
    report_light.png, report_dark.png   the report
    live_light.png, live_dark.png       the live view

    docs/images/make_images.py [MSC_VO]

MSC_VO: the command, by default build/apps/msc_vo. Run apps/demo.sh first. Needs chromium,
chromium-driver, python3-selenium, python3-pil, and an msc_vo with Open3D for the surface.
"""
import base64
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "browser"))
import browser  # noqa: E402

IMAGES = ROOT / "docs" / "images"
HOUSE = ROOT / "out" / "demo-house"
WIDTH = 1180
REPORT_HEIGHT = 890  # title, numbers, view, slider
LIVE_HEIGHT = 800
WALK_WIDTH = 900
WALK_STEP = 4  # frames of the run per picture of the animation
WALK_PICTURE_MS = 160
WALK_QUALITY = 60


def screenshot(page, clip):
    picture = page.driver.execute_cdp_cmd(
        "Page.captureScreenshot", {"format": "png", "clip": {**clip, "scale": 1}})
    return base64.b64decode(picture["data"])


def report_size(path):
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size // 1024} kB")


def save(page, name, theme, height):
    page.set_media(prefers_color_scheme=theme)
    page.driver.set_window_size(WIDTH, height + 200)
    page.settle()
    page.settle()
    path = IMAGES / f"{name}_{theme}.png"
    path.write_bytes(screenshot(page, {"x": 0, "y": 0, "width": WIDTH, "height": height}))
    report_size(path)


def clip_of(page, selector):
    """The rectangle of an element in the page."""
    return page.script(
        "const r = document.querySelector(arguments[0]).getBoundingClientRect();"
        "return {x: r.x + scrollX, y: r.y + scrollY, width: r.width, height: r.height};", selector)


def replay(command, work, *more, **options):
    """Starts a replay of `work`/house whose command line in the pictures is short."""
    return subprocess.Popen(["msc_vo", "replay", "house", *more], executable=command, cwd=work,
                            stdout=subprocess.DEVNULL, text=True, **options)


def make_report(command, work):
    if replay(command, work, stderr=subprocess.DEVNULL).wait() != 0:
        sys.exit("the replay failed")
    out = work / "out" / "house"
    subprocess.run([command, "fuse", work / "house", out / "trajectory.txt", "--voxel", "0.02",
                    "--every", "2", "--output", work / "surface.ply", "--report",
                    out / "report.html"], check=True)
    return (out / "report.html").as_uri()


def capture_house(page):
    """The 3-D view alone, large."""
    page.driver.set_window_size(WIDTH + 400, 1200)
    for layer in ("ground truth", "points"):
        page.click(f"button[data-layer='{layer}']")
    for theme in ("light", "dark"):
        page.set_media(prefers_color_scheme=theme)
        page.settle()
        page.settle()
        path = IMAGES / f"house_{theme}.png"
        path.write_bytes(screenshot(page, clip_of(page, "#scene")))
        report_size(path)


def capture_walk(page):
    """The view and the image of the current frame while the slider moves."""
    page.set_media(prefers_color_scheme="light")
    page.driver.set_window_size(WALK_WIDTH + 60, 1200)
    last = int(page.find("#time-slider").get_property("max"))
    pictures = []
    for frame in range(0, last, WALK_STEP):
        page.script("const slider = document.getElementById('time-slider');"
                    "slider.value = arguments[0]; slider.dispatchEvent(new Event('input'));", frame)
        page.settle()
        picture = Image.open(io.BytesIO(screenshot(page, clip_of(page, ".viewer-grid"))))
        pictures.append(picture.convert("RGB"))
    path = IMAGES / "house_walk.webp"
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=WALK_PICTURE_MS,
                     loop=0, quality=WALK_QUALITY, method=6)
    report_size(path)


def capture_live(page, command, work):
    run = replay(command, work, "--view", stderr=subprocess.PIPE)
    page.driver.get(re.search(r"http://\S+", run.stderr.readline()).group())
    page.wait_for(lambda: int((re.findall(r"(\d+) of", page.text("#live-state")) or [0])[0]) > 150,
                  seconds=120, what="150 frames")
    page.click("#live-pause")
    page.wait_for(lambda: "paused" in page.text("#live-state"), what="pause")
    page.click("#live-step")  # its frame has an image
    page.wait_for(lambda: not page.find("#frame-missing").is_displayed(), what="an image")
    for theme in ("light", "dark"):
        save(page, "live", theme, LIVE_HEIGHT)
    run.terminate()
    run.communicate()


def main():
    browser.skip_without_browser()
    command = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/apps/msc_vo").resolve())
    if not HOUSE.is_dir():
        sys.exit(f"{HOUSE.relative_to(ROOT)} does not exist: run apps/demo.sh first")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        shutil.copytree(HOUSE, work / "house")
        report = make_report(command, work)
        page = browser.Browser()
        try:
            page.driver.get(report)
            for theme in ("light", "dark"):
                save(page, "report", theme, REPORT_HEIGHT)
            capture_walk(page)
            capture_house(page)
            capture_live(page, command, work)
        finally:
            page.close()


if __name__ == "__main__":
    main()
