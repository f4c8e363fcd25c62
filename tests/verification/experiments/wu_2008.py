#!/usr/bin/python3
"""The crack that Wu et al. (2008) drove through layers of stress in PMMA, beside the scene that repeats it by published
inputs, none of them fitted.

Usage: wu_2008.py PERIFRAC [--page] [CASE ...]

With --page, runs that change one input each, whose figures go into docs/experiments.md and docs/images/wu_2008.svg.
"""
import tempfile
import unittest
from pathlib import Path

import experiment
import h5py
import numpy

PERIFRAC = None
SCENE = experiment.ROOT / "configs/wu_2008.yaml"
TIMES = (60.0, 144.0, 376.0, 665.0)  # s


def spaced(spacing, radius):
    """Points that far apart [mm]: layers and squares of the crack meet as they do at 10 mm."""
    return {"body.spacing": f"{spacing!r} mm", "body.from": "[0 mm, -150 mm, -300 mm]",
            "body.size": "[275 mm, 300 mm, 500 mm]", "cracks[0].centre": "[0 mm, 0 mm, 0 mm]",
            "cracks[0].radius": f"{radius!r} mm"}  # fmt: skip


# Of the first minute's crack, six times as fast; it has the same squares at 60 s.
SMALL_BODY = {"body.from": "[0 mm, -100 mm, -155 mm]", "body.size": "[150 mm, 200 mm, 270 mm]"}
# One stress and one rate, Q = 6.5e-9 m^3/s in all of the crack: what a round crack does without toughness is known.
ONE_STRESS = {"body.from": "[0 mm, -150 mm, -225 mm]", "body.size": "[220 mm, 300 mm, 450 mm]",
              "solid.regions.top.confining_stress": "[7 MPa, 7 MPa, 7 MPa]",
              "solid.regions.bottom.confining_stress": "[7 MPa, 7 MPa, 7 MPa]",
              "crack_fluid.inlets[0].schedule.factors": "[3.25, 3.25, 3.25, 3.25, 3.25, 3.25]"}  # fmt: skip
RUNS = {
    "as published, 10 mm": {},
    "12.5 mm": spaced(12.5, 31.25),
    "8.33 mm": spaced(25.0 / 3.0, 25.0),
    "500 mm of PMMA across the crack in place of 300": {
        "body.from": "[0 mm, -250 mm, -305 mm]", "body.size": "[280 mm, 500 mm, 510 mm]"},
    "K_IC of 0.4 MPa √m": {"damage.fracture_toughness": "0.4 MPa*sqrt(m)"},
}  # fmt: skip


def footprints():
    """By time, the corners of the crack's edge: along, and above the well [m]."""
    data = numpy.genfromtxt(Path(__file__).with_name("wu_2008_footprints.csv"), delimiter=",", skip_header=1)
    return {t: 1e-3 * data[data[:, 0] == t][:, 1:] for t in TIMES}


def area(polygon):
    x, z = polygon.T
    return 0.5 * abs(numpy.dot(x, numpy.roll(z, 1)) - numpy.dot(z, numpy.roll(x, 1)))


def round_area(t):
    """Without toughness and in an infinite body (Savitski & Detournay 2002): R = 0.6944 (E' Q^3 t^4 / 12 mu)^(1/9)."""
    radius = 0.6944 * (3.3e9 / (1.0 - 0.4**2) * 6.5e-9**3 * t**4 / (12.0 * 30.0)) ** (1.0 / 9.0)
    return numpy.pi * radius**2


class Run:
    """The whole crack, of which half is simulated, at the times that were measured; areas in m^2."""

    def __init__(self, folder, keys, until=TIMES[-1]):
        column = experiment.run(PERIFRAC, SCENE, folder, keys, "--until", f"{until} s")
        self.times = [t for t in TIMES if t <= until]
        self.area = [2.0 * numpy.interp(t, column["time"], column["wetted_area"]) for t in self.times]
        self.squares = {}  # by time, those at least half of which is wet: low and high corners along and above
        for name in sorted((folder / "frames").glob("crack_*.hdf")):
            with h5py.File(name) as file:
                t = file["VTKHDF/FieldData/TimeValue"][0]
                wet = file["VTKHDF/PointData/crack_wetted_fraction"][:] >= 0.5
                corners = file["geometry/corners"][:].reshape(-1, 4, 3)[wet][:, :, (0, 2)]
            self.squares[float(t)] = corners.min(axis=1), corners.max(axis=1)

    def errors(self):
        return [found / area(polygon) - 1.0 for found, polygon in zip(self.area, footprints().values())]

    def edges(self, t):
        """Half the width, the lower and the upper edge [m]."""
        low, high = self.squares[t]
        return high[:, 0].max(), low[:, 1].min(), high[:, 1].max()


