# SPDX-License-Identifier: BSD-3-Clause
# SPDX-FileCopyrightText: 2026 the msc_vo authors
"""RGB-D visual odometry from points, lines and the structure of the scene.

    odometry = msc_vo.Odometry(msc_vo.Options(mode="msc-vo"), camera, distortion)
    for timestamp, gray, depth in my_camera:
        frame = odometry.process(timestamp, gray, depth)
    result = odometry.finish()

docs/python.md describes the package.
"""
from ._msc_vo import *  # noqa: F401,F403
from ._msc_vo import __version__  # noqa: F401


class Localizer(Odometry):  # noqa: F405
    """Finds a camera in a saved map, which remains as it is.

    An Odometry whose frames are lost unless they are in the world of the map. map: a file of
    Odometry.save_map or `msc_vo replay --map`.
    """

    def __init__(self, options, camera, map, distortion=None):
        super().__init__(options, camera, distortion)
        self.load_map(map, only_localize=True)


def replay(sequence, options=None, on_frame=None, on_tracked=None):
    """Runs the odometry over a sequence as `msc_vo replay` does and returns its Result.

    sequence: a Sequence, or the path of its folder. Images that cannot be read are bridged (status
    'unreadable'). on_frame(FrameResult) is called after every image, on_tracked(TrackedImage) as
    Odometry.set_tracking_observer says.
    """
    if not isinstance(sequence, Sequence):  # noqa: F405
        sequence = Sequence(sequence)  # noqa: F405
    values = Options(**dict(options or {}))  # noqa: F405
    if values["mapping.readout_time"] is None:
        values["mapping.readout_time"] = sequence.readout_time
    if values["features.depth_sensor"] == "auto":
        values["features.depth_sensor"] = sequence.depth_sensor
    odometry = Odometry(values, sequence.camera, sequence.lens)  # noqa: F405
    odometry.skip_clipped_depth_search()
    odometry.set_tracking_observer(on_tracked)
    for i, timestamp in enumerate(sequence.timestamps):
        try:
            image = sequence[i]
        except UnreadableImage:  # noqa: F405
            frame = odometry.drop(timestamp, "unreadable")
        else:
            frame = odometry.process(timestamp, image.gray, image.depth,
                                     depth_delay=image.depth_delay, mask=image.mask)
        if on_frame is not None:
            on_frame(frame)
    return odometry.finish()
