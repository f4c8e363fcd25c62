"""Runs of perifrac, and what they leave, for the stability suite."""
import csv
import glob
import json
import os
import re
import shutil
import subprocess
import tempfile

import h5py
import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
CONFIGS = os.path.join(HERE, "..", "..", "configs")
LONGEST = 240.0  # s of wall time; a run that takes more is a failure


class Run:
    """What one run left: exit code, what it said, history, frames and summary."""

    def __init__(self, code, said, folder):
        self.code = code
        self.said = said
        self.names, self.history, self.summary, self.frames = [], {}, {}, []
        if os.path.exists(os.path.join(folder, "summary.json")):
            self._read(folder)

    def _read(self, folder):
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            self.summary = json.load(file)
        if not os.path.exists(os.path.join(folder, "history.csv")):
            return  # it failed before anything was there
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
            rows = list(csv.reader(file))
        self.names = [re.sub(r" \[[^]]*\]$", "", name) for name in rows[0]]
        values = numpy.array([[float(v) if v else numpy.nan for v in row] for row in rows[1:]])
        self.history = dict(zip(self.names, values.reshape(-1, len(self.names)).T))
        for name in sorted(glob.glob(os.path.join(folder, "frames", "body_*.hdf"))):
            with h5py.File(name) as file:
                grid = file["VTKHDF"]
                frame = {key: array[()] for key, array in grid["PointData"].items()}
                frame["x"] = grid["Points"][()]
                frame["time"] = float(grid["FieldData"]["TimeValue"][0])
            self.frames.append(frame)

    @property
    def done(self):
        return self.code == 0

    def errors(self, name):
        """Largest value of one column of the reference's table."""
        return max((abs(row[name]) for row in self.summary["reference"]["table"]), default=numpy.nan)

    def last(self, name):
        return float(self.history[name][-1])

    def module(self, name):
        return next(m for m in self.summary["modules"] if m["name"] == name)

    @property
    def mass_error(self):
        return self.summary["ledger"].get("mass_error", 0.0)

    @property
    def complaint(self):
        """What it said when it stopped, without time and path."""
        lines = [line for line in self.said.splitlines() if line.strip()]
        errors = [line for line in lines if "error" in line] or lines[-1:]
        text = errors[-1] if errors else f"exit code {self.code}"
        text = re.sub(r"^\[?\d\d:\d\d:\d\d\]?\s*", "", text)
        return re.sub(r"\S*/([\w.]+\.yaml)", r"\1", text)


def run(perifrac, scene, settings=None):
    """Runs `scene`, a path, with KEY: VALUE settings on one thread."""
    folder = tempfile.mkdtemp(prefix="stability_")
    words = [word for key, value in (settings or {}).items() for word in ("--set", f"{key}={value}")]
    try:
        done = subprocess.run(
            ["nice", perifrac, "run", scene, "--no-report", "--threads", "1", "--output", folder,
             *words], capture_output=True, text=True, timeout=LONGEST)
        return Run(done.returncode, done.stderr, folder)
    except subprocess.TimeoutExpired:
        return Run(124, f"took more than {LONGEST:g} s", folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
