"""The paper's figures of its hydraulic fractures, 18 to 25: 18 to 24 by perifrac and by the paper's scheme, 25 by
perifrac alone. `points` has the paper's scheme without pores.
"""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from drawing import Errors, panels, plt, save
from runs import CONFIGS, SCHEMES, Frame, Runs

TIMES = [0.005, 0.025, 0.050, 0.100]  # [s] of figures 18 and 19
NOTCH = 0.014  # [m], the slit it begins with
FLOOR = 0.190  # [m], of the notch that points of fluid fill


def table(name: str) -> dict[str, np.ndarray]:
    """A reference beside its scene, by column."""
    with (CONFIGS / name).open(newline="", encoding="utf-8") as stream:
        header, *rows = list(csv.reader(line for line in stream if not line.startswith("#")))
    return {c.split(" [")[0]: v for c, v in zip(header, np.array(rows, dtype=float).T)}


def nearest_frame(runs: Runs, name: str, points: str, when: float) -> Frame:
    return min(runs.frames(name, points), key=lambda frame: abs(frame.time - when))


def cracks_at(runs: Runs, name: str, when: float) -> Frame:
    return nearest_frame(runs, name, "crack", when)


def maps(title: str, names: list[str]):
    """Four maps of the specimen side by side for each run, by its name."""
    figure, axes = plt.subplots(len(names), 4, figsize=(13.0, 4.8 * len(names)), layout="constrained", squeeze=False)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11, fontweight="bold")
    for name, row in zip(names, axes):
        row[0].set_ylabel(SCHEMES[name].label)
    return figure, dict(zip(names, axes))


def draw_field(axis, frame: Frame, value: np.ndarray, limits: tuple[float, float], colours: str):
    axis.set_aspect("equal")
    axis.grid(False)
    axis.set_xticks([])
    x, y = 1e3 * frame.points[:, 0], 1e3 * frame.points[:, 1]
    return axis.scatter(x, y, c=value, s=4e4 / x.size, marker="s", linewidths=0, vmin=limits[0], vmax=limits[1], cmap=colours)


def moments(runs: Runs, name: str, axes):
    """The axes of the moments that a run came to, each with its time [s]; the others stay empty."""
    last = runs.frames(name)[-1].time
    for axis, when in zip(axes, TIMES):
        axis.set_title(f"{1e3 * when:g} ms", fontsize=9)
        if last > when - 1e-3:
            yield axis, when
        else:
            axis.set_axis_off()


def free_fluid(runs: Runs, name: str) -> list[tuple[str, str]]:
    """Frames and field of what is free of the rock: points of fluid, fluid on the facets of cracks."""
    kinds = [("fluid", "fluid_pressure"), ("crack", "crack_pressure")]
    return [(points, field) for points, field in kinds if (runs.of(name) / f"frames/{points}.hdf.series").exists()]


def draw_pressure(runs: Runs, name: str, images: Path, figure_name: str, title: str) -> None:
    figure, rows = maps(title, [name, name + "_paper"])
    for run, axes in rows.items():
        free = free_fluid(runs, run)
        shown = [f.fields[field].max() for points, field in free for f in runs.frames(run, points)
                 if TIMES[0] <= f.time <= TIMES[-1]]  # fmt: skip
        limits, image = (0.0, 1e-3 * float(max(shown))), None
        for axis, when in moments(runs, run, axes):
            body = nearest_frame(runs, run, "body", when)
            image = draw_field(axis, body, 1e-3 * body.fields["pore_pressure"], limits, "viridis")
            for points, field in free:
                frame = nearest_frame(runs, run, points, when)
                axis.scatter(*(1e3 * frame.points[:, :2].T), c=1e-3 * frame.fields[field], s=7,
                             vmin=limits[0], vmax=limits[1], cmap="viridis", linewidths=0)  # fmt: skip
        figure.colorbar(image, ax=list(axes), shrink=0.8, label="kPa")
    figure.savefig(images / f"{figure_name}.png", dpi=110)
    print(images / f"{figure_name}.png")


