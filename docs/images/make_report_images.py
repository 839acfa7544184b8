#!/usr/bin/env python3
"""Creates the pictures of docs/usage.md: report_light.png, report_dark.png and live_light.png,
live_dark.png, screenshots of the report and of the live view of a synthetic room.

    docs/images/make_report_images.py [MSC_VO [SEQUENCE]]

MSC_VO: the command, by default build/apps/msc_vo. SEQUENCE: a folder; without it a room is rendered,
which takes some minutes. Needs chromium, chromium-driver and python3-selenium.
"""
import base64
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "browser"))
import browser  # noqa: E402

IMAGES = ROOT / "docs" / "images"
WIDTH = 1180
REPORT_HEIGHT = 890  # title, numbers, view, slider
LIVE_HEIGHT = 800


def save(page, name, theme, height):
    page.set_media(prefers_color_scheme=theme)
    page.driver.set_window_size(WIDTH, height + 200)
    page.settle()
    page.settle()
    clip = {"x": 0, "y": 0, "width": WIDTH, "height": height, "scale": 1}
    picture = page.driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png", "clip": clip})
    path = IMAGES / f"{name}_{theme}.png"
    path.write_bytes(base64.b64decode(picture["data"]))
    print(f"{path.relative_to(ROOT)}: {path.stat().st_size // 1024} kB")


def replay(command, work, *more, **options):
    """Starts a replay of `work`/room whose command line in the pictures is short."""
    return subprocess.Popen(["msc_vo", "replay", "room", *more], executable=command, cwd=work,
                            stdout=subprocess.DEVNULL, text=True, **options)


def capture_report(page, command, work):
    if replay(command, work, stderr=subprocess.DEVNULL).wait() != 0:
        sys.exit("the replay failed")
    page.driver.get((work / "out" / "room" / "report.html").as_uri())
    for theme in ("light", "dark"):
        save(page, "report", theme, REPORT_HEIGHT)


def capture_live(page, command, work):
    run = replay(command, work, "--view", stderr=subprocess.PIPE)
    page.driver.get(re.search(r"http://\S+", run.stderr.readline()).group())
    page.wait_for(lambda: int((re.findall(r"(\d+) of", page.text("#live-state")) or [0])[0]) > 150,
                  seconds=60, what="150 frames")
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
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        if len(sys.argv) > 2:
            (work / "room").symlink_to(pathlib.Path(sys.argv[2]).resolve())
        else:
            subprocess.run([command, "synthesize", str(work / "room"), "--scene", "room", "--frames",
                            "260", "--noise", "kinect"], check=True)
        page = browser.Browser()
        try:
            capture_report(page, command, work)
            capture_live(page, command, work)
        finally:
            page.close()


if __name__ == "__main__":
    main()
