"""Awkward bodies: jitter, necks, bridges, islands, crossing cracks, jumps of the spacing, corners."""
import os
import tempfile

import numpy

from case import Case, Figure, rise
from runs import CONFIGS, HERE
from steps import drained
from stiffness import Rock, diffusion, flow_integrators, measure_column, measure_diffusion, measure_reference

GROUP = "Geometry"
SPACING, WIDTH, LENGTH = 1.0, 12.0, 16.0  # m, of cracked.yaml: points lie at half metres
WRITTEN = tempfile.TemporaryDirectory(prefix="stability_scenes_")


def slits(name, paths, scene="cracked.yaml"):
    """The scene with these cracks, as a file."""
    with open(os.path.join(HERE, scene), encoding="utf-8") as file:
        text = file.read()
    lines = [f"  - {{name: c{n}, path: [{', '.join(f'{v} m' for v in path)}]}}"
             for n, path in enumerate(paths)]
    file_name = os.path.join(WRITTEN.name, f"{name.replace(' ', '_').replace(',', '')}_{scene}")
    with open(file_name, "w", encoding="utf-8") as file:
        file.write(text + ("\ncracks:\n" + "\n".join(lines) + "\n" if lines else ""))
    return file_name


def box(x, y, half=0.5):
    """Four cracks about the points whose centre is (x, y)."""
    a, b, c, d = x - half, x + half, y - half, y + half
    return [[a, c, b, c], [b, c, b, d], [b, d, a, d], [a, d, a, c]]


# Cracks lie half-way between points. The body is pulled along y and drains at its bottom and top.
SHAPES = {
    "free corners": [],
    "thin neck of 3 points": [[0, 8, 5, 8], [8, 8, 12, 8]],
    "thin neck of 2 points": [[0, 8, 5, 8], [7, 8, 12, 8]],
    "one-point bridge": [[0, 8, 5, 8], [6, 8, 12, 8]],
    "crossing cracks": [[2, 8, 10, 8], [6, 4, 6, 12]],
    "oblique crossing cracks": [[2.2, 5.1, 9.7, 10.8], [2.3, 11.2, 9.6, 4.9]],
    "crack that reaches a boundary": [[0, 8, 6, 8]],
    "re-entrant notch": [[0, 8, 4, 8], [4, 8, 4, 13]],
    "families with two bonds": [[3, 0, 3, 16], [4, 0, 4, 6], [4, 7, 4, 16]],
}
PIECES = {
    "isolated point": box(5.5, 8.5),
    "island of four points": box(6.0, 9.0, 1.0),
    "crack that splits the body": [[0, 8, 12, 8]],
}


FINE = {"body.spacing": 0.5 * SPACING}


def measure_flow(run, fine, start=1e6, apart=0.05):
    """It drains and nothing feeds it; as much has left as at half the spacing."""
    overshoot = max(0.0, *(max(frame["pore_pressure"].max() - start, -frame["pore_pressure"].min())
                           for frame in run.frames)) / start
    left = [one.last("fluid_mass_gained") for one in (run, fine)]
    return ([Figure("overshoot", overshoot, 0.02),
             Figure("rise of energy", rise(run.history["energy_stored"]), 1e-12),
             Figure("mass error", run.mass_error, 1e-12)],
            [Figure("outflow against half the spacing", abs(left[0] / left[1] - 1.0), apart)])


def flow_cases():
    for name, paths in {**SHAPES, **PIECES}.items():
        scene = slits(name, paths, "cracked_flow.yaml")
        for operator in ("conservative", "bond"):
            for modules, words in flow_integrators().items():
                yield Case(GROUP, name, f"darcy {operator} {modules}", scene,
                           {"pore_flow.operator": operator, **words}, measure_flow, fine=FINE)
        yield Case(GROUP, name, "darcy nested explicit", scene,
                   {"pore_flow.operator": "nested", "pore_flow.integrator.type": "explicit"},
                   measure_flow, fine=FINE, known="nested operator")


INTACT = 0.5 * 10e9 / (1.0 - 0.25**2) * (1e-3 / LENGTH)**2 * WIDTH * LENGTH  # J/m, of cracked_solid.yaml
HELD = ("isolated point", "island of four points", "families with two bonds")
SLOW = {"solid.type": "dynamic", "solid.density": 2000, "solid.damping": 60, "time.end": 2,
        "solid.boundary.top.schedule.ramp": 1.0, "damage.type": "critical_stretch", "damage.stretch": 1.0}


def stored(run):
    return run.last("elastic_energy" if "elastic_energy" in run.names else "energy_stored")