def fig18(runs: Runs, images: Path, errors: Errors) -> None:
    """Pressure in the crack and the pores, storage-dominated."""
    draw_pressure(runs, "storage", images, "fig18", "Fig 18: fluid and pore pressure, storage-dominated")


def fig19(runs: Runs, images: Path, errors: Errors) -> None:
    """Damage, storage-dominated."""
    figure, rows = maps("Fig 19: damage, storage-dominated", ["storage", "storage_paper"])
    for run, axes in rows.items():
        image = None
        for axis, when in moments(runs, run, axes):
            body = nearest_frame(runs, run, "body", when)
            image = draw_field(axis, body, body.fields["damage"], (0.0, 0.6), "magma_r")
        figure.colorbar(image, ax=list(axes), shrink=0.8)
    figure.savefig(images / "fig19.png", dpi=110)
    print(images / "fig19.png")


def leak_off_velocity(history: dict[str, np.ndarray], sealed: float) -> np.ndarray:
    """Mean over both faces of what is wet [m/s], the sealed length [m] left out."""
    return history["leak_off_rate"] / (2.0 * np.maximum(history["wetted_length"] - sealed, 1e-3))


def draw_paper_velocity(axis, runs: Runs, name: str) -> None:
    """Of the paper's scheme: what the pores took since the pump began, over the wet faces below the notch's mouth."""
    history, fluids = runs.history(name), runs.frames(name, "fluid")
    wet = [0.2 - frame.points[:, 1].min() + 1e-3 for frame in fluids]  # half a spacing beyond the deepest point
    depth = np.interp(history["time"], [frame.time for frame in fluids], wet)
    rate = np.gradient(history["pore_fluid_mass"], history["time"]) / 1000.0
    pumped = history["time"] > 1e-3
    axis.plot(1e3 * history["time"][pumped], 1e3 * (rate / (2.0 * depth))[pumped], color="C3", lw=1.0,
              label=SCHEMES[name].label)  # fmt: skip


def depth_of_damage(runs: Runs, name: str, least: float) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and how deep below the top damage of at least so much goes [m]; the notch where there is none. Only
    in the middle: rock that breaks elsewhere is no crack."""
    times, depths = [], []
    for frame in runs.frames(name):
        broken = (frame.fields["damage"] > least) & (np.abs(frame.points[:, 0] - 0.076) < 0.02)
        times.append(frame.time)
        depths.append(0.2 - frame.points[broken, 1].min() if broken.any() else 0.2 - FLOOR)
    return np.array(times), np.array(depths)


def draw_paper_length(axis, runs: Runs, name: str) -> None:
    """As the paper measures it: from the notch's floor to the furthest point with a damage beyond 0.4."""
    times, depths = depth_of_damage(runs, name, 0.4)
    pumped = times >= 0.0
    axis.plot(1e3 * times[pumped], 1e3 * (depths[pumped] - (0.2 - FLOOR)), color="C3", lw=1.0, label=SCHEMES[name].label)


def carter_velocity(history: dict[str, np.ndarray], conductance: float, sealed: float) -> np.ndarray:
    """Of Carter's law for the mean pressure of the moment, as the paper has it: the mean over the crack, each
    part since it was wetted. `conductance`: sqrt(mobility * storage / pi) [m/(Pa sqrt(s))]."""
    when, length, pressure = history["time"], np.maximum(history["wetted_length"], sealed), history["mean_crack_pressure"]
    velocity = np.full(when.size, np.nan)
    for n in range(2, when.size):
        since = when[n] - 0.5 * (when[1 : n + 1] + when[:n])
        wetted = np.maximum(np.diff(length[: n + 1]), 0.0)
        if wetted.sum() > 0.0:
            velocity[n] = conductance * pressure[n] * (wetted / np.sqrt(since)).sum() / wetted.sum()
    return velocity


