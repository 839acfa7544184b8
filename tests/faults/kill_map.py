#!/usr/bin/env python3
"""Kills runs of `msc_vo replay --map` at random moments.

    kill_map.py COMMAND [--kills N] [--seed N] [--frames N]

After every kill the map must be whole, and must have the keyframes of all sessions that ended before.
Every third run is not killed, so that the map gets further sessions. Prints how many maps there were;
exit status 1 if one was lost.
"""
import argparse
import collections
import pathlib
import random
import re
import signal
import sys
import tempfile
import time

from replay_process import Replay


def sessions_of(replay, home):
    """Numbers of keyframes of the sessions in a map; None if it is empty; an error ends the program."""
    code, output = replay.command_run("map", "check", home)
    if code == 1 and "is empty" in output:
        return None
    if code != 0:
        raise SystemExit(f"lost: {output}")
    code, output = replay.command_run("map", "info", home)
    if code != 0:
        raise SystemExit(f"lost: {output}")
    return [int(number) for number in re.findall(r"^session '.*': (\d+) keyframes$", output, re.MULTILINE)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--frames", type=int, default=20)
    arguments = parser.parse_args()
    numbers = random.Random(arguments.seed)
    replay = Replay(arguments.command.resolve())
    counts = collections.Counter()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        room, home = folder / "room", folder / "home.map"
        replay.synthesize(room, arguments.frames)
        common = [room, "--quiet", "--output", folder / "out", "--map", home, "--checkpoint-interval", "0"]
        start = time.monotonic()
        replay.run(room, "--quiet", "--output", folder / "out", "--map", folder / "other.map",
                   "--checkpoint-interval", "0")
        seconds = time.monotonic() - start
        known = []  # keyframes of the sessions that ended
        while counts["kills"] < arguments.kills:
            process = replay.start(*common)
            if counts["runs"] % 3 < 2:
                time.sleep(numbers.uniform(0.0, seconds))
                process.send_signal(signal.SIGKILL)
                counts["kills"] += 1
            process.communicate()
            counts["runs"] += 1
            if not home.exists():
                continue
            sessions = sessions_of(replay, home)
            if sessions is None and known:
                raise SystemExit("lost: the map is empty")
            if sessions is None:
                counts["killed before the first write"] += 1
                continue
            counts["usable maps"] += 1
            # Culling removes keyframes of earlier sessions in favour of new ones.
            if len(sessions) < len(known) or sum(sessions) < max(known, default=0):
                raise SystemExit(f"lost: {sessions} after {known}")
            known = sessions
            if len(sessions) > 4:
                home.unlink()
                pathlib.Path(f"{home}-journal").unlink(missing_ok=True)
                known = []
    print(", ".join(f"{count} {what}" for what, count in sorted(counts.items())))
    return 0


if __name__ == "__main__":
    sys.exit(main())
