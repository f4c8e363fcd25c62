"""The runs behind the paper's figures: which scenes, what is replaced in them, and what they left."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

CONFIGS = Path(__file__).resolve().parent.parent.parent / "configs"


@dataclass(frozen=True)
class Scheme:
    """One way to simulate a case: a scene, what is replaced in it, and when its load is all there."""

    label: str
    scene: str
    replace: list[str] = field(default_factory=list)
    loaded_at: float = 0.0  # [s]; times of figures count from here
    until: str = ""  # of a long run only a part is needed


PAPER_RAMP = 0.1  # [s] of the load in configs/paper
SCHEMES = {
    "terzaghi": Scheme("perifrac", "terzaghi.yaml"),
    "terzaghi_paper": Scheme("the paper's scheme", "paper/terzaghi.yaml", loaded_at=PAPER_RAMP / 2),
    "mandel": Scheme("perifrac", "mandel.yaml"),
    "mandel_paper": Scheme("the paper's scheme", "paper/mandel.yaml", loaded_at=PAPER_RAMP / 2),
}
for _dx in (2.0, 1.0, 0.5):
    _common = [f"body.spacing={_dx} m"]
    SCHEMES[f"delta_{_dx}"] = Scheme(f"horizon {2 * _dx:g} m", "convergence_delta.yaml", _common)
    SCHEMES[f"m_{_dx}"] = Scheme(f"m = {2 / _dx:g}", "convergence_m.yaml", [*_common, f"body.horizon_ratio={2 / _dx}"])
    for _name, _ratio in (("delta", 2.0), ("m", 2 / _dx)):
        SCHEMES[f"{_name}_paper_{_dx}"] = Scheme(
            f"horizon {2 * _dx:g} m" if _name == "delta" else f"m = {2 / _dx:g}",
            "paper/mandel.yaml", [*_common, f"body.horizon_ratio={_ratio}"], PAPER_RAMP / 2, "33.116 s")  # fmt: skip
# 100 s of steady head after the load, as in the paper, and on until the flow is steady (perifrac).
_SHOWN = ["output.times=[70 s, 140 s, 500 s, 1000 s, 2000 s]", "output.history_interval=1 s"]
SCHEMES["head"] = Scheme("perifrac", "constant_head.yaml", _SHOWN, 20.0)
SCHEMES["head_exchange"] = Scheme("the paper's exchange, C = 1", "constant_head.yaml", [*_SHOWN, "interface.exchange=paper", "interface.smoothing=1", "ledger.mass_error=10"], 20.0)  # fmt: skip
SCHEMES["head_force"] = Scheme("force: one_sided", "constant_head.yaml", [*_SHOWN, "interface.force=one_sided"], 20.0, "500 s")  # fmt: skip
# Hydraulic fracture; by the paper's own points from the start of the pump.
SCHEMES["storage"] = Scheme("perifrac (1 mm)", "../docs/paper/hf_storage_notch.yaml")
SCHEMES["storage_slit"] = Scheme("perifrac, a slit full of stiff water", "hf_storage_pores.yaml")
SCHEMES["leak_off"] = Scheme("into pores", "hf_leakoff_pores.yaml")
SCHEMES["carter"] = Scheme("Carter's law", "hf_leakoff.yaml")
SCHEMES["stiff_water"] = Scheme("Carter's law, stiff water", "hf_leakoff_stiff_water.yaml")
SCHEMES["no_leak_off"] = Scheme("nothing leaks", "hf_leakoff.yaml", ["crack_fluid.leak_off_coefficient=0"])
SCHEMES["network"] = Scheme("network", "hf_storage.yaml")
SCHEMES["storage_paper"] = Scheme("the paper's scheme (2 mm)", "paper/hf_storage.yaml", loaded_at=0.005)
SCHEMES["leak_off_paper"] = Scheme("the paper's scheme (2 mm)", "paper/hf_leakoff.yaml", loaded_at=0.005)
SCHEMES["points"] = Scheme("the paper's points", "hf_storage_points.yaml", loaded_at=0.005)
SCHEMES["natural"] = Scheme("perifrac", "hf_natural_fracture.yaml", [
    "pore_flow={type: darcy, permeability: 1.02e-15 m^2, biot_coefficient: 1, porosity: 0.1, integrator: {type: explicit}, "
    "fluid: {density: 1000 kg/m^3, viscosity: 1 cP, bulk_modulus: 2.2 GPa}}",
    "crack_fluid.leak_off=pores", "coupling.iterations={max: 100, tolerance: 3e-3}", "coupling.acceleration=quasi_newton"])  # fmt: skip


@dataclass
class Frame:
    time: float
    points: np.ndarray
    fields: dict[str, np.ndarray]


class Runs:
    """Runs scenes on demand and reads what they left."""

    def __init__(self, perifrac: Path, folder: Path):
        self.perifrac, self.folder = perifrac, folder

    def of(self, name: str) -> Path:
        scheme, folder = SCHEMES[name], self.folder / name
        command = [str(self.perifrac), "run", str(CONFIGS / scheme.scene), "--no-report", "--output", str(folder)]
        command += ["--threads", "1"]
        for assignment in scheme.replace:
            command += ["--set", assignment]
        if scheme.until:
            command += ["--until", scheme.until]
        stamp = folder / "command.txt"
        if stamp.exists() and stamp.read_text(encoding="utf-8") == " ".join(command):
            return folder
        begin = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True)
        print(f"{name}: exit {done.returncode}, {time.monotonic() - begin:.1f} s", flush=True)
        if done.returncode == 2:
            sys.exit(done.stderr)
        if done.returncode != 0:
            print(done.stderr.strip().splitlines()[-1], flush=True)  # a figure shows how far it came
        stamp.write_text(" ".join(command), encoding="utf-8")
        return folder

    def history(self, name: str) -> dict[str, np.ndarray]:
        with (self.of(name) / "history.csv").open(newline="", encoding="utf-8") as stream:
            header, *rows = list(csv.reader(stream))
        table = np.array([[float(c or "nan") for c in row] for row in rows if len(row) == len(header)])
        columns = {cell.split(" [")[0]: values for cell, values in zip(header, table.T)}
        columns["time"] = columns["time"] - SCHEMES[name].loaded_at
        return columns

    def frames(self, name: str, points: str = "body") -> list[Frame]:
        frames = []
        series = json.loads((self.of(name) / f"frames/{points}.hdf.series").read_text(encoding="utf-8"))
        for entry in series["files"]:
            with h5py.File(self.folder / name / "frames" / entry["name"]) as file:
                group = file["VTKHDF"]
                fields = {k: v[()] for k, v in group["PointData"].items()}
                frames.append(Frame(entry["time"] - SCHEMES[name].loaded_at, group["Points"][()], fields))
        return frames

    def reference(self, name: str, quantity: str) -> tuple[np.ndarray, np.ndarray]:
        """Times and computed values of a history that the run held against its reference."""
        summary = json.loads((self.of(name) / "summary.json").read_text(encoding="utf-8"))
        history = next(h for h in summary["reference"]["histories"] if h["name"].startswith(quantity))
        values = [float("nan") if v is None else v for v in history["computed"]]
        return np.array(history["time"]) - SCHEMES[name].loaded_at, np.array(values)

    def frame_at(self, name: str, when: float) -> Frame | None:
        """The frame within 2 % (or 20 ms) of a time, if the run came that far; at 0 the first with all the load."""
        if when == 0.0:
            return next(f for f in self.frames(name) if f.time > SCHEMES[name].loaded_at - 1e-9)
        nearest = min(self.frames(name), key=lambda frame: abs(frame.time - when))
        return nearest if abs(nearest.time - when) <= max(0.02 * when, 0.02) else None
