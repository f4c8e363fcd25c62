"""Synthesises the folder of a run with free fluid: a puddle that sinks into the ground, point by point."""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np

TIMES = [0.0, 1.0, 2.0, 3.0]  # [s]
SPACING = 0.5  # [m]
DENSITY = 1000.0  # [kg/m^3]


def lattice(columns: int, rows: int, bottom: float) -> np.ndarray:
    x, y = np.meshgrid(np.arange(columns) * SPACING, bottom + np.arange(rows) * SPACING, indexing="ij")
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])


def ground() -> np.ndarray:
    return lattice(12, 4, -4 * SPACING)


def water(step: int) -> np.ndarray:
    """A row less at every step, all sinking and spreading."""
    points = lattice(6, 4 - step, 0.5 * SPACING)
    return points * [1.0 + 0.1 * step, 1.0 - 0.05 * step, 1.0]


def mass(step: int) -> float:
    return DENSITY * SPACING**2 * (1.0 - 0.2 * step)  # [kg/m]


def pore_pressure(step: int) -> np.ndarray:
    return 1e3 * step + 100.0 * ground()[:, 1]


def fluid_pressure(step: int) -> np.ndarray:
    return 5e3 - 2e3 * water(step)[:, 1]


def velocity(step: int) -> np.ndarray:
    return np.column_stack([0.1 * water(step)[:, 0], -0.02 * water(step)[:, 1], np.zeros(len(water(step)))])


def write_frame(path: Path, points: np.ndarray, fields: dict[str, tuple[str, np.ndarray]]) -> None:
    with h5py.File(path, "w") as file:
        group = file.create_group("VTKHDF")
        group.attrs["Version"] = [1, 0]
        group["Points"] = points
        data = group.create_group("PointData")
        for name, (unit, values) in fields.items():
            data[name] = values
            data[name].attrs["units"] = unit


def write_series(folder: Path, name: str, frame) -> None:
    listed = []
    for step, time in enumerate(TIMES):
        listed.append({"name": f"{name}_{step:06d}.hdf", "time": time})
        write_frame(folder / listed[-1]["name"], *frame(step))
    (folder / f"{name}.hdf.series").write_text(json.dumps({"file-series-version": "1.0", "files": listed}))


def body_frame(step: int) -> tuple:
    return ground(), {"pore_pressure": ("Pa", pore_pressure(step)),
                      "displacement": ("m", np.zeros((len(ground()), 3)))}  # fmt: skip


def fluid_frame(step: int) -> tuple:
    points = water(step)
    return points, {"fluid_pressure": ("Pa", fluid_pressure(step)),
                    "fluid_velocity": ("m/s", velocity(step)),
                    "fluid_mass": ("kg/m", np.full(len(points), mass(step))),
                    "fluid_density": ("kg/m^3", np.full(len(points), DENSITY))}  # fmt: skip


def write_run(folder: Path) -> None:
    (folder / "frames").mkdir(parents=True)
    write_series(folder / "frames", "body", body_frame)
    write_series(folder / "frames", "fluid", fluid_frame)
    rows = ["time [s],step,free_fluid_mass [kg/m],fluid_mass_stored [kg/m],fluid_mass_gained [kg/m]"]
    for step, time in enumerate(TIMES):
        free = mass(step) * len(water(step))
        rows.append(f"{time},{step},{free},{free + 10.0},{free - mass(0) * 24}")
    (folder / "history.csv").write_text("\n".join(rows) + "\n")
    counts = {"points": 48, "bonds": 0, "fluid_points": 24}
    summary = {"scene": {"title": "Puddle"}, "outcome": "done", "counts": counts}
    (folder / "summary.json").write_text(json.dumps(summary))
