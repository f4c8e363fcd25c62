"""Synthesises runs with cracks: a slit in a plate, in 2D, and a round one in a block, in 3D."""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np

TIMES = [0.0, 0.5, 1.0]  # [s]
FAR_STRESS = 2.0e6  # [Pa], compression
SCENE = """title: A made-up crack
dimension: 2
body: {shape: box, size: [10 mm, 10 mm]}
solid: {type: quasi_static, material: {youngs_modulus: 20 GPa}}
crack_fluid:
  type: network
  inlets:
    - {name: well, at: [0 mm, 5 mm], rate: 1e-4 m^2/s}
# --set solid.material.youngs_modulus=25 GPa
"""


def write_frame(path: Path, points: np.ndarray, fields: dict[str, tuple[str, np.ndarray]]) -> None:
    with h5py.File(path, "w") as file:
        group = file.create_group("VTKHDF")
        group.attrs["Version"] = [1, 0]
        group["Points"] = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
        data = group.create_group("PointData")
        for name, (unit, values) in fields.items():
            data[name] = values
            data[name].attrs["units"] = unit


def lattice(dimension: int, count: int, spacing: float) -> np.ndarray:
    along = (np.arange(count) + 0.5) * spacing
    return np.column_stack([axis.ravel() for axis in np.meshgrid(*[along] * dimension, indexing="ij")])


def body_fields(points: np.ndarray, time: float) -> dict[str, tuple[str, np.ndarray]]:
    """A uniform compression, and a peak of tension that goes along x."""
    count, dimension = points.shape
    size = points.max()
    peak = np.exp(-40 * ((points[:, 0] / size - 0.3 - 0.4 * time) ** 2 + (points[:, -1] / size - 0.5) ** 2))
    stress = np.zeros((count, dimension, dimension))
    stress[:] = -FAR_STRESS * np.diag([1.0, 0.5, 0.8][:dimension])
    stress[:, 0, 0] += 3 * FAR_STRESS * peak
    stress[:, 0, 1] = stress[:, 1, 0] = 0.3 * FAR_STRESS * peak
    moved = np.zeros((count, 3))
    moved[:, dimension - 1] = 1e-6 * (1 + time) * np.sign(points[:, -1] - points[:, -1].mean())
    return {"effective_stress": ("Pa", stress.reshape(count, -1)), "displacement": ("m", moved),
            "damage": ("1", (peak > 0.9).astype(float))}  # fmt: skip


def crack_points(dimension: int, time: float, spacing: float, count: int) -> np.ndarray:
    """Facets in the middle plane, from x = 0: more of them with time."""
    reach = int(count * (0.3 + 0.4 * time))
    along = (np.arange(reach) + 0.5) * spacing
    middle = 0.5 * count * spacing
    if dimension == 2:
        return np.column_stack([along, np.full(reach, middle)])
    x, y = (axis.ravel() for axis in np.meshgrid(along, along, indexing="ij"))
    inside = np.hypot(x, y) < reach * spacing
    return np.column_stack([x, y, np.full(x.size, middle)])[inside]


def crack_fields(points: np.ndarray, time: float) -> dict[str, tuple[str, np.ndarray]]:
    distance = np.linalg.norm(points[:, :-1], axis=1)
    reach = distance.max()
    return {"crack_opening": ("m", 2e-5 * np.sqrt(np.maximum(1 - (distance / (1.05 * reach)) ** 2, 0))),
            "crack_pressure": ("Pa", 3e6 * (1 - 0.5 * distance / reach)),
            "crack_wetted_fraction": ("1", (distance < 0.8 * reach).astype(float))}  # fmt: skip


def write_frames(folder: Path, dimension: int, count: int, spacing: float, times: list[float]) -> None:
    folder.mkdir(parents=True)
    listed: dict[str, list] = {"body": [], "crack": []}
    body = lattice(dimension, count, spacing)
    for number, time in enumerate(times):
        crack = crack_points(dimension, time, spacing, count)
        for name, points, fields in (("body", body, body_fields(body, time)), ("crack", crack, crack_fields(crack, time))):
            write_frame(folder / f"{name}_{number:06d}.hdf", points, fields)
            listed[name].append({"name": f"{name}_{number:06d}.hdf", "time": time})
    for name, files in listed.items():
        (folder / f"{name}.hdf.series").write_text(json.dumps({"file-series-version": "1.0", "files": files}))


def write_history(path: Path) -> None:
    rows = ["time [s],inlet_well_pressure [Pa],crack_length [m]"]
    rows += [f"{t:.6g},{3e6 * (1 - 0.3 * t):.6g},{1e-3 * (3 + 4 * t):.6g}" for t in np.linspace(0, 1, 41)]
    path.write_text("\n".join(rows) + "\n")


def summary(dimension: int) -> dict:
    return {"scene": {"title": "A made-up crack", "path": "crack.yaml", "text": SCENE}, "version": "0.1.0",
            "dimension": dimension, "outcome": "done", "time": {"value": 1.0, "unit": "s"},
            "effects": ["solid: quasi_static"], "counts": {"points": 400}, "modules": [], "wall_time": 1.5,
            "ledger": {"mass_error": 1e-15}, "warnings": ["made up"],
            "reference": {"type": "table", "title": "elsewhere.csv", "table": [{"time": 1.0, "length_error": 0.02}],
                          "histories": [{"name": "crack_length", "unit": "m", "time": [0.0, 0.5, 1.0],
                                         "computed": [3e-3, 5e-3, 7e-3], "exact": [3e-3, 5.1e-3, 6.9e-3]}]}}  # fmt: skip


def write_run(folder: Path, dimension: int = 2, count: int = 20, spacing: float = 5e-4, times: list[float] | None = None) -> None:
    write_frames(folder / "frames", dimension, count, spacing, times or TIMES)
    write_history(folder / "history.csv")
    (folder / "summary.json").write_text(json.dumps(summary(dimension)))
