"""history.csv: one row per output, units in the header as `name [unit]`."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from no_run import NoRun

UNIT = re.compile(r"\s*\[([^\]]*)\]$")


@dataclass(frozen=True)
class Column:
    name: str
    unit: str
    values: np.ndarray


@dataclass(frozen=True)
class History:
    time: np.ndarray = field(default_factory=lambda: np.empty(0))  # [s]
    columns: list[Column] = field(default_factory=list)  # all others


def to_float(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return float("nan")


def read_history(path: Path) -> History:
    """An absent file is an empty history; a row cut short (the run was killed) is left out."""
    if not path.exists():
        return History()
    if not path.is_file():
        raise NoRun(f"{path}: not a file; expected what 'perifrac run' wrote")
    with path.open(newline="", encoding="utf-8") as stream:
        header, *rows = list(csv.reader(stream)) or [[]]
    table = np.array([[to_float(c) for c in row] for row in rows if len(row) == len(header)])
    if table.size == 0:
        return History()
    columns = []
    for cell, values in zip(header, table.T):
        name, unit, *_ = [*UNIT.split(cell.strip()), ""]
        columns.append(Column(name, unit, values))
    time = next((c for c in columns if c.name == "time"), None)
    if time is None:
        raise NoRun(f"{path}: no column 'time'; the header must name it as 'time [s]'")
    return History(time.values, [c for c in columns if c is not time])
