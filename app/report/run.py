"""A run folder, read: what `perifrac run` left behind, finished or not."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from frames import FrameSeries, read_all_series
from history import History, read_history
from no_run import NoRun


@dataclass(frozen=True)
class Run:
    folder: Path
    summary: dict[str, Any]
    history: History
    series: list[FrameSeries]

    @property
    def title(self) -> str:
        return self.summary.get("scene", {}).get("title") or self.folder.resolve().name

    @property
    def outcome(self) -> str:
        """A run writes its summary last: without one it is under way or was killed."""
        return self.summary.get("outcome", "unfinished")

    @property
    def failure(self) -> dict[str, Any]:
        """Why the run failed; empty of one that did not."""
        return self.summary.get("failure") or {}

    @property
    def warnings(self) -> list[str]:
        return self.summary.get("warnings") or []

    @property
    def counts(self) -> dict[str, int]:
        """What the run had any of."""
        return {name: count for name, count in self.summary.get("counts", {}).items() if count}

    @property
    def reference(self) -> dict[str, Any]:
        return self.summary.get("reference") or {}


def read_summary(path: Path) -> dict[str, Any]:
    if not path.exists():
        return {}
    if not path.is_file():
        raise NoRun(f"{path}: not a file; expected what 'perifrac run' wrote")
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except json.JSONDecodeError as error:
        raise NoRun(f"{path}:{error.lineno}:{error.colno}: not JSON ({error.msg}); run the scene again") from error


def without_outcome(progress: dict[str, Any]) -> dict[str, Any]:
    """What a run says of itself while it goes on: whether it still does, its files do not tell."""
    return {name: entry for name, entry in progress.items() if name != "outcome"}


def read_run(folder: Path) -> Run:
    if not folder.is_dir():
        raise NoRun(f"{folder}: no such folder; expected the folder that 'perifrac run' wrote")
    summary = read_summary(folder / "summary.json") or without_outcome(read_summary(folder / "progress.json"))
    history = read_history(folder / "history.csv")
    series = read_all_series(folder / "frames")
    if not summary and not history.columns and not series:
        expected = "summary.json, history.csv or frames/*.hdf.series from 'perifrac run'"
        raise NoRun(f"{folder}: holds no run; expected {expected}")
    return Run(folder, summary, history, series)
