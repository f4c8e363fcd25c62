#!/usr/bin/python3
"""Runs twelve shipped scenes and writes docs/gallery.md: of each a picture, its command and the time that it took.

Usage: collect_gallery.py PERIFRAC [--page PAGE] [--runs DIR] [--fresh] [SCENE ...]

Pictures go into images/gallery beside PAGE, one panel of the report's each. A run that is finished in DIR is used
again, unless --fresh. One thread; times are those of the processor, so that they depend little on what else it does.
With SCENEs only these are run and drawn, and no page is written.
"""
import argparse
import io
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
sys.path.insert(0, str(DOCS.parent / "app" / "report"))
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from picture import STYLE, panels  # noqa: E402
from PIL import Image  # noqa: E402
from run import read_run  # noqa: E402

INCHES, DOTS, COLOURS = (6.2, 4.2), 120, 224
LARGEST = 80_000  # bytes of a picture
# Name, what is coarser than shipped, which panel of the report tells most, and what it shows.
SCENES = [
    ("mandel", [], 0, "Pressure that rises before it falls: Mandel's problem, on its exact solution."),
    ("layered_column", [], 1, "A column that drains through a tight, soft cap."),
    ("cryer", ["body.spacing=2 m"], 0, "A ball in 3D that is squeezed as its outside drains, on the exact solution."),
    ("dam_break", [], 2, "Free fluid: a column of water collapses."),
    ("three_point_bending", [], 0, "A beam without a crack breaks where the tension is largest."),
    ("kalthoff", [], 2, "Inertia: a crack that an impact drives, at some 70 degrees to its notch."),
    ("kgd_viscosity", [], 0, "A hydraulic fracture against viscosity, on the solution for an infinite body."),
    ("radial", [], 3, "A round hydraulic fracture in 3D, a quarter of it: the opening in its plane."),
    ("hf_barriers", [], 0, "A hydraulic fracture that runs into layers under more stress."),
    ("hf_natural_fracture", [], 0, "A hydraulic fracture meets a natural one, stops and turns."),
    ("two_fractures", [], 0, "Field scale: two hydraulic fractures beside a natural one, with a soft layer in their way."),
    ("hf_complete", [], 0, "All at once: a pump, free fluid in a notch, pores, a growing crack and a natural fracture."),
]  # fmt: skip


def command_of(name, coarser):
    return ["perifrac", "run", "--example", name, *(word for key in coarser for word in ("--set", key))]


def run_of(perifrac, name, coarser, folder, fresh):
    done = folder / "summary.json"
    if fresh or not done.exists() or json.loads(done.read_text(encoding="utf-8"))["outcome"] == "stopped":
        command = [perifrac, *command_of(name, coarser)[1:], "--threads", "1", "--no-report", "--overwrite", "--output", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return read_run(folder)


def draw(run, panel, path):
    """Few colours suffice for a picture as small."""
    drawn = io.BytesIO()
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=INCHES, dpi=DOTS, layout="constrained")
        found = panels(run)
        found[min(panel, len(found) - 1)](figure.add_subplot())
        figure.savefig(drawn, format="png", bbox_inches="tight")
        plt.close(figure)
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.open(drawn).convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)
    if path.stat().st_size > LARGEST:
        sys.exit(f"{path}: {path.stat().st_size} bytes; expected at most {LARGEST}")


def duration(seconds):
    return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"


def entry(run, name, coarser, words):
    points = sum(run.counts.get(kind, 0) for kind in ("points", "fluid_points"))
    size = f"{points} points, {run.counts['windows']} windows, {duration(run.summary['cpu_time'])}"
    return (f"## {run.title}\n\n{words}\n\n![{run.title}: {words}](images/gallery/{name}.png)\n\n"
            f"    {shlex.join(command_of(name, coarser))}\n\n{size}. [The scene](../configs/{name}.yaml)\n")  # fmt: skip


HEAD = """# Gallery

Twelve scenes, what they look like, how to run them, and what they took of one processor. For whoever looks for a scene like their own.

Written by `make gallery`. Where a command sets a spacing, points are farther apart than in the scene as shipped, to save time. What scenes reach against their references is in [scenes.md](scenes.md), what they take as shipped in [forecast.md](forecast.md).
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--page", type=Path, default=DOCS / "gallery.md")
    parser.add_argument("--runs", type=Path, default=Path("runs/gallery"))
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_intermixed_args()
    entries = []
    for name, coarser, panel, words in SCENES:
        if arguments.scenes and name not in arguments.scenes:
            continue
        run = run_of(os.path.abspath(arguments.perifrac), name, coarser, arguments.runs / name, arguments.fresh)
        draw(run, panel, arguments.page.parent / "images" / "gallery" / f"{name}.png")
        entries.append(entry(run, name, coarser, words))
        print(f"{name}: {duration(run.summary['cpu_time'])}", flush=True)
    if not arguments.scenes:
        arguments.page.write_text("\n".join([HEAD, *entries]), encoding="utf-8")


if __name__ == "__main__":
    main()
