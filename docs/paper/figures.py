#!/usr/bin/python3
"""Draws the paper's figures anew: its scheme as printed beside perifrac's own, both against the exact solution.

usage: figures.py PERIFRAC [--runs DIR] [--images DIR] [--only NAME ...] [--jobs N]

Runs the scenes that a figure needs (once; a finished run in DIR is used again), draws figNN.png and writes
errors.csv: for every figure and scheme the largest and the root-mean-square error. Rows of figures that are not
drawn (--only) stay.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import fracture_figures
from drawing import MARKS, Errors, panels, save
from runs import SCHEMES, Frame, Runs
from solutions import Mandel, Seepage, Terzaghi

HERE = Path(__file__).resolve().parent

COLUMN = Terzaghi(height=50.0, stiffness=5e9 + 4 / 3 * 4e9, storage=0.306 / 2.2e9, biot=1.0,
                  mobility=1.02e-11 / 1e-3, load=14.624e6)  # fmt: skip
SLAB = Mandel(lame_lambda=4e8, shear_modulus=4e8, storage=0.3 / 2e9 + 0.7 / 1e10, biot=1.0,
              mobility=1.019368e-11 / 1e-3, width=40.0, force=1e4)  # fmt: skip
SLAB_HEIGHT = 20.0
SPECIMEN = Seepage(length=50.0, storage=0.306 / 22e6, mobility=1.02e-11 / 1e-3, head=98.1e3, ramp=40.0)
PROFILE_TIMES = [1.0, 5.0, 10.0, 20.0, 40.0]


def column_profile(frame: Frame) -> tuple[np.ndarray, np.ndarray]:
    """Depth below the column's top and pressure over p0, along its middle."""
    x, y = frame.points[:, 0], frame.points[:, 1]
    middle = x[np.argmin(np.abs(x - 0.5 * (x.min() + x.max())))]
    row = np.flatnonzero((np.abs(x - middle) < 1e-6) & (y > 0) & (y < COLUMN.height))
    row = row[np.argsort(y[row])]
    return COLUMN.height - y[row], frame.fields["pore_pressure"][row] / COLUMN.initial_pressure


def fig05(runs: Runs, images: Path, errors: Errors) -> None:
    """Excess pore pressure over the column at 0, 1, 5, 10, 20, 40 s."""
    figure, axes = panels(2, "Fig 5: excess pore pressure in the column [MPa], 0 1 5 10 20 40 s")
    for axis, name in zip(axes, ["terzaghi_paper", "terzaghi"]):
        axis.set_title(SCHEMES[name].label, fontsize=9)
        axis.grid(False)
        offset, image = 0.0, None
        for when in [0.0, *PROFILE_TIMES]:
            frame = runs.frame_at(name, when)
            if frame is not None:
                x, y = frame.points[:, 0], frame.points[:, 1]
                image = axis.scatter(x - x.min() + offset, y, c=frame.fields["pore_pressure"] / 1e6, s=5, marker="s",
                                     cmap="viridis", vmin=0.0, vmax=6.2, linewidths=0)  # fmt: skip
                axis.text(offset, y.max() + 1.5, f"{when:g} s", fontsize=8)
                offset += np.ptp(x) + 4.0
        axis.set_aspect("equal")
        axis.set_xticks([])
        axis.set_ylabel("height [m]")
        if image is not None:
            figure.colorbar(image, ax=axis, shrink=0.8)
    save(figure, images, "fig05")


