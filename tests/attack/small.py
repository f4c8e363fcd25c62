"""Shipped scenes, small: a few hundred to 5000 points, and done in about a second.

A body is made smaller where its spacing has something to resolve (a crack's first length, a beam's
height), and coarser where it has not. Times end while what was small is still about the same.
"""
import itertools
import math
import os

import scene_values

CONFIGS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "configs")


def wing(height, spacing, length, end):
    """A crack that begins at the middle of the left side of a body half as wide as high."""
    return {"body.size": [0.5 * height, height], "body.spacing": spacing,
            "cracks[0].path": [0.0, 0.5 * height, length, 0.5 * height],
            "crack_fluid.inlets[0].at": [0.0, 0.5 * height], "time.end": end}


SMALL = {
    "aquifer": {},
    "borehole": {"body.size": [1.6, 1.6], "body.spacing": 0.025, "time.end": 11.0},
    "cantilever_dynamic": {"time.end": 0.3},
    "constant_head": {"time.end": 20.0},
    "constant_head_warm": {"time.end": 10.0},
    "cryer": {"body.spacing": 2.0},
    "dam_break": {},
    "draining_blob": {"time.end": 4.0},
    "griffith": {"body.spacing": 0.0025},
    "hf_barriers": wing(0.24, 0.0025, 0.02, 0.02),
    "hf_leakoff": {"body.spacing": 0.0025, "time.end": 0.06},
    "hf_leakoff_stiff_water": {"body.spacing": 0.0025, "time.end": 0.06},
    "hf_leakoff_pores": {"body.spacing": 0.0025, "time.end": 0.02},
    "hf_natural_fracture": {"body.spacing": 0.0025, "time.end": 0.05},
    "hf_storage": {"body.spacing": 0.0025, "time.end": 0.05},
    "hf_storage_points": {"body.size": [0.048, 0.06], "body.cutouts.notch": {"from": [0.022, 0.05], "to": [0.026, 0.06]},
                          "cracks[0].path": [0.024, 0.05, 0.024, 0.046], "solid.pins[0].at": [0.023, 0.0],
                          "solid.pins[1].at": [0.025, 0.0], "fluid.container.from": [0.022, 0.05],
                          "fluid.container.to": [0.026, 0.06], "fluid.blocks[0].from": [0.022, 0.05],
                          "fluid.blocks[0].to": [0.026, 0.06], "fluid.inlets[0].from": [0.022, 0.058],
                          "fluid.inlets[0].to": [0.026, 0.06], "time.end": 0.008},
    "hf_storage_pores": {"time.end": 0.02},
    # The notch goes through the layer, which is four spacings thick.
    "kalthoff": {"body.spacing": 0.0025, "body.regions.struck.to": [0.0025, 0.025], "cracks[0].path": [-0.01, 0.025, 0.05, 0.025]},
    "kgd_leakoff": wing(0.2, 0.0025, 0.01, 0.02),
    "kgd_mixed": wing(0.4, 0.005, 0.02, 0.04),
    "kgd_oblique": {"body.size": [0.3, 0.3],
                    "cracks[0].path": [0.1321115, 0.1410557, 0.1678885, 0.1589443],
                    "crack_fluid.inlets[0].at": [0.15, 0.15], "time.end": 0.03},
    "kgd_toughness": wing(0.4, 0.005, 0.02, 0.02),
    "kgd_viscosity": wing(0.4, 0.005, 0.02, 0.12),
    "mandel_dynamic": {"time.end": 10.0},
    "notch_points": {"time.end": 0.004},
    "notch_slit": {"time.end": 0.004},
    "radial": {"body.size": [0.012, 0.012, 0.016], "cracks[0].centre": [0.0, 0.0, 0.008],
               "crack_fluid.inlets[0].at": [0.0, 0.0, 0.008], "time.end": 0.01},
    "shut_in": {**wing(0.2, 0.0025, 0.02, 0.08)},
    "sliding_crack": {"body.spacing": 0.004},
    "two_fractures": {"time.end": 60.0},
    "well": {"time.end": 60.0},
    "wu_2008": {"body.from": [0.0, -0.1, -0.15], "body.size": [0.125, 0.2, 0.25], "body.spacing": 0.0125,
                "cracks[0].centre": [0.0, 0.0, 0.0], "cracks[0].radius": 0.03125, "time.end": 45.0},
}


def shipped():
    """By name, in SI, without references, which belong to one set of parameters."""
    scenes = {}
    for name in sorted(os.listdir(CONFIGS)):
        if not name.endswith(".yaml"):
            continue
        scene = scene_values.read(os.path.join(CONFIGS, name))
        scene.pop("reference", None)
        for path, value in SMALL.get(name[:-5], {}).items():
            scene_values.put(scene, path, value)
        for crack in scene.get("cracks", []):
            if "file" in crack:
                crack["file"] = os.path.join(os.path.abspath(CONFIGS), crack["file"])
        if scene.get("body", {}).get("shape") == "points":
            scene["body"]["file"] = os.path.join(os.path.abspath(CONFIGS), scene["body"]["file"])
        scene["output"] = {}
        scenes[name[:-5]] = scene
    return scenes


def places(scene):
    """Where answers are read, and where only how large they get."""
    body, blocks = scene.get("body"), scene.get("fluid", {}).get("blocks")
    if body and "size" in body:
        low = body.get("from", [0.0] * len(body["size"]))
        high = [a + size for a, size in zip(low, body["size"])]
    elif blocks and not body:
        low, high = blocks[0]["from"], blocks[0]["to"]
    else:
        return []
    read = {"p0": (0.31, 0.37, 0.43), "p1": (0.72, 0.58, 0.66)}
    parts = itertools.product((0.02, 0.5, 0.98), repeat=len(low))
    read.update({f"size{n}": part for n, part in enumerate(parts)})
    probes = [{"name": name, "at": [a + part * (b - a) for part, a, b in zip(at, low, high)]} for name, at in read.items()]
    holes = [one for one in (body or {}).get("cutouts", {}).values() if "radius" in one]
    return [probe for probe in probes if not any(math.dist(probe["at"], one["centre"]) < one["radius"] for one in holes)]
