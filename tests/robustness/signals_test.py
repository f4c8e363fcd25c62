#!/usr/bin/python3
"""SIGTERM and SIGINT end a run with a checkpoint, from which it goes on as if nothing had happened."""
import random
import signal
import subprocess
import time
import unittest

from long_runs import LONG, LongRunTest, rows
from perifrac_runs import MANDEL, PATIENCE, TIMES, checkpoints, run_command


class Signals(LongRunTest):
    def stop(self, folder, after_rows, signals, *options):
        """Runs, sends the signals one after the other once history.csv has so many rows; gives the exit code."""
        process = subprocess.Popen(run_command(MANDEL, LONG, folder, *options), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        try:
            while rows(folder) < after_rows:
                self.assertIsNone(process.poll(), "the run ended by itself")
                time.sleep(0.002)
            for number in signals:
                process.send_signal(number)
            _, complaints = process.communicate(timeout=PATIENCE)
        finally:
            process.kill()
        self.assertEqual(complaints, "")
        return process.returncode

    def assert_goes_on(self, folder):
        self.assert_no_remains(folder)
        self.finish(folder)

    def test_one_signal_at_any_moment(self):
        moments = random.Random(1)
        for n in range(TIMES or 6):
            number = moments.choice([signal.SIGTERM, signal.SIGINT])
            after_rows = moments.choice([1, 2, moments.randrange(3, 200)])
            with self.subTest(signal=number.name, after_rows=after_rows):
                folder = self.folder / str(n)
                self.assertEqual(self.stop(folder, after_rows, [number]), 128 + number)
                self.assert_goes_on(folder)

    def test_a_storm_of_signals(self):
        storm = random.Random(2)
        for n in range(3):
            numbers = [storm.choice([signal.SIGTERM, signal.SIGINT]) for _ in range(300)]
            folder = self.folder / str(n)
            self.assertIn(self.stop(folder, 30, numbers), (130, 143))
            self.assert_goes_on(folder)

    def test_signals_to_restarts_too(self):
        folder = self.folder / "run"
        self.assertEqual(self.stop(folder, 60, [signal.SIGTERM]), 143)
        for _ in range(3):
            start = checkpoints(folder)[-1]
            after_rows = rows(folder) + 10
            self.assertEqual(self.stop(folder, after_rows, [signal.SIGINT], "--restart", str(start)), 130)
        self.assert_goes_on(folder)


if __name__ == "__main__":
    unittest.main()