def fig06(runs: Runs, images: Path, errors: Errors) -> None:
    """Profiles of p/p0 along the column."""
    figure, axes = panels(2, "Fig 6: excess pore pressure along the column", sharey=True)
    fine = np.linspace(0.0, COLUMN.height, 400)
    for axis, name in zip(axes, ["terzaghi_paper", "terzaghi"]):
        axis.set_title(SCHEMES[name].label, fontsize=9)
        for k, when in enumerate(PROFILE_TIMES):
            axis.plot(COLUMN.pressure(fine, when) / COLUMN.initial_pressure, fine / COLUMN.height, color=f"C{k}", lw=1.2)
            frame = runs.frame_at(name, when)
            if frame is None:
                continue
            depth, pressure = column_profile(frame)
            axis.plot(pressure, depth / COLUMN.height, MARKS[k], color=f"C{k}", ms=3.5, mfc="white", label=f"{when:g} s")
            exact = COLUMN.pressure(depth, frame.time) / COLUMN.initial_pressure
            errors.add("6", SCHEMES[name].label, f"p/p0 at {when:g} s", pressure, exact)
        axis.set_xlabel("p / p0")
        axis.set_xlim(-0.05, 1.15)
        axis.legend(fontsize=8, frameon=False)
    axes[0].set_ylabel("depth / H")
    axes[0].invert_yaxis()
    save(figure, images, "fig06")