def compare_velocities(axis, runs: Runs, name: str, conductance: float, errors: Errors, figure: str, published: str, sealed: float = 0.0) -> None:
    history = runs.history(name)
    ms = 1e3 * history["time"]
    computed, carter = leak_off_velocity(history, sealed), carter_velocity(history, conductance, sealed)
    axis.semilogy(ms, 1e3 * computed, color="C0", lw=1.2, label="perifrac")
    axis.plot(ms, 1e3 * carter, "k--", lw=1.0, label="Carter at the mean pressure")
    axis.set_ylim(0.5e3 * np.nanmin(computed[ms > 10.0]), 20.0)
    draw_paper_velocity(axis, runs, published)
    axis.set_xlabel("time [ms]")
    axis.set_ylabel("mean leak-off velocity [mm/s]")
    axis.legend(fontsize=8, frameon=False)
    late = (ms >= 20.0) & np.isfinite(carter)
    errors.add(figure, "perifrac", "leak-off velocity over Carter's, from 20 ms", (computed / carter)[late], np.ones(late.sum()))


def compare_lengths(axis, runs: Runs, name: str, exact: dict[str, np.ndarray], errors: Errors, figure: str) -> None:
    history = runs.history(name)
    axis.plot(1e3 * history["time"], 1e3 * (history["crack_length"] - NOTCH), color="C1", lw=1.2, label="perifrac")
    axis.plot(1e3 * exact["time"], 1e3 * (exact["crack_length"] - NOTCH), "k-", lw=1.0, label="this specimen, marched by other means")
    axis.set_xlabel("time [ms]")
    axis.set_ylabel("growth [mm]")
    axis.legend(fontsize=8, frameon=False)
    late = exact["time"] >= 0.020
    computed = np.interp(exact["time"], history["time"], history["crack_length"])
    errors.add(figure, "perifrac", "length over the marched one, from 20 ms", (computed / exact["crack_length"])[late], np.ones(late.sum()))  # fmt: skip


STORAGE_CONDUCTANCE = np.sqrt(1.02e-12 * (0.1 / 2.2e9 + 1.0 / 840e6) / np.pi)


def fig20(runs: Runs, images: Path, errors: Errors) -> None:
    """Leak-off velocity and growth over time, storage-dominated."""
    figure, axes = panels(2, "Fig 20: leak-off velocity and growth, storage-dominated")
    compare_velocities(axes[0], runs, "storage_slit", STORAGE_CONDUCTANCE, errors, "20", published="storage_paper")
    compare_lengths(axes[1], runs, "storage_slit", table("hf_storage_reference.csv"), errors, "20")
    axes[0].lines[0].set_label(SCHEMES["storage_slit"].label)
    axes[0].legend(fontsize=8, frameon=False)
    axes[1].lines[0].set_label(SCHEMES["storage_slit"].label)
    axes[1].lines[1].set_label("that slit, marched by other means")
    notch = runs.history("storage")
    axes[1].plot(1e3 * notch["time"], 1e3 * (notch["crack_length"] - notch["crack_length"][0]), color="C0", lw=1.2,
                 label="perifrac, a notch full of points, soft water")  # fmt: skip
    draw_paper_length(axes[1], runs, "storage_paper")
    axes[1].legend(fontsize=8, frameon=False)
    save(figure, images, "fig20")


def fig21(runs: Runs, images: Path, errors: Errors) -> None:
    """What is where of the fluid that was pumped in."""
    history = runs.history("storage")
    figure, axes = panels(2, "Fig 21: mass of fluid, storage-dominated")
    ms = 1e3 * history["time"]
    axes[0].plot(ms, history["injected_fluid_mass"], "k-", lw=1.0, label="pumped in")
    axes[0].plot(ms, history["free_fluid_mass"] - history["free_fluid_mass"][0], label="more than at first in the notch")
    axes[0].plot(ms, history["crack_fluid_stored_mass"], label="in the crack")
    axes[0].plot(ms, history["exchanged_mass_from_crack_fluid"], label="leaked from the crack")
    axes[0].plot(ms, history["exchanged_mass_from_fluid"], label="seeped from the notch")
    axes[0].set_ylabel("mass [kg/m]")
    axes[0].legend(fontsize=8, frameon=False)
    axes[1].semilogy(ms, np.maximum(history["fluid_mass_error"], 1e-17), "k-", lw=1.0, label="perifrac")
    published = runs.history("storage_paper")
    pumped_in = published["time"] > 0.0
    axes[1].semilogy(1e3 * published["time"][pumped_in], published["fluid_mass_error"][pumped_in], color="C3", lw=1.0,
                     label=SCHEMES["storage_paper"].label)  # fmt: skip
    axes[1].legend(fontsize=8, frameon=False)
    axes[1].set_ylabel("mass made or lost, over all that flowed")
    for axis in axes:
        axis.set_xlabel("time [ms]")
    errors.add("21", "perifrac", "mass made or lost over what flowed", history["fluid_mass_error"], np.zeros(ms.size))
    save(figure, images, "fig21")


