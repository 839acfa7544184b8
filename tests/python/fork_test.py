"""A forked process inherits the memory of an odometry, but not its threads."""
import multiprocessing
import os
import signal
import sys
import time
import unittest

import msc_vo
import support

SECONDS = 60.0  # far more than the work of a child takes


def in_child(action):
    """Runs action() in a forked process; returns its exit code, or None if it hangs."""
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            action()
            code = 0
        finally:
            os._exit(code)
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        pid, status = os.waitpid(child, os.WNOHANG)
        if pid:
            return -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
        time.sleep(0.01)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None


def started(threads):
    odometry = support.room_odometry(threads=threads)
    support.process(odometry, support.room_images()[:8])
    return odometry


def refuses(call):
    try:
        call()
    except RuntimeError as error:
        assert "forked" in str(error), error
        return
    raise AssertionError("no error")


class Fork(unittest.TestCase):
    def test_the_child_can_delete_it(self):
        for threads in (1, 2, 3):
            holder = [started(threads)]
            self.assertEqual(in_child(holder.clear), 0, threads)
            support.process(holder[0], support.room_images()[8:10])  # the parent goes on
            self.assertEqual(len(holder[0].finish().frames), 10)

    def test_the_child_can_delete_it_in_a_child_of_its_own(self):
        holder = [started(2)]

        def grandchild():
            assert in_child(holder.clear) == 0
            holder.clear()

        self.assertEqual(in_child(grandchild), 0)

    def test_using_it_in_the_child_raises(self):
        odometry = started(2)
        image = support.room_images()[8]

        def use():
            refuses(lambda: odometry.process(image.timestamp, image.gray, image.depth))
            refuses(lambda: odometry.drop(image.timestamp))
            refuses(odometry.finish)
            refuses(odometry.map)
            refuses(lambda: odometry.save("/nonexistent"))

        self.assertEqual(in_child(use), 0)

    def test_without_threads_it_goes_on_in_both(self):
        odometry = started(1)

        def use():
            support.process(odometry, support.room_images()[8:12])
            assert len(odometry.finish().frames) == 12

        self.assertEqual(in_child(use), 0)
        use()

    def test_a_child_makes_its_own(self):
        parents = started(2)

        def use():
            odometry = started(2)
            assert len(odometry.finish().frames) == 8
            del odometry

        self.assertEqual(in_child(use), 0)
        self.assertEqual(len(parents.finish().frames), 8)

    def test_a_child_that_ends_as_programs_do(self):
        odometry = started(2)  # noqa: F841: inherited
        child = multiprocessing.get_context("fork").Process(target=sys.exit, args=(0,))
        child.start()
        child.join(SECONDS)
        self.assertEqual(child.exitcode, 0)

    def test_workers_return_results(self):
        odometry = started(2)  # noqa: F841: inherited
        with multiprocessing.get_context("fork").Pool(1) as pool:
            result = pool.apply_async(short_run).get(SECONDS)
        self.assertEqual(result, short_run())
        self.assertIsInstance(result, msc_vo.Result)


def short_run():
    return started(2).finish()


if __name__ == "__main__":
    unittest.main()
