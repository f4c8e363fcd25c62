#!/usr/bin/python3
"""Progress with time left on a terminal; nothing of it in a pipe."""
import fcntl
import os
import pty
import re
import struct
import subprocess
import termios
import unittest

from perifrac_runs import MANDEL, PATIENCE, SMALL, RunTest, perifrac, run_command, settings

# Long enough for several updates, five a second.
SLOW = SMALL | {"time.end": "1500 s"}


class Terminal(RunTest):
    def test_quiet_in_a_pipe(self):
        done = perifrac("run", MANDEL, "--no-report", "--output", self.folder / "run", *settings(SMALL))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for control in ("\r", "\x1b"):
            self.assertNotIn(control, done.stdout)

    def test_progress_on_a_terminal(self):
        terminal, end = pty.openpty()
        fcntl.ioctl(end, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 120, 0, 0))
        process = subprocess.Popen(run_command(MANDEL, SLOW, self.folder / "run"), stderr=end, stdout=subprocess.PIPE)
        os.close(end)
        shown = b""
        while True:
            try:
                shown += os.read(terminal, 4096)
            except OSError:  # the other end is closed
                break
        printed, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0)
        text = shown.decode()
        self.assertRegex(text, r"\d+ %   t = [\d.e+-]+ s of 1500 s   \d+ windows, 1 pass each")
        self.assertRegex(text, r"\d+ (s|min|h).* left")
        percentages = [int(number) for number in re.findall(r"(\d+) %", text)]
        self.assertEqual(percentages, sorted(percentages))
        self.assertTrue(text.endswith("\r\x1b[K"), "the line is not taken away at the end")
        self.assertNotIn(b"\r", printed)


if __name__ == "__main__":
    unittest.main()
