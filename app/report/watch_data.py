"""A run's folder while it is written into: what has come since the last look, read once."""

from __future__ import annotations

import os
import signal
import socket
from pathlib import Path
from typing import Any

import tables
from charts import all_charts
from chunks import Chunks
from curves import chart_data, leading
from field_data import PointSet, all_times, assembled, dimension_of, found_sets, frame_data
from history import read_history
from no_run import NoRun
from quantities import quantity
from run import Run, read_summary

CELLS = 20_000  # points of a set that are shown; of more, means
MOST_FRAMES = 120
SIGNALS = {"stop": signal.SIGTERM, "checkpoint": signal.SIGUSR1}


class RunningProcess:
    """The process that `progress.json` names, where it is of this machine and still the same."""

    def __init__(self, progress: dict[str, Any]) -> None:
        self.id = progress.get("process")
        self.start = progress.get("process_start")
        self.is_here = progress.get("host") == socket.gethostname()

    def lives(self) -> bool:
        if not self.is_here or not isinstance(self.id, int) or self.id <= 1:
            return False
        try:
            stat = Path(f"/proc/{self.id}/stat").read_text()
        except OSError:
            return False
        words = stat.rpartition(")")[2].split()
        return int(words[19]) == self.start and words[0] != "Z"

    def send(self, wish: str) -> bool:
        """Whether the process could be told."""
        try:
            if not self.lives():
                return False
            os.kill(self.id, SIGNALS[wish])
        except (OSError, ValueError):
            return False
        return True


class LiveFields:
    """Frames as they come: each is read once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.start_anew()

    def start_anew(self) -> None:
        self.chunks = Chunks()
        self.sets: list[PointSet] = []
        self.times: list[float] = []
        self.frames: list[list[dict[str, Any] | None]] = []
        self.available = 0
        self.dimension = 0
        self.seen: tuple = ()
        self.version = 0 if not hasattr(self, "version") else self.version + 1

    def refresh(self) -> None:
        seen = tuple(sorted((path.name, path.stat().st_mtime_ns) for path in self.folder.glob("*.hdf.series")))
        if seen == self.seen:
            return
        found = found_sets(self.folder)
        times = all_times(found)
        if {one.name for one in found} != {one.files.name for one in self.sets} or not set(self.times) <= set(times):
            self.start_anew()  # another run, or one that goes on from an earlier checkpoint
            self.dimension = dimension_of(found) if found else 0
            self.sets = [PointSet(one, self.dimension, CELLS) for one in found]
        for one, files in zip(self.sets, found):
            one.files = files
        for time in (t for t in times if not self.times or t > self.times[-1]):
            self.add(time)
        self.available = len(times)
        self.seen = seen

    def add(self, time: float) -> None:
        read = [one.read(time) for one in self.sets]
        self.frames.append([frame_data(one, points, self.chunks) if points is not None else None
                            for one, points in zip(self.sets, read)])  # fmt: skip
        self.times.append(time)
        if len(self.times) > MOST_FRAMES:
            self.thin()
        self.version += 1

    def thin(self) -> None:
        """Leaves out every other frame; where points are told goes over to the next one."""
        for place in range(len(self.times) - 2, 0, -2):
            for dropped, kept in zip(self.frames[place], self.frames[place + 1]):
                for name in ("points", "crosses", "crossGap", "paths"):
                    if dropped and kept and name in dropped and "points" not in kept:
                        kept[name] = dropped[name]
            del self.frames[place], self.times[place]

    def data(self) -> dict[str, Any] | None:
        if not self.frames:
            return None
        return assembled(self.sets, self.times, self.available, self.dimension, self.frames)


class WatchedRun:
    """What the page asks for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.fields = LiveFields(folder / "frames")
        self.summary: dict[str, Any] = {}
        self.rows_seen: Any = None
        self.charts_version = 0
        self.charts: dict[str, Any] = {"charts": [], "leading": []}

    def refresh(self) -> None:
        """Looks at the folder; what is half-written or broken is passed over until the next look."""
        self.summary = self.read("summary.json") or self.read("progress.json")
        self.fields.refresh()
        self.refresh_charts()

    def read(self, name: str) -> dict[str, Any]:
        try:
            return read_summary(self.folder / name)
        except (NoRun, OSError, UnicodeDecodeError):
            return {}

    def refresh_charts(self) -> None:
        path = self.folder / "history.csv"
        state = (path.stat().st_size if path.exists() else 0, self.outcome)
        if state == self.rows_seen:
            return
        try:
            charts = all_charts(Run(self.folder, self.summary, read_history(path), []))
        except (NoRun, OSError, ValueError):
            return
        self.rows_seen = state
        self.charts_version += 1
        self.charts = {"charts": [chart_data(chart) for chart in charts], "leading": leading(charts)}

    @property
    def process(self) -> RunningProcess:
        return RunningProcess(self.summary.get("progress") or {})

    @property
    def outcome(self) -> str:
        """`running`; what the summary says; `waiting` before the first window; `gone` of a run that was killed."""
        said = self.summary.get("outcome", "waiting")
        if said != "running":
            return said
        process = self.process
        return "running" if process.lives() or not process.is_here else "gone"

    def state(self) -> dict[str, Any]:
        run = Run(self.folder, self.summary, read_history(Path("/nonexistent")), [])
        progress = self.summary.get("progress") or {}
        outcome = self.outcome
        may = outcome == "running" and self.process.lives()
        why_not = "" if may else "it runs on another machine" if outcome == "running" else "it does not run"
        return {
            "folder": str(self.folder), "title": run.title, "outcome": outcome,
            "progress": progress, "part": part_done(progress), "facts": progress_facts(self.summary, outcome),
            "effects": tables.effects(run), "ledger": tables.ledger(run), "warnings": tables.warnings(run),
            "failure": tables.failure(run), "may": may, "why_not": why_not,
            "fields_version": self.fields.version, "charts_version": self.charts_version,
            "report": (self.folder / "report.html").is_file() and outcome not in ("running", "waiting"),
        }  # fmt: skip


def part_done(progress: dict[str, Any]) -> float | None:
    if "time" not in progress:
        return None
    whole = progress["end"] - progress["begin"]
    return min(max((progress["time"] - progress["begin"]) / whole, 0.0), 1.0) if whole > 0 else 1.0


def duration(seconds: float) -> str:
    """As a person reads it: `48 s`, `3 min 20 s`, `2 h 05 min`."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02} s"
    return f"{whole // 3600} h {whole // 60 % 60:02} min"


def progress_facts(summary: dict[str, Any], outcome: str) -> list[list[str]]:
    progress = summary.get("progress") or {}
    facts = []
    if progress and outcome == "running":
        facts.append(["time", f"{quantity(progress['time'], 's')} of {quantity(progress['end'], 's')}"])
        if "left" in progress:
            facts.append(["left", duration(progress["left"])])
    elif isinstance(summary.get("time"), dict):
        facts.append(["time", quantity(summary["time"]["value"], "s")])
    if "wall_time" in summary:
        facts.append(["wall time", duration(summary["wall_time"])])
    counts = summary.get("counts", {})
    facts += [[name.replace("_", " "), f"{counts[name]}"] for name in ("windows", "points") if counts.get(name)]
    if "peak_memory" in summary:
        facts.append(["memory", quantity(summary["peak_memory"], "B", 3)])
    return facts