class Wu(unittest.TestCase):
    def test_begins_as_the_experiment_did(self):
        with tempfile.TemporaryDirectory() as folder:
            run = Run(Path(folder) / "run", SMALL_BODY, until=60.0)
        self.assertLess(abs(run.errors()[0]), 0.05)

    def test_footprints(self):
        with tempfile.TemporaryDirectory() as folder:
            run = Run(Path(folder) / "run", {})
        for t, error, most in zip(TIMES, run.errors(), (0.05, 0.03, 0.08, 0.12)):
            self.assertLess(abs(error), most, t)
        self.assertLess(abs(run.edges(665.0)[2] - footprints()[665.0][:, 1].max()), 0.0125)

    def test_under_one_stress_is_as_large_as_a_round_crack(self):
        with tempfile.TemporaryDirectory() as folder:
            column = experiment.run(PERIFRAC, SCENE, Path(folder) / "run", ONE_STRESS, "--until", "200 s")
        times = numpy.linspace(100.0, 200.0, 11)
        found = 2.0 * numpy.interp(times, column["time"], column["wetted_area"]) / round_area(times) - 1.0
        print("area of a round crack, off by", found.round(4))
        self.assertLess(abs(found).max(), 0.05)

    def test_compares_with_half_of_the_footprints(self):
        lines = SCENE.with_suffix(".csv").read_text(encoding="utf-8").splitlines()[1:]
        table = numpy.array([list(map(float, line.split(","))) for line in lines])
        for (t, half), (time, polygon) in zip(table, footprints().items(), strict=True):
            self.assertEqual(t, time)
            self.assertAlmostEqual(half, 0.5 * area(polygon), delta=1e-5 * half)


def write_page():
    with tempfile.TemporaryDirectory() as folder:
        runs = {name: Run(Path(folder) / f"{k}", keys) for k, (name, keys) in enumerate(RUNS.items())}
    lines = ["| run | area [mm²], and off by, at " + ", ".join(f"{t:g}" for t in TIMES)
             + " s | half its width, lower and upper edge at 665 s [mm] |", "|---|---|---|"]  # fmt: skip
    polygons = footprints()
    last = 1e3 * polygons[665.0]
    lines.append("| *measured* | " + ", ".join(f"{1e6 * area(polygon):.0f}" for polygon in polygons.values())
                 + f" | {0.5 * (last[:, 0].max() - last[:, 0].min()):.0f}, {last[:, 1].min():.0f}, "
                 + f"{last[:, 1].max():+.0f} |")  # fmt: skip
    for name, run in runs.items():
        width, lower, upper = (1e3 * edge for edge in run.edges(665.0))
        found = ", ".join(f"{1e6 * a:.0f} ({100 * e:+.1f} %)" for a, e in zip(run.area, run.errors()))
        lines.append(f"| {name} | {found} | {width:.0f}, {lower:.0f}, {upper:+.0f} |")
    experiment.write_table("wu", lines)
    draw(runs["as published, 10 mm"])


def draw(run):
    figure, axes = experiment.new_picture(4, (9.0, 3.4))
    for axis, (t, polygon) in zip(axes, footprints().items()):
        low, high = (1e3 * corner for corner in run.squares[t])
        for z in numpy.unique(low[:, 1].round(6)):  # squares of a row lie side by side
            row = abs(low[:, 1] - z) < 1e-3
            width = 2.0 * high[row, 0].max()
            axis.barh(z, width, high[row, 1][0] - z, left=-0.5 * width, align="edge", color="#9ecae1", lw=0.0)
        axis.plot(*(1e3 * numpy.vstack([polygon, polygon[:1]]).T), color="#444444", lw=1.2)
        for border in (-25.0, 25.0):
            axis.axhline(border, color="#d95f02", lw=0.8, ls=":")
        axis.set(title=f"{t:g} s", xlim=(-150, 150), ylim=(-200, 60), aspect="equal", xlabel="along [mm]")
    axes[0].set(ylabel="above the well [mm]")
    experiment.save(figure, "wu_2008")


if __name__ == "__main__":
    experiment.main(globals(), write_page)
