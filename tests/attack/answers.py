"""What a run answers, and how far two answers are apart."""
import csv
import math
import re

import numpy
import scene_values

FOR_SIZE = re.compile(r" at size\d+$")  # probes that only say how large a field gets
FIGURES = re.compile(r"(pore_pressure|displacement|fluid_pressure|fluid_velocity|effective_stress)\S* at |_plate_displacement$|crack_length$|"
                     r"inlet_\S*_(pressure|opening)$|mean_crack_pressure$|energy_stored$|energy_gained$|fluid_mass_gained$|"
                     r"fracture_energy$|leak_off_volume$")
PRESSURES = ("hydrostatic", "water_on_plate", "constant_head")  # references that say what fluid presses with
LITTLE = 0.1
NOTHING = 1e-12  # of the body's size, of the stiffest modulus, of all mass: as good as none of a quantity


class Answer:
    """The history of a run."""

    def __init__(self, folder):
        with open(folder / "history.csv", encoding="utf-8") as file:
            header, *rows = list(csv.reader(file))
        values = numpy.array([[float(cell or "nan") for cell in row] for row in rows if len(row) == len(header)])
        self.columns = {re.sub(r" \[[^]]*\]$", "", name): column for name, column in zip(header, values.T)}
        self.time = self.columns["time"]

    def last_spacing(self, spacing):
        """From when on its crack has grown by its last spacing [s]; the end where none grows."""
        length = self.columns.get("crack_length")
        if length is None or not spacing or length[-1] <= length[0]:
            return self.time[-1]
        return self.time[int(numpy.argmax(length > length[-1] - spacing))]

    def mean(self, name, begin):
        chosen = self.time >= begin * (1.0 - 1e-9)
        if chosen.sum() < 2:
            return self.columns[name][-1]
        time, values = self.time[chosen], self.columns[name][chosen]
        return float(numpy.trapz(values, time) / (time[-1] - time[0]))


def quantity(name):
    """All places and directions of a field are one, and all energies and works, whose differences some are."""
    if name != "energy_error" and re.search(r"energy|_work$", name):
        return "energy"
    return re.sub(r"(_[xyz]+)?( at .*)?$", "", name)


def least_sizes(answer, scene):
    """Below which a quantity is rounding."""
    moduli = [value for path, value in scene_values.leaves(scene) if "modulus" in str(path[-1]) or "lame" in str(path[-1])]
    size = [*scene.get("body", {}).get("size", []), scene.get("body", {}).get("radius", 0.0)]
    pressure = NOTHING * max(moduli, default=0.0)
    return {"displacement": NOTHING * max(size, default=0.0), "pore_pressure": pressure, "effective_stress": pressure,
            "fluid_pressure": pressure, "mean_crack_pressure": pressure,
            "fluid_mass_gained": NOTHING * largest(answer.columns.get("fluid_mass_stored", numpy.zeros(1)))}


def energy_of_height(answer, scene):
    """What free fluid's weight does over its height: what falls differs by part of that, not of the little that its
    energy is then beyond that at the start."""
    blocks = scene.get("fluid", {}).get("blocks", [])
    gravity = scene.get("gravity", [])
    work = max((abs(sum(g * (to - at) for g, to, at in zip(gravity, block["to"], block["from"]))) for block in blocks),
               default=0.0)
    return work * largest(answer.columns.get("fluid_mass_stored", numpy.zeros(1)))


def largest(column):
    return numpy.abs(column[numpy.isfinite(column)]).max(initial=0.0)


def sizes_of(one, other, scene):
    """Of each quantity the largest value that it had anywhere."""
    sizes = least_sizes(one, scene)
    for answer in (one, other):
        for name, column in answer.columns.items():
            sizes[quantity(name)] = max(sizes.get(quantity(name), 0.0), largest(column))
    if "energy" in sizes:
        # What the stress of the rock does by strains that are none.
        rounding = NOTHING * sizes["effective_stress"] * math.prod(scene.get("body", {}).get("size", [0.0]))
        sizes["energy"] = max(sizes["energy"], energy_of_height(one, scene), rounding)
    # Leak-off that has hardly begun is part of what cracks hold, and known as well as that.
    if "leak_off_volume" in sizes:
        sizes["leak_off_volume"] = max(sizes["leak_off_volume"], LITTLE * sizes.get("crack_volume", 0.0))
    # What moves is pressed upon by its own weight in motion; less is the noise of sound.
    moving = scene.get("fluid", {}).get("density", 1000.0) * sizes.get("fluid_velocity", 0.0)**2
    sizes["fluid_pressure"] = max(sizes["fluid_pressure"], moving)
    # At rest it is the other way round: what is slower than sound of the pressure there is, is sound.
    sizes["fluid_velocity"] = max(sizes.get("fluid_velocity", 0.0), speed_of_sound_of(scene, sizes["fluid_pressure"]))
    return sizes


def speed_of_sound_of(scene, pressure):
    """How fast a wave of that pressure moves the fluid: p / sqrt(K rho)."""
    fluid = scene.get("fluid", {})
    return pressure / (fluid["bulk_modulus"] * fluid.get("density", 1000.0))**0.5 if "bulk_modulus" in fluid else 0.0


def farthest(one, other, scene):
    """(how far, which figure) of the figure that two answers differ by most, over its quantity's size:
    the largest value that it had at any place; of the crack's growth where that is what there is."""
    spacing = scene.get("body", {}).get("spacing")
    begin = min(one.last_spacing(spacing), other.last_spacing(spacing))
    sizes = sizes_of(one, other, scene)
    worst = (0.0, "")
    listed = (scene.get("reference") or {}).get("type") in PRESSURES
    for name in one.columns:
        if name.startswith("fluid_pressure") and not listed:
            continue  # of moving points, at one place, it is as much sound as pressure
        if not FIGURES.search(name) or FOR_SIZE.search(name) or name not in other.columns:
            continue
        difference = abs(one.mean(name, begin) - other.mean(name, begin))
        size = sizes[quantity(name)]
        if name.endswith("crack_length"):  # it grows, and opens, by spacings: what is less than one says nothing
            difference = max(0.0, difference - spacing)
            size = sizes["crack_length"]
        if size > 0.0 and difference / size > worst[0]:
            worst = (difference / size, name)
    return worst
