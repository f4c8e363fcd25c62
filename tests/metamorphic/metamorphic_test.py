#!/usr/bin/python3
"""What a scene is told in other words must give the same: elsewhere, mirrored, turned, in other
units, under twice the load, on more threads, and in stages by restart.

Usage: metamorphic_test.py PERIFRAC [--only WORD] [--keep DIR]
"""
import argparse
import csv
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy

from scenes import GROWING, LINEAR, SCENES
from transforms import Doubled, Keys, Mirrored, Scaled, Transform, Translated, Turned

LEFT_OUT = re.compile(r"_error$")  # what is left after all cancelled
BUDGET = re.compile(r"energy|elastic|external|kinetic|damped|pore_fluid|fracture|radiated|fluid_mass|friction")


class Runs:
    """A run's history, and where its facets lie in the end."""

    def __init__(self, folder):
        with open(folder / "history.csv", encoding="utf-8") as file:
            header, *rows = list(csv.reader(file))
        self.text = (folder / "history.csv").read_text(encoding="utf-8")
        values = numpy.array([[float(cell or "nan") for cell in row] for row in rows])
        self.columns, self.units = {}, {}
        for name, column in zip(header, values.T):
            name, _, unit = name.partition(" [")
            self.columns[name] = column
            self.units[name] = unit.rstrip("]") if unit != "1]" else ""
        self.facets = numpy.zeros((0, 2))
        frames = sorted((folder / "frames").glob("crack_*.hdf"))
        if frames:
            with h5py.File(frames[-1]) as file:
                self.facets = file["VTKHDF/Points"][()][:, :2]


class Laboratory:
    def __init__(self, perifrac, folder):
        self.perifrac, self.folder = perifrac, Path(folder)
        listed = subprocess.run([perifrac, "list", "--json"], capture_output=True, text=True, check=True)
        self.keys = Keys(json.loads(listed.stdout))

    def run(self, scene, name, *options, threads=1):
        file = self.folder / f"{name}.yaml"
        file.write_text(json.dumps(scene), encoding="utf-8")  # JSON is YAML
        folder = self.folder / name
        done = subprocess.run([self.perifrac, "run", str(file), "--no-report", "--output", str(folder),
                               "--threads", str(threads), *options], capture_output=True, text=True, timeout=100)
        if done.returncode != 0:
            raise RuntimeError(f"{name}: exit {done.returncode}: {done.stderr.strip()[-600:]}")
        return Runs(folder)

    def in_stages(self, scene, name):
        scene = {**scene, "output": {**scene["output"], "checkpoint_interval": 0.0}}
        self.run(scene, name, "--until", str(scene["output"]["times"][0]))
        last = sorted((self.folder / name).glob("checkpoint_*.h5"))[-1]
        return self.run(scene, name, "--restart", str(last))


def sizes(run):
    """Of each column, the largest there is of its quantity: what is 0 by symmetry has one too."""
    def quantity(name):
        kind = re.sub(r"(_[xy]+)?( at .*)?$", "", name)
        return run.units[name] if BUDGET.match(kind) else kind

    largest = {}
    for name, column in run.columns.items():
        most = numpy.abs(column[numpy.isfinite(column)]).max(initial=0.0)
        largest[quantity(name)] = max(largest.get(quantity(name), 0.0), most)
    return {name: largest[quantity(name)] or 1.0 for name in run.columns}


def differences(base, other, transform, growing):
    """(what, how far) of all that differs by more than it may."""
    tolerance = max(transform.tolerance, 1e-6 if growing else 0.0)
    rows = len(base.columns["time"])
    if rows != len(other.columns["time"]):
        return [(f"rows, {rows} and {len(other.columns['time'])}", numpy.inf)]
    size = sizes(base)
    found = []
    for name, column in base.columns.items():
        image, sign = transform.name_of(name)
        if LEFT_OUT.search(name) or not transform.tells_of(name):
            continue
        expected = sign * transform.factor(base.units[name]) * column
        there = other.columns.get(image)
        if there is None or (numpy.isnan(expected) != numpy.isnan(there)).any():
            found.append((f"{name}: no column {image}, or other empty cells", numpy.inf))
            continue
        off = numpy.nan_to_num(numpy.abs(there - expected)) / (size[name] * transform.factor(base.units[name]))
        if off.max() > tolerance:
            found.append((f"{name}, row {int(off.argmax())} of {rows},", off.max()))
    return found + path_differences(base, other, transform)


def path_differences(base, other, transform):
    if len(base.facets) != len(other.facets):
        return [("facets", abs(len(base.facets) - len(other.facets)))]
    if len(base.facets) == 0:
        return []
    expected = numpy.array([transform.place(list(x)) for x in base.facets])
    size = numpy.ptp(expected, axis=0).max() or 1.0
    apart = numpy.sqrt(((expected[:, None, :] - other.facets[None, :, :]) ** 2).sum(-1)).min(axis=1).max()
    rounding = 1e-15 * numpy.abs(expected).max()
    return [("path", apart / size)] if apart > 1e-6 * size + rounding else []


def transforms(name, scene):
    size = scene["body"]["size"] if "body" in scene else scene["fluid"]["container"]["to"]
    yield Mirrored(size[0])
    yield Turned(size[1])
    yield Translated(1e3 * size[0], 1e-9)
    yield Translated(1e6 * size[0], 1e-6)
    yield Scaled(length=2.0**10)
    yield Scaled(time=2.0**-6)
    yield Scaled(mass=2.0**9)
    yield Scaled(mass=2.0**-7, length=2.0**-5, time=2.0**4)
    if name in LINEAR:
        yield Doubled()


def compare(laboratory, name):
    scene = SCENES[name]()
    base = laboratory.run(scene, name)
    for transform in transforms(name, scene):
        try:
            other = laboratory.run(transform.scene(scene, laboratory.keys), f"{name}, {transform.name}")
            yield transform.name, differences(base, other, transform, name in GROWING)
        except RuntimeError as error:
            yield transform.name, [(str(error), numpy.inf)]
    for word, other in (("two threads", laboratory.run(scene, f"{name}, threads", threads=2)),
                        ("in stages", laboratory.in_stages(scene, f"{name}, stages"))):
        yield word, [] if other.text == base.text else \
            [(word + ": other bits", numpy.inf), *differences(base, other, Transform(), False)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--only", default="")
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    folder = arguments.keep or tempfile.mkdtemp(prefix="metamorphic_")
    Path(folder).mkdir(parents=True, exist_ok=True)
    failed = count = 0
    try:
        laboratory = Laboratory(arguments.perifrac, folder)
        for name in SCENES:
            if arguments.only not in name:
                continue
            for word, found in compare(laboratory, name):
                count += 1
                failed += bool(found)
                for what, far in sorted(found, key=lambda one: -one[1])[:5]:
                    print(f"{name}, {word}: {what} differs by {far:.2e}", flush=True)
    finally:
        if not arguments.keep:
            shutil.rmtree(folder, ignore_errors=True)
    print(f"{count} comparisons, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
