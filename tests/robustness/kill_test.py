#!/usr/bin/python3
"""kill -9 at random moments: what is there can be read, and a restart gives the uninterrupted run."""
import random
import subprocess
import time
import unittest

from long_runs import LONG, LongRunTest
from perifrac_runs import MANDEL, TIMES, checkpoints, datasets, listed_frames, run_command


class Kill(LongRunTest):
    def kill_after(self, folder, seconds, *options, frames=0):
        """So long after there are so many frames."""
        process = subprocess.Popen(run_command(MANDEL, LONG, folder, *options), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        while len(listed_frames(folder)) < frames:
            self.assertIsNone(process.poll(), "the run ended by itself")
            time.sleep(0.01)
        time.sleep(seconds)
        self.assertIsNone(process.poll(), "the run ended by itself")
        process.kill()
        process.wait()

    def assert_readable(self, folder):
        for _, frame in listed_frames(folder):
            self.assertIn("VTKHDF/PointData/pore_pressure", datasets(frame))
        for checkpoint in checkpoints(folder):
            self.assertIn("state/pore_flow/fluid_content", datasets(checkpoint))

    def test_at_random_moments(self):
        moments = random.Random(3)
        reached = 0
        for n in range(TIMES or 10):
            seconds = moments.uniform(0.02, 0.8)
            with self.subTest(n=n, seconds=seconds):
                folder = self.folder / str(n)
                self.kill_after(folder, seconds, frames=2 if n == 0 else 0)
                self.assert_readable(folder)
                reached = max(reached, len(listed_frames(folder)))
                self.finish(folder)
        self.assertGreater(reached, 1, "every run was killed before it did anything")

    def test_restarts_too(self):
        moments = random.Random(4)
        folder = self.folder / "run"
        for _ in range(TIMES or 5):
            latest = checkpoints(folder)[-1:]
            self.kill_after(folder, moments.uniform(0.02, 0.4), *(["--restart", str(latest[0])] if latest else []))
            self.assert_readable(folder)
        self.finish(folder)


if __name__ == "__main__":
    unittest.main()
