"""What runs leave, read: history, frames, summary and scene, with units."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from perifrac.errors import Error

_UNIT = re.compile(r"\s*\[([^\]]*)\]$")


@dataclass(frozen=True)
class History(Mapping):
    """The columns of history.csv by name, a value a row; `units` has the unit of each."""

    columns: dict[str, np.ndarray]
    units: dict[str, str]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    def __iter__(self):
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)


@dataclass(frozen=True)
class Frame(Mapping):
    """The fields of one set of points at one time, by name: `(points,)` or `(points, components)`. Read from its
    file when first asked for; `units` has the unit of each."""

    time: float  # [s]
    file: Path

    @cached_property
    def _arrays(self) -> tuple[np.ndarray, dict[str, np.ndarray], dict[str, str]]:
        import h5py

        with h5py.File(self.file) as file:
            data = file["VTKHDF/PointData"]
            units = {name: _text(field.attrs.get("units", "")) for name, field in data.items()}
            return file["VTKHDF/Points"][()], {name: field[()] for name, field in data.items()}, units

    @property
    def points(self) -> np.ndarray:
        """Positions, a row a point, three columns [m]."""
        return self._arrays[0]

    @property
    def units(self) -> dict[str, str]:
        """The unit of each field."""
        return self._arrays[2]

    def __getitem__(self, name: str) -> np.ndarray:
        return self._arrays[1][name]

    def __iter__(self):
        return iter(self._arrays[1])

    def __len__(self) -> int:
        return len(self._arrays[1])


def _text(value: str | bytes) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


@dataclass(frozen=True)
class Run:
    """A folder that a run left, finished or not."""

    folder: Path
    summary: dict[str, Any] = field(repr=False)
    history: History = field(repr=False)
    frames: dict[str, list[Frame]] = field(repr=False)  # by set of points, `solid`, `cracks`, ...

    @property
    def scene(self) -> str:
        """The scene as run, the text of its file."""
        return self.summary.get("scene", {}).get("text", "")

    @property
    def outcome(self) -> str:
        """done, failed or stopped; unfinished where there is no summary."""
        return self.summary.get("outcome", "unfinished")

    def to_xarray(self):
        """History as an xarray.Dataset over `time` [s], each variable with its unit; needs python3-xarray."""
        import xarray

        history = self.history
        variables = {n: ("time", v, {"units": history.units[n]}) for n, v in history.items() if n != "time"}
        return xarray.Dataset(variables, {"time": ("time", history["time"], {"units": "s"})})

    def fields_to_xarray(self, points: str):
        """The fields of a set of points that does not move, over `time` and `point`; needs python3-xarray."""
        import xarray

        frames = self.frames[points]
        variables = {}
        for name, first in frames[0].items():
            dims = ("time", "point", f"{name}_component")[: 1 + first.ndim]
            values = np.stack([frame[name] for frame in frames])
            variables[name] = (dims, values, {"units": frames[0].units[name]})
        times = ("time", [frame.time for frame in frames], {"units": "s"})
        places = {axis: ("point", frames[0].points[:, k], {"units": "m"}) for k, axis in enumerate("xyz")}
        return xarray.Dataset(variables, {"time": times, **places})


def _read_history(path: Path) -> History:
    if not path.exists():
        return History({}, {})
    with path.open(newline="", encoding="utf-8") as stream:
        header, *rows = list(csv.reader(stream)) or [[]]
    rows = [row for row in rows if len(row) == len(header)]  # the last may be cut short
    table = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows]).reshape(-1, len(header))
    names = [_UNIT.sub("", cell.strip()) for cell in header]
    found = [_UNIT.search(cell) for cell in header]
    units = {name: unit.group(1) if unit else "" for name, unit in zip(names, found)}
    return History(dict(zip(names, table.T)), units)


def _read_frames(folder: Path) -> dict[str, list[Frame]]:
    series = {}
    for path in sorted(folder.glob("*.hdf.series")):
        listed = json.loads(path.read_text(encoding="utf-8"))["files"]
        frames = [Frame(entry["time"], folder / entry["name"]) for entry in listed]
        series[path.name.removesuffix(".hdf.series")] = frames
    return series


def read_run(folder: str | Path) -> Run:
    """Reads what `perifrac run` or a Simulation with `output` left. Frames are read when they are asked for."""
    folder = Path(folder)
    summary_file = folder / "summary.json"
    summary = json.loads(summary_file.read_text(encoding="utf-8")) if summary_file.exists() else {}
    run = Run(folder, summary, _read_history(folder / "history.csv"), _read_frames(folder / "frames"))
    if not summary and not run.history.columns and not run.frames:
        raise Error(f"{folder}: holds no run; expected summary.json, history.csv or frames/*.hdf.series")
    return run
