"""A run that is certain to be under way when a test stops it, and its comparison with one that was not stopped."""
import math
import tempfile
from pathlib import Path

import h5py

from perifrac_runs import RunTest, checkpoints

FRAMES_EVERY = 10.0  # [s]
LONG = {"body.spacing": "2 m", "time.end": "50000 s", "output.times": "[]", "output.interval": f"{FRAMES_EVERY} s",
        "output.checkpoint_interval": "0 s"}


def rows(folder):
    """Whole rows in history.csv, its header apart."""
    file = Path(folder, "history.csv")
    return max(file.read_bytes().count(b"\n") - 1, 0) if file.exists() else 0


class LongRunTest(RunTest):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.uninterrupted_runs = Path(holder.name)

    def uninterrupted(self, until):
        folder = self.uninterrupted_runs / str(until)
        return folder if folder.exists() else self.run_scene(LONG, folder, "--until", str(until))

    def finish(self, folder):
        """Goes on from the latest checkpoint of a stopped run, and compares with a run that was not stopped."""
        latest = checkpoints(folder)[-1:]
        time = 0.0
        if latest:
            with h5py.File(latest[0], "r") as checkpoint:
                time = checkpoint["time"][0]
        # To a time of a frame that lies a little beyond, of few enough that runs can be shared.
        until = 4 * FRAMES_EVERY * (math.floor(time / (4 * FRAMES_EVERY)) + 1)
        self.run_scene(LONG, folder, "--until", str(until), *(["--restart", str(latest[0])] if latest else []))
        self.assert_same_results(self.uninterrupted(until), folder)
