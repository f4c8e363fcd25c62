"""Synthesises the folder of a Mandel run: the exact solution, with a small decaying error added.

Series of paper equations 39 and 40; constants derived from the paper's Table 1.
"""

from __future__ import annotations

import csv
import json
from pathlib import Path

import h5py
import numpy as np

WIDTH, HEIGHT, FORCE = 40.0, 20.0, 1.0e4  # [m], [m], [N/m]
LAMBDA = MU = 4.0e8  # [Pa]
BIOT_MODULUS = 1.0 / (0.3 / 2.0e9 + 0.7 / 1.0e10)  # [Pa]
BULK = LAMBDA + 2.0 * MU / 3.0  # [Pa]
SKEMPTON = BIOT_MODULUS / (BULK + BIOT_MODULUS)
POISSON = 0.25
POISSON_UNDRAINED = (3 * POISSON + SKEMPTON * (1 - 2 * POISSON)) / (3 - SKEMPTON * (1 - 2 * POISSON))
DIFFUSIVITY = 9.6775  # [m^2/s]
PRESSURE_SCALE = SKEMPTON * (1 + POISSON_UNDRAINED) * FORCE / (3 * WIDTH)  # [Pa]
FRAME_TIMES = [0.01, 0.1, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]  # [s]
PROBES = {"x = 0": 0.0, "x = a/4": 10.0, "x = a/2": 20.0, "x = 3a/4": 30.0}  # [m]


def roots(count: int = 400) -> np.ndarray:
    """Positive roots of tan(beta) = (1 - nu) / (nu_u - nu) beta, one below each (n + 1/2) pi."""
    ratio = (1 - POISSON) / (POISSON_UNDRAINED - POISSON)
    low = np.pi * np.arange(count)
    high = low + np.pi / 2
    for _ in range(80):
        middle = 0.5 * (low + high)
        above = np.sin(middle) - ratio * middle * np.cos(middle)
        sign = np.where(np.arange(count) % 2 == 0, 1, -1)
        low, high = np.where(sign * above < 0, middle, low), np.where(sign * above < 0, high, middle)
    return low


BETA = roots()
WEIGHT = 1.0 / (BETA - np.sin(BETA) * np.cos(BETA))


def decay(time: float) -> np.ndarray:
    return np.exp(-(BETA**2) * DIFFUSIVITY * time / WIDTH**2)


def pressure(x: np.ndarray, time: float) -> np.ndarray:
    modes = np.sin(BETA) * WEIGHT * decay(time)
    shape = np.cos(np.outer(np.atleast_1d(x), BETA / WIDTH)) - np.cos(BETA)
    return 2 * PRESSURE_SCALE * shape @ modes


def displacement(points: np.ndarray, time: float) -> np.ndarray:
    total = np.sum(np.sin(BETA) * np.cos(BETA) * WEIGHT * decay(time))
    x, y = points[:, 0], points[:, 1]
    u = np.zeros_like(points)
    u[:, 0] = (FORCE * POISSON / (2 * MU * WIDTH) - FORCE * POISSON_UNDRAINED / (MU * WIDTH) * total) * x
    u[:, 0] += FORCE / MU * np.sin(np.outer(x, BETA / WIDTH)) @ (np.cos(BETA) * WEIGHT * decay(time))
    u[:, 1] = (-(1 - POISSON) / (2 * MU * WIDTH) + (1 - POISSON_UNDRAINED) / (MU * WIDTH) * total) * FORCE * y
    return u


def perturbed(values: np.ndarray, x: np.ndarray, time: np.ndarray | float) -> np.ndarray:
    dimensionless = DIFFUSIVITY * np.asarray(time) / WIDTH**2
    return values + 1.3e-3 * PRESSURE_SCALE * np.sin(3.0 + x / 7.0) / (1.0 + 60.0 * dimensionless)


def lattice() -> np.ndarray:
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5, indexing="ij")
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])


def reference_arrays() -> dict:
    """Histories, profiles and table as summary.json carries them."""
    time = np.geomspace(1e-3, 100.0, 132)
    histories = []
    for place, x in PROBES.items():
        exact = np.array([pressure(np.array([x]), t)[0] for t in time])
        computed = perturbed(exact, np.array(x), time)
        histories.append({"name": f"pore pressure at {place}", "unit": "Pa", "time": time.tolist(),
                          "computed": computed.tolist(), "exact": exact.tolist()})  # fmt: skip
    x = np.arange(WIDTH) + 0.5
    times = [1.0, 5.0, 10.0, 20.0, 50.0, 100.0]
    exact_rows = [pressure(x, t) for t in times]
    profile = {"name": "pore pressure along x", "unit": "Pa", "x_name": "x", "x_unit": "m", "times": times,
               "x": [x.tolist()] * len(times), "exact": [row.tolist() for row in exact_rows],
               "computed": [perturbed(row, x, t).tolist() for row, t in zip(exact_rows, times)]}  # fmt: skip
    table = []
    for t in FRAME_TIMES[2:]:
        error = 1.3e-3 / (1.0 + 60.0 * DIFFUSIVITY * t / WIDTH**2)
        table.append({"time": t, "dimensionless_time": DIFFUSIVITY * t / WIDTH**2,
                      "max_error": error, "plate_error": 0.3 * error})  # fmt: skip
    return {"histories": histories, "profiles": [profile], "table": table}


def write_frames(folder: Path) -> None:
    folder.mkdir()
    points = lattice()
    listed = []
    for number, time in enumerate(FRAME_TIMES):
        name = f"rock_{number:06d}.hdf"
        with h5py.File(folder / name, "w") as file:
            group = file.create_group("VTKHDF")
            group.attrs["Version"] = [1, 0]
            group["Points"] = points
            data = group.create_group("PointData")
            data["pore_pressure"] = perturbed(pressure(points[:, 0], time), points[:, 0], time)
            data["pore_pressure"].attrs["units"] = np.bytes_("Pa")
            data["displacement"] = displacement(points, time)
            data["displacement"].attrs["units"] = "m"
        listed.append({"name": name, "time": time})
    series = {"file-series-version": "1.0", "files": listed}
    (folder / "rock.hdf.series").write_text(json.dumps(series))


def write_history(path: Path) -> None:
    with path.open("w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(["time [s]", "step"] + [f"pore_pressure at {p} [Pa]" for p in PROBES] + ["fluid_mass [kg/m]"])
        for step, time in enumerate(np.geomspace(1e-3, 100.0, 60)):
            values = [pressure(np.array([x]), time)[0] for x in PROBES.values()]
            writer.writerow([time, step, *values, 0.12 - 0.05 * time / 100.0])


def write_run(folder: Path, with_reference: bool = True) -> dict:
    """Writes the folder and returns its summary."""
    folder.mkdir(parents=True)
    summary = json.loads((Path(__file__).parent / "summary.json").read_text())
    if with_reference:
        summary["reference"] |= reference_arrays()
    else:
        del summary["reference"]
    (folder / "summary.json").write_text(json.dumps(summary))
    write_frames(folder / "frames")
    write_history(folder / "history.csv")
    return summary