def furthest(run):
    return Figure("largest displacement over that of the ends",
                  numpy.abs(run.frames[-1]["displacement"]).max() / 1e-3, 1.05)


def measure_pulled(run, fine, apart=0.2):
    """Nothing swings further than what pulls; as stiff as at half the spacing."""
    return ([Figure("open energy", run.summary["ledger"]["energy_error"], 0.02), furthest(run)],
            [Figure("energy against half the spacing", abs(stored(run) / stored(fine) - 1.0), apart)])


def measure_apart(run):
    """Two pieces that part without any force."""
    upper = run.frames[-1]["x"][:, 1] > 0.5 * LENGTH
    along = run.frames[-1]["displacement"][:, 1]
    moved = max(numpy.abs(along[upper] - 1e-3).max(), numpy.abs(along[~upper]).max()) / 1e-3
    return ([Figure("energy over that of the body in one piece", stored(run) / INTACT, 1e-3), furthest(run)],
            [Figure("displacement error", moved, 0.02)])


def pulled_cases():
    for name, paths in {**SHAPES, **PIECES}.items():
        scene = slits(name, paths, "cracked_solid.yaml")
        for modules, words in {"quasi_static": {}, "dynamic": SLOW}.items():
            if name == "crack that splits the body":
                yield Case(GROUP, name, modules, scene, words, measure_apart)
            else:
                refused = "its cracks leave a piece" if modules == "quasi_static" and name in HELD else ""
                yield Case(GROUP, name, modules, scene, words, measure_pulled, fine={**words, **FINE},
                           refused=refused)


def graded_cloud():
    """Points a metre apart in the left half of 20 m x 10 m, half a metre in the right one."""
    rows = [(x + 0.5, y + 0.5) for x in range(10) for y in range(10)]
    rows += [(10.25 + 0.5 * x, 0.25 + 0.5 * y) for x in range(20) for y in range(20)]
    with open(os.path.join(WRITTEN.name, "graded.csv"), "w", encoding="utf-8") as file:
        file.write("x,y\n" + "".join(f"{x},{y}\n" for x, y in rows))


def on_cloud(scene, size):
    """The scene with the graded points for its body."""
    with open(scene, encoding="utf-8") as file:
        text = file.read()
    head, rest = text.split("body:", 1)
    rest = rest.split("\n\n", 1)[1].split("reference:")[0]  # those are for boxes
    written = os.path.join(WRITTEN.name, "graded_" + os.path.basename(scene))
    with open(written, "w", encoding="utf-8") as file:
        file.write(f"{head}body: {{shape: points, file: graded.csv, size: {size}, spacing: 1 m, "
                   f"volumes: voronoi}}\n\n{rest}")
    return written


def measure_graded_plate(run):
    """Plane strain under uniform tractions, as configs/drained_plate.yaml has them."""
    young, ratio, along, across = 10e9, 0.25, 1e6, -2e6
    frame = run.frames[-1]
    strains = [((1 - ratio**2) * one - ratio * (1 + ratio) * other) / young
               for one, other in ((along, across), (across, along))]
    errors = [numpy.abs(frame["displacement"][:, a] - strains[a] * frame["x"][:, a]).max() /
              abs(strains[a] * frame["x"][:, a].max()) for a in (0, 1)]
    return ([Figure("open energy", run.summary["ledger"]["energy_error"], 0.02)],
            [Figure("displacement error", max(errors), 0.02)])


def measure_graded_flow(run):
    pressures = [frame["pore_pressure"] / 1e6 for frame in run.frames]
    times = [0.5 * frame["time"] / run.frames[-1]["time"] for frame in run.frames]
    errors = [numpy.abs(p - drained(frame["x"][:, 0] / 20.0, t)).max()
              for p, frame, t in zip(pressures, run.frames, times) if t > 0.0]
    overshoot = max(0.0, *(max(p.max() - 1.0, -p.min()) for p in pressures))
    return ([Figure("overshoot", overshoot, 0.02), Figure("mass error", run.mass_error, 1e-12),
             Figure("rise of energy", rise(run.history["energy_stored"]), 1e-12)],
            [Figure("pressure error", max(errors), 0.01)])


def graded_cases():
    graded_cloud()
    name, size = "spacing that jumps by two", "[20 m, 10 m]"
    yield Case(GROUP, name, "quasi_static", on_cloud(os.path.join(CONFIGS, "drained_plate.yaml"), size), {},
               measure_graded_plate)
    slab = on_cloud(os.path.join(HERE, "diffusion.yaml"), size)
    for modules, words in flow_integrators().items():
        yield Case(GROUP, name, f"darcy conservative {modules}", slab, {**diffusion(), **words},
                   measure_graded_flow)


