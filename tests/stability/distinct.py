"""Which cases are one and the same run in other units.

A run says nothing new where it follows from another one by a change of the units of mass, length,
time and, in linear scenes, load: permeability times ten with a tenth of the time is one run.
"""
import json
import os
import subprocess
import sys

import numpy

sys.path[:0] = [os.path.join(os.path.dirname(os.path.abspath(__file__)), *words) for words in (("..",), ("..", "metamorphic"))]
import scene_values  # noqa: E402
import transforms  # noqa: E402

LEFT_OUT = ("title", "output", "reference", "ledger")
LOADS = ("traction", "force", "body_force", "pressure", "flux", "rate", "normal_displacement", "initial_pressure",
         "displacement", "normal_velocity")


def reduced(scene):
    """With what pore flow follows from in place of what that is made of, where it is the same everywhere."""
    flow = scene.get("pore_flow")
    if not flow or "regions" in flow or flow.get("fluid", {}).get("equation_of_state") == "tait":
        return scene
    fluid = flow["fluid"]
    porosity, grains, biot = flow["porosity"], flow.pop("grain_bulk_modulus", None), flow.get("biot_coefficient", 1.0)
    flow["storage"] = porosity / fluid["bulk_modulus"] + ((biot - porosity) / grains if grains else 0.0)
    if "permeability" in flow:
        flow["mobility"] = flow.pop("permeability") / fluid["viscosity"]
    if "solid" not in scene:
        flow.pop("biot_coefficient", None)
    if "gravity" not in scene and "fluid" not in scene and "crack_fluid" not in scene:
        fluid.pop("density", None)
        for name in ("bulk_modulus", "viscosity"):
            fluid.pop(name)
        flow.pop("porosity")
    return scene


def exponents(path, keys, scene, linear):
    """Of mass, length, time and load."""
    plain = {"storage": "1/Pa", "mobility": "m^2/(Pa s)"}.get(path[-1])
    whole = path[:-1] if isinstance(path[-1], int) else path
    unit = plain or keys.unit(tuple(whole), scene)
    if unit == "1/Pa":
        powers = [-one for one in transforms.dimension_of("Pa")]
    else:
        powers = list(transforms.dimension_of(unit)) if unit else [0.0, 0.0, 0.0]
    is_load = linear and any(part in LOADS for part in path if isinstance(part, str))
    return [*powers, float(is_load)]


def fingerprint(case, keys):
    """Equal for runs that differ in units alone."""
    scene = scene_values.read(case.scene)
    for path, value in case.settings.items():
        scene_values.put(scene, path, value)
    linear = not any(name in scene for name in ("damage", "cracks", "fluid"))
    scene = reduced(scene)
    words, rows, logs = [case.scene], [], []
    for path, value in sorted(scene_values.leaves(scene), key=lambda one: tuple(map(str, one[0]))):
        if path[0] in LEFT_OUT:
            continue
        name = ".".join(map(str, path))
        powers = exponents(path, keys, scene, linear)
        if isinstance(value, (str, bool)) or value is None or value == 0 or not any(powers):
            words.append(f"{name}={value}" if isinstance(value, (str, bool)) or value is None else f"{name}={value:.9g}")
            continue
        words.append(f"{name}{'+' if value > 0 else '-'}")
        rows.append(powers)
        logs.append(numpy.log(abs(value)))
    if rows:
        rows, logs = numpy.array(rows), numpy.array(logs)
        logs = logs - rows @ numpy.linalg.lstsq(rows, logs, rcond=None)[0]
    return tuple(words) + tuple(round(float(one), 5) + 0.0 for one in logs)


def count(cases, perifrac):
    """How many of them are distinct runs."""
    listed = subprocess.run([perifrac, "list", "--json"], capture_output=True, text=True, check=True)
    keys = transforms.Keys(json.loads(listed.stdout))
    return len({fingerprint(case, keys) for case in cases})