def fig22(runs: Runs, images: Path, errors: Errors) -> None:
    """Pressure in the crack and the pores, leak-off dominated."""
    draw_pressure(runs, "leak_off", images, "fig22", "Fig 22: fluid and pore pressure, leak-off dominated")


LEAK_OFF_CONDUCTANCE = np.sqrt(1.02e-11 * (0.1 / 22e6 + 1.0 / 4.8e9) / np.pi)


def fig23(runs: Runs, images: Path, errors: Errors) -> None:
    """Leak-off velocity over time, leak-off dominated: into pores, and by Carter's law."""
    figure, axes = panels(1, "Fig 23: leak-off velocity, leak-off dominated")
    compare_velocities(axes[0], runs, "leak_off", LEAK_OFF_CONDUCTANCE, errors, "23", published="leak_off_paper", sealed=NOTCH)
    save(figure, images, "fig23")


def fig24(runs: Runs, images: Path, errors: Errors) -> None:
    """Growth, leak-off dominated, beside the solutions with leak-off and without."""
    figure, axes = panels(1, "Fig 24: growth, leak-off dominated")
    marched = table("hf_leakoff_reference.csv")
    compare_lengths(axes[0], runs, "carter", marched, errors, "24")
    axes[0].lines[0].set_label("perifrac, Carter's law")
    axes[0].lines[1].set_label("this specimen with Carter's law, marched by other means")
    for name, colour, label in (("leak_off", "C0", "perifrac, into pores"), ("no_leak_off", "0.6", "perifrac, nothing leaks"),
                                ("stiff_water", "C2", "perifrac, Carter's law, water of 2.2 GPa")):  # fmt: skip
        history = runs.history(name)
        axes[0].plot(1e3 * history["time"], 1e3 * (history["crack_length"] - NOTCH), color=colour, lw=1.2, label=label)
    draw_paper_length(axes[0], runs, "leak_off_paper")
    axes[0].legend(fontsize=8, frameon=False)
    save(figure, images, "fig24")


def major_stress(frame: Frame) -> tuple[np.ndarray, np.ndarray]:
    """The largest principal stress of every point [Pa] and its angle to x."""
    xx, xy, yx, yy = np.asarray(frame.fields["effective_stress"]).reshape(-1, 4).T
    shear = 0.5 * (xy + yx)
    return 0.5 * (xx + yy) + np.hypot(0.5 * (xx - yy), shear), 0.5 * np.arctan2(2.0 * shear, xx - yy)


