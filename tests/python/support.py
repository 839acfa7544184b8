"""What the tests of the Python module share. ctest sets the environment."""
import functools
import os
import pathlib

import msc_vo

ROOT = pathlib.Path(os.environ["MSC_VO_SOURCE"])
ROOM = ROOT / "data" / "room"
WINDOWS = ROOT / "tests" / "data" / "windows"
COMMAND = os.environ["MSC_VO_COMMAND"]


@functools.lru_cache(maxsize=None)
def room():
    return msc_vo.Sequence(ROOM)


@functools.lru_cache(maxsize=None)
def room_images():
    return [room()[i] for i in range(len(room()))]


@functools.lru_cache(maxsize=None)
def room_result():
    return msc_vo.replay(room())


def room_odometry(**options):
    return msc_vo.Odometry(msc_vo.Options(**options), room().camera, room().distortion)


def process(odometry, images):
    return [odometry.process(image.timestamp, image.gray, image.depth) for image in images]