def settlement(runs: Runs, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Times and degree of consolidation, from the top's settlement in the frames.

    The undrained settlement is taken off, as the paper does, by its exact value."""
    times, degrees = [], []
    undrained = -(COLUMN.load - COLUMN.biot * COLUMN.initial_pressure) / COLUMN.stiffness * COLUMN.height
    final = -COLUMN.load / COLUMN.stiffness * COLUMN.height
    for frame in runs.frames(name):
        if frame.time < SCHEMES[name].loaded_at - 1e-9:
            continue
        y, u = frame.points[:, 1], frame.fields["displacement"][:, 1]
        rows = sorted({round(v, 6) for v in y[(y > 0) & (y < COLUMN.height)]})[-2:]
        below, top = (u[np.abs(y - row) < 1e-6].mean() for row in rows)
        settled = top + (top - below) / (rows[1] - rows[0]) * (COLUMN.height - rows[1])  # at the face itself
        times.append(frame.time)
        degrees.append((settled - undrained) / (final - undrained))
    return np.array(times), np.array(degrees)


def fig07(runs: Runs, images: Path, errors: Errors) -> None:
    """Degree of consolidation over time."""
    figure, axes = panels(1, "Fig 7: degree of consolidation")
    fine = np.linspace(0.0, 50.0, 300)
    axes[0].plot(fine, COLUMN.consolidation(fine), "k-", lw=1.2, label="exact")
    for k, name in enumerate(["terzaghi_paper", "terzaghi"]):
        times, degrees = settlement(runs, name)
        axes[0].plot(times, degrees, MARKS[k], ms=4, mfc="white", color=f"C{k}", label=SCHEMES[name].label)
        errors.add("7", SCHEMES[name].label, "degree of consolidation", degrees, COLUMN.consolidation(times))
    axes[0].set_xlabel("time [s]")
    axes[0].set_ylabel("U")
    axes[0].legend(fontsize=8, frameon=False)
    save(figure, images, "fig07")


def probe(history: dict[str, np.ndarray], place: str) -> np.ndarray:
    return history[f"pore_pressure at {place}"]


def fig09(runs: Runs, images: Path, errors: Errors) -> None:
    """Pressure over time at four places of Mandel's slab."""
    figure, axes = panels(2, "Fig 9: pore pressure in Mandel's problem", sharey=True)
    fine = np.geomspace(0.05, 170.0, 300)
    for axis, name in zip(axes, ["mandel_paper", "mandel"]):
        axis.set_title(SCHEMES[name].label, fontsize=9)
        history = runs.history(name)
        for k, (place, part) in enumerate([("a/4", 0.25), ("a/2", 0.5), ("3a/4", 0.75)]):
            x = part * SLAB.width
            axis.plot(fine, SLAB.pressure([x], fine)[:, 0] / SLAB.initial_pressure, color=f"C{k}", lw=1.2)
            when, value = history["time"], probe(history, place) / SLAB.initial_pressure
            use = when > 0.5
            shown = np.unique(np.searchsorted(when[use], np.geomspace(0.5, when.max() * 0.999, 40)))
            axis.plot(when[use][shown], value[use][shown], MARKS[k], ms=3.5, mfc="white", color=f"C{k}", label=f"x = {place}")
            exact = SLAB.pressure([x], when[use])[:, 0] / SLAB.initial_pressure
            errors.add("9", SCHEMES[name].label, f"p/p0 at {place}, t > 0.5 s", value[use], exact)
        axis.set_xlabel("time [s]")
        axis.legend(fontsize=8, frameon=False)
    axes[0].set_ylabel("p / p0")
    save(figure, images, "fig09")


def slab_profile(frame: Frame, axis: int) -> np.ndarray:
    """Points of the slab proper (no layer) nearest to the middle, along `axis`."""
    x, y = frame.points[:, 0], frame.points[:, 1]
    inside = (x > 0) & (x < SLAB.width) & (y > 0) & (y < SLAB_HEIGHT)
    across = frame.points[:, 1 - axis]
    row = np.flatnonzero(inside & (np.abs(across - across[inside].min()) < 1e-6))
    return row[np.argsort(frame.points[row, axis])]


def fig10(runs: Runs, images: Path, errors: Errors) -> None:
    """Pressure along x at several times."""
    figure, axes = panels(2, "Fig 10: pore pressure along x in Mandel's problem", sharey=True)
    fine = np.linspace(0.0, SLAB.width, 300)
    for axis, name in zip(axes, ["mandel_paper", "mandel"]):
        axis.set_title(SCHEMES[name].label, fontsize=9)
        wanted = [f.time for f in runs.frames("mandel") if f.time > 1.0][:5]
        for k, when in enumerate(wanted):
            frame = runs.frame_at(name, when)
            axis.plot(fine / SLAB.width, SLAB.pressure(fine, [when])[0] / SLAB.initial_pressure, color=f"C{k}", lw=1.2)
            if frame is None:
                continue
            row = slab_profile(frame, 0)
            x, value = frame.points[row, 0], frame.fields["pore_pressure"][row] / SLAB.initial_pressure
            axis.plot(x / SLAB.width, value, MARKS[k], ms=3.5, mfc="white", color=f"C{k}", label=f"{when:.3g} s")
            exact = SLAB.pressure(x, [frame.time])[0] / SLAB.initial_pressure
            errors.add("10", SCHEMES[name].label, f"p/p0 at {when:.3g} s", value, exact)
        axis.set_xlabel("x / a")
        axis.legend(fontsize=8, frameon=False)
    axes[0].set_ylabel("p / p0")
    save(figure, images, "fig10")


def fig11(runs: Runs, images: Path, errors: Errors) -> None:
    """Vertical displacement at b/4, b/2, 3b/4 and b."""
    figure, axes = panels(2, "Fig 11: vertical displacement in Mandel's problem", sharey=True)
    fine = np.linspace(0.0, 170.0, 300)
    for axis, name in zip(axes, ["mandel_paper", "mandel"]):
        axis.set_title(SCHEMES[name].label, fontsize=9)
        frames = [f for f in runs.frames(name) if f.time > 0.5]
        for k, part in enumerate([0.25, 0.5, 0.75, 1.0]):
            rows = [slab_profile(f, 1) for f in frames]
            at = [r[np.argmin(np.abs(f.points[r, 1] - part * SLAB_HEIGHT))] for f, r in zip(frames, rows)]
            y = frames[0].points[at[0], 1]
            times = np.array([f.time for f in frames])
            value = np.array([f.fields["displacement"][i, 1] for f, i in zip(frames, at)])
            axis.plot(fine, 1e6 * SLAB.vertical_displacement([y], fine)[:, 0], color=f"C{k}", lw=1.2)
            axis.plot(times, 1e6 * value, MARKS[k], ms=4, mfc="white", color=f"C{k}", label=f"y = {part:g} b")
            exact = SLAB.vertical_displacement([y], times)[:, 0]
            scale = np.abs(SLAB.vertical_displacement([y], [1e6])[0, 0])
            errors.add("11", SCHEMES[name].label, f"u_y at {part:g} b over its final value", value / scale, exact / scale)
        axis.set_xlabel("time [s]")
        axis.legend(fontsize=8, frameon=False, ncols=4, loc="upper center")
        axis.set_ylim(-4.7, 0.0)
    axes[0].set_ylabel("u_y [um]")
    save(figure, images, "fig11")


def convergence(runs: Runs, images: Path, errors: Errors, figure_name: str, kind: str, title: str) -> None:
    figure, axes = panels(2, title, sharey=True)
    fine = np.geomspace(0.2, 100.0, 300)
    for axis, infix, label in zip(axes, ["paper_", ""], ["the paper's scheme", "perifrac"]):
        axis.set_title(label, fontsize=9)
        axis.semilogx(fine, SLAB.pressure([10.0], fine)[:, 0] / SLAB.initial_pressure, "k-", lw=1.2, label="exact")
        for k, dx in enumerate([2.0, 1.0, 0.5]):
            name = f"{kind}_{infix}{dx}"
            history = runs.history(name)
            when, value = history["time"], probe(history, "a/4") / SLAB.initial_pressure
            use = (when > 0.3) & (when < 100.0)
            axis.semilogx(when[use], value[use], color=f"C{k}", lw=1.0, label=SCHEMES[name].label)
            exact = SLAB.pressure([SLAB.width / 4], when[use])[:, 0] / SLAB.initial_pressure
            errors.add(figure_name, label, f"p/p0 at a/4, dx = {dx:g} m", value[use], exact)
        axis.set_xlabel("time [s]")
        axis.set_ylim(0.4, 1.2)  # what blows up leaves the picture
        axis.legend(fontsize=8, frameon=False)
    axes[0].set_ylabel("p / p0 at x = a/4")
    save(figure, images, f"fig{figure_name}")


def fig12(runs: Runs, images: Path, errors: Errors) -> None:
    convergence(runs, images, errors, "12", "delta", "Fig 12: horizon and spacing reduced together, m = 2")


def fig13(runs: Runs, images: Path, errors: Errors) -> None:
    convergence(runs, images, errors, "13", "m", "Fig 13: spacing reduced within a horizon of 2 m")


def fig14(runs: Runs, images: Path, errors: Errors) -> None:
    """Pressure and flux in the constant head test, water above and specimen below."""
    figure, axes = panels(4, "Fig 14: constant head test, pressure [kPa] and downward flux [1e-5 m/s]", height=5.0)
    for pair, name in zip((axes[:2], axes[2:]), ["head_exchange", "head"]):
        body, water = runs.frames(name)[-1], runs.frames(name, "fluid")[-1]
        pressure, flux = SPECIMEN.profile(body.points[:, 1], body.time + SCHEMES[name].loaded_at)
        late = f"{body.time + SCHEMES[name].loaded_at:.0f} s"
        errors.add("14", SCHEMES[name].label, f"pressure over the head at {late}",
                   body.fields["pore_pressure"] / SPECIMEN.head, pressure / SPECIMEN.head)  # fmt: skip
        # A velocity is found as if its face were sealed: two rows below the surface show too little.
        for where, rows in [("", slice(None)), (", two rows below the surface left out", body.points[:, 1] < 48.0)]:
            errors.add("14", SCHEMES[name].label, f"flux over the steady one at {late}{where}",
                       -body.fields["darcy_velocity"][rows, 1] / SPECIMEN.steady_flux, flux[rows] / SPECIMEN.steady_flux)  # fmt: skip
        for axis, what in zip(pair, ["pressure", "flux"]):
            axis.set_title(f"{SCHEMES[name].label}, {late}", fontsize=9)
            axis.grid(False)
            if what == "pressure":
                value, limits = body.fields["pore_pressure"] / 1e3, (0.0, 100.0)
                axis.scatter(*water.points[:, :2].T, c=water.fields["fluid_pressure"] / 1e3, s=9, vmin=0.0, vmax=100.0)
            else:
                value, limits = -1e5 * body.fields["darcy_velocity"][:, 1], (1.0, 3.0)
                axis.scatter(*water.points[:, :2].T, c="#c8d0d6", s=9)
            image = axis.scatter(*body.points[:, :2].T, c=value, s=9, marker="s", vmin=limits[0], vmax=limits[1], linewidths=0)
            axis.set_aspect("equal")
            figure.colorbar(image, ax=axis, shrink=0.8)
    axes[0].set_ylabel("height [m]")
    save(figure, images, "fig14")


def fig15(runs: Runs, images: Path, errors: Errors) -> None:
    """Volume of water that flowed into the specimen, and the pressure of the water above it."""
    figure, axes = panels(3, "Fig 15: constant head test, time from the middle of the ramp of the load")
    fine = np.linspace(-20.0, 1980.0, 500)
    for axis, end in zip(axes, [200.0, 1980.0]):
        axis.plot(fine, SPECIMEN.volume(fine + 20.0), "k-", lw=1.2, label="exact")
        axis.plot(fine, SPECIMEN.steady_flux * np.maximum(fine, 0.0), "k:", lw=1.0, label="Eq 42: steady from the start")
        axis.set_xlim(-20.0, end)
        axis.set_ylim(0.0, SPECIMEN.volume(np.array([end + 20.0]))[0] * 1.3)
        axis.set_ylabel("volume an area [m]")
    for k, name in enumerate(["head_exchange", "head_force", "head"]):
        label = SCHEMES[name].label
        when, volume = runs.reference(name, "volume passed")
        for axis in axes[:2]:
            axis.plot(when, volume, color=f"C{k}", lw=1.4, label=label)
        for begin in (100.0, 480.0, 1960.0):
            near = np.abs(when - begin) <= 2.0
            exact = SPECIMEN.volume(when[near] + 20.0)
            errors.add("15", label, f"volume over exact, {begin:g} s", volume[near] / exact, np.ones(near.sum()))
        when, pressure = runs.reference(name, "water pressure")
        axes[2].plot(when, pressure / 1e3, color=f"C{k}", lw=1.0, label=label)
        steady = when > 30.0
        errors.add("15", label, "water pressure over the head", pressure[steady] / SPECIMEN.head, np.ones(steady.sum()))
    axes[2].axhline(98.1, color="k", lw=0.8)
    axes[2].set_ylim(60.0, 130.0)
    axes[2].set_ylabel("water pressure [kPa]")
    for axis in axes:
        axis.set_xlabel("time [s]")
        axis.legend(fontsize=8, frameon=False)
    save(figure, images, "fig15")


FIGURES = {f.__name__: f for f in (fig05, fig06, fig07, fig09, fig10, fig11, fig12, fig13, fig14, fig15)}
FIGURES |= fracture_figures.FIGURES


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("perifrac", type=Path)
    parser.add_argument("--runs", type=Path, default=Path("runs/paper"))
    parser.add_argument("--images", type=Path, default=HERE / "images")
    parser.add_argument("--only", nargs="*", choices=FIGURES, default=list(FIGURES))
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    chosen = parser.parse_args()
    chosen.images.mkdir(parents=True, exist_ok=True)
    runs, errors = Runs(chosen.perifrac, chosen.runs), Errors()
    if set(chosen.only) == set(FIGURES):
        with ThreadPoolExecutor(chosen.jobs) as pool:
            list(pool.map(runs.of, SCHEMES))
    for name in chosen.only:
        FIGURES[name](runs, chosen.images, errors)
    errors.write(HERE / "errors.csv")


if __name__ == "__main__":
    main()