def fig25(runs: Runs, images: Path, errors: Errors) -> None:
    """A crack that meets a natural one: pressure, damage, major principal stress and its direction."""
    moments = [0.005, 0.015, 0.030, 0.100]
    figure, axes = plt.subplots(len(moments), 3, figsize=(9.0, 3.6 * len(moments)), layout="constrained")
    figure.suptitle("Fig 25: a natural fracture", x=0.01, ha="left", fontsize=11, fontweight="bold")
    cracks = runs.frames("natural", "crack")
    highest = 1e-6 * max(float(f.fields["crack_pressure"].max()) for f in cracks if f.time >= moments[0])
    for row, when in zip(axes, moments):
        body, crack = runs.frame_at("natural", when), cracks_at(runs, "natural", when)
        x, y = 1e3 * body.points[:, 0], 1e3 * body.points[:, 1]
        draw_field(row[0], body, 1e-6 * body.fields["pore_pressure"], (0.0, highest), "viridis")
        pressure = row[0].scatter(*(1e3 * crack.points[:, :2].T), c=1e-6 * crack.fields["crack_pressure"], s=5,
                                  vmin=0.0, vmax=highest, cmap="viridis", linewidths=0)  # fmt: skip
        damage = draw_field(row[1], body, body.fields["damage"], (0.0, 0.6), "magma_r")
        stress, angle = major_stress(body)
        near = (np.abs(x - 70.0) < 22.0) & (np.abs(y - 165.0) < 30.0)
        arrows = row[2].quiver(x[near], y[near], np.cos(angle[near]), np.sin(angle[near]), 1e-6 * stress[near],
                               pivot="mid", headwidth=0, headlength=0, headaxislength=0, scale=45, width=0.004,
                               cmap="coolwarm", clim=(-3.0, 3.0))  # fmt: skip
        for axis in row:
            axis.set_aspect("equal")
            axis.set_xticks([])
            axis.grid(False)
        row[0].set_xlim(x.min(), x.max())
        row[0].set_ylim(y.min(), y.max())
        row[0].set_ylabel(f"{1e3 * when:g} ms")
    for column, (image, label) in enumerate([(pressure, "pressure [MPa]"), (damage, "damage"),
                                             (arrows, "major principal stress [MPa]")]):  # fmt: skip
        figure.colorbar(image, ax=axes[:, column], shrink=0.5, location="bottom", label=label)
    figure.savefig(images / "fig25.png", dpi=110)
    print(images / "fig25.png")


BROKEN = 0.35  # damage; beside a straight crack it is 0.4


def points(runs: Runs, images: Path, errors: Errors) -> None:
    """The storage-dominated case by the paper's own rules: pressure in the notch, growth, and what is left."""
    figure, axes = panels(3, "The paper's points of fluid, storage-dominated (2 mm)")
    network, exact = runs.history("network"), table("hf_storage_reference.csv")
    bodies, fluids = runs.frames("points", "body"), runs.frames("points", "fluid")
    ms = 1e3 * np.array([frame.time for frame in bodies])
    pressure = [f.fields["fluid_pressure"][f.points[:, 1] > FLOOR].mean() for f in fluids]
    depth = [0.2 - b.points[b.fields["damage"] > BROKEN, 1].min() for b in bodies]
    pumped = ms >= 0.0
    lines = [
        (axes[0], 1e-3 * np.array(pressure), 1e-3 * network["inlet_notch_pressure"], 1e-3 * exact["inlet_notch_pressure"]),
        (axes[1], 1e3 * (np.array(depth) - NOTCH), 1e3 * (network["crack_length"] - NOTCH), 1e3 * (exact["crack_length"] - NOTCH)),
    ]  # fmt: skip
    for axis, by_points, by_network, marched in lines:
        axis.plot(ms[pumped], by_points[pumped], color="C3", lw=1.2, label="the paper's points")
        axis.plot(1e3 * network["time"], by_network, color="C0", lw=1.2, label="network")
        axis.plot(1e3 * exact["time"], marched, "k-", lw=1.0, label="this specimen, marched by other means")
        axis.set_xlim(0.0, ms[-1])
        axis.set_xlabel("time since the pump began [ms]")
        axis.legend(fontsize=8, frameon=False)
    axes[0].set_ylabel("pressure in the notch [kPa]")
    axes[0].set_ylim(0.0, None)
    axes[1].set_ylabel("growth, deepest broken point [mm]")
    image = draw_field(axes[2], bodies[-1], bodies[-1].fields["damage"], (0.0, 1.0), "magma_r")
    axes[2].scatter(*(1e3 * fluids[-1].points[:, :2].T), s=4, color="C0")
    axes[2].set_title(f"damage and water at {ms[-1]:.0f} ms", fontsize=9)
    figure.colorbar(image, ax=axes[2], shrink=0.8)
    save(figure, images, "points")


FIGURES = {f.__name__: f for f in (fig18, fig19, fig20, fig21, fig22, fig23, fig24, fig25, points)}