def measure_turning(run):
    """A piece that turns keeps its energy, and its shape: no two points of it move apart."""
    frame = run.frames[-1]
    piece = frame["x"][:, 1] > 0.5 * LENGTH
    start = frame["x"][piece, :2]
    now = start + frame["displacement"][piece, :2]
    a, b = start[:, 0].argmin(), start[:, 0].argmax()
    before, after = (numpy.linalg.norm(x[a] - x[b]) for x in (start, now))
    return ([Figure("open energy", run.summary["ledger"]["energy_error"], 0.02)],
            [Figure("lengthening of the piece", abs(after / before - 1.0), 0.01),
             Figure("angle error", abs(angle(start, now) / angle_of_a_rigid_piece(start, frame["time"]) - 1.0),
                    0.01)])


def angle(start, now):
    """By which the points turned about their centre, clockwise, up to half a turn."""
    a, b = (points - points.mean(axis=0) for points in (start, now))
    return numpy.arctan2((a[:, 1] * b[:, 0] - a[:, 0] * b[:, 1]).sum(), (a * b).sum())


def angle_of_a_rigid_piece(points, time):
    """After the push of pushed.yaml: 2 MPa on its top for 10 ms, then falling to 0 within 1 ms."""
    arms = points - points.mean(axis=0)
    moment = 2e6 * WIDTH * 0.25 * LENGTH
    inertia = 2000.0 * SPACING**2 * (arms**2).sum()
    push, middle = 0.0105, 0.00526  # s
    return moment * push / inertia * (time - middle)


def turning_cases():
    """An upper part that breaks off and is pushed aside at its top for a moment, so that it turns."""
    scene = slits("crack that splits the body", PIECES["crack that splits the body"], "pushed.yaml")
    for end, name in ((0.02, "small rotation"), (2.0, "large rotation"), (8.0, "rotation by 140 degrees")):
        for modules, words in {"dynamic": {}, "dynamic, corotational": {"solid.kinematics": "corotational"}}.items():
            limit = end > 1.0 and not words
            yield Case(GROUP, f"{name} of a piece that broke off", modules, scene,
                       {"time.end": end, "output.interval": end, **words}, measure_turning, ours=limit,
                       known="kinematics small: rotations are held to be small" if limit else "")


def jitter_cases():
    near = {"displacement_x_error": 0.02, "displacement_y_error": 0.02}
    rock = Rock()
    for seed in (1, 2, 3):
        moved = {"body.jitter": 0.3, "body.seed": seed}
        name = "jitter 30 %"
        yield Case(GROUP, name, f"quasi_static, seed {seed}", os.path.join(CONFIGS, "drained_plate.yaml"),
                   moved, measure_reference(near))
        for modules, words in flow_integrators().items():
            yield Case(GROUP, name, f"darcy conservative {modules}, seed {seed}",
                       os.path.join(HERE, "diffusion.yaml"), {**diffusion(), **moved, **words},
                       measure_diffusion)
            yield Case(GROUP, name, f"quasi_static, darcy {modules}, seed {seed}",
                       os.path.join(HERE, "column.yaml"), {**rock.column(), **moved, **words},
                       measure_column(rock, overshoot_limit=0.06))


def measure_grown(run):
    """The crack goes on to the far side, at once as soon as it goes: what is left of the energy then
    would be motion, which there is none of, and the run says that its balance is open."""
    length, stored = run.history["crack_length"], run.history["energy_stored"]
    toughness, seed, width = 50.0, 0.02, 0.1  # of configs/griffith.yaml: J/m^2, m
    return ([Figure("shrinking of the crack", float(max(0.0, -numpy.diff(length).min())), 0.0),
             Figure("energy left in two pieces", float(stored[-1] / stored.max()), 1e-9)],
            [Figure("length error", abs(length[-1] / width - 1.0), 1e-9),
             Figure("fracture energy error",
                    abs(run.last("fracture_energy") / (toughness * (width - seed)) - 1.0), 1e-9)])


def grown_cases():
    for spacing in (0.002, 0.004):
        yield Case(GROUP, "crack that grows to a boundary and splits the body",
                   f"quasi_static, energy_release, spacing {1e3 * spacing:g} mm",
                   os.path.join(CONFIGS, "griffith.yaml"), {"time.end": 2, "body.spacing": spacing, "damage.regions.edge.fracture_energy": 50},
                   measure_grown)


def cases():
    yield from flow_cases()
    yield from pulled_cases()
    yield from jitter_cases()
    yield from graded_cases()
    yield from grown_cases()
    yield from turning_cases()
