#!/usr/bin/python3
"""Runs all shipped scenes, some at other spacings too, and writes what they reach into docs/scenes.md.

Usage: collect_scenes.py PERIFRAC [--runs DIR] [--fresh] [SCENE ...]

The table between `<!-- reached -->` and `<!-- end -->` is written anew from the summaries of the runs; with
SCENEs, rows of others stay. A run that is finished in DIR is used again, unless --fresh. One thread; errors do
not depend on what else the machine does.
"""
import argparse
import json
import os
import re
import subprocess
from pathlib import Path

DOCS = Path(__file__).resolve().parent
PAGE = DOCS / "scenes.md"
HEADER = ("| scene | points at the end | errors against its reference, at all outputs / in the latter half of the run "
          "| fluid mass kept to | energy open by |\n|---|---|---|---|---|")
# What another spacing changes, the published material, inertia, and more viscosity.
OTHERS = {"cantilever_dynamic": ["body.spacing=0.05 m"], "cryer": ["body.spacing=2 m"],
          "drained_plate": ["solid.material.type=lps"],
          "hf_storage": ["solid.type=dynamic"], "hydrostatic": ["fluid.spacing=0.1 m", "fluid.spacing=0.025 m"],
          "kgd_mixed": ["body.spacing=2.5 mm"], "kgd_toughness": ["body.spacing=2.5 mm"],
          "kgd_viscosity": ["body.spacing=2.5 mm"], "layered_column": ["body.spacing=0.5 m"],
          "mandel_layers": ["body.spacing=0.5 m"],
          "poiseuille": ["fluid.spacing=1 mm", "fluid.spacing=0.25 mm"], "radial": ["crack_fluid.viscosity=4 cP"],
          "shut_in": ["body.spacing=5 mm", "body.spacing=2.5 mm"], "terzaghi_layers": ["body.spacing=0.5 m"],
          "three_point_bending": ["body.spacing=0.5 mm"], "water_on_plate": ["body.spacing=2 cm"]}  # fmt: skip


def summary_of(perifrac, scene, setting, folder, fresh):
    done = folder / "summary.json"
    if fresh or not done.exists() or json.loads(done.read_text(encoding="utf-8"))["outcome"] == "stopped":
        command = [perifrac, "run", scene, "--threads", "1", "--no-report", "--overwrite", "--output", folder]
        subprocess.run([*command, *(["--set", setting] if setting else [])], check=False, stdout=subprocess.DEVNULL)
    return json.loads(done.read_text(encoding="utf-8"))


def errors(reference):
    """Of every column of the table the largest, of all rows and of those of the latter half; then the figures."""
    rows = reference.get("table", [])
    half = 0.5 * rows[-1]["time"] if rows else 0.0
    for name in sorted({name for row in rows for name in row} - {"time", "dimensionless_time"}):
        values = [(row["time"], row[name]) for row in rows if row.get(name) is not None]
        late = [value for time, value in values if time > half]
        text = f"{name.removesuffix('_error').replace('_', ' ')} {max(value for _, value in values):.1e}"
        yield f"{text} / {max(late):.1e}" if late and len(values) > 1 else text
    for quantity in reference.get("quantities", []):
        name = quantity["name"].replace(" over the exact, mean of a step", " in the mean of a step")
        yield f"{name} {quantity['max_error']:.1e}"


def figure(value):
    return "" if value is None else f"{value:.1e}" if value else "0"


def row(name, summary):
    points = sum(summary["counts"].get(kind, 0) for kind in ("points", "fluid_points"))
    ledger = summary.get("ledger", {})
    kept, is_open = (figure(ledger.get(key)) for key in ("mass_error", "energy_error"))
    reached = "; ".join(errors(summary.get("reference", {})))
    if summary["outcome"] != "done":
        reached += f"ends with exit 1 at {1e3 * summary['time']['value']:.0f} ms"
    return f"| {name} | {points} | {reached} | {kept} | {is_open} |"


def rows_on(page):
    """Those of the table, by the name in their first column."""
    table = re.search(r"<!-- reached -->\n(.*?)<!-- end -->", page, flags=re.S)[1]
    return {line.split(" | ")[0].removeprefix("| "): line for line in table.splitlines()[2:]}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--runs", type=Path, default=Path("runs/scenes"))
    parser.add_argument("--fresh", action="store_true")
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_intermixed_args()
    rows = rows_on(PAGE.read_text(encoding="utf-8")) if arguments.scenes else {}
    for scene in sorted((DOCS.parent / "configs").glob("*.yaml")):
        if arguments.scenes and scene.stem not in arguments.scenes:
            continue
        for setting in ["", *OTHERS.get(scene.stem, [])]:
            name = f"{scene.stem}, `{setting}`" if setting else scene.stem
            folder = arguments.runs / re.sub(r"\W+", "_", name).strip("_")
            summary = summary_of(os.path.abspath(arguments.perifrac), scene, setting, folder, arguments.fresh)
            rows[name] = row(name, summary)
            print(rows[name], flush=True)
    text = "\n".join([HEADER, *(rows[name] for name in sorted(rows))])
    page = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(re.sub(r"(<!-- reached -->\n).*?(<!-- end -->)", lambda found: f"{found[1]}{text}\n{found[2]}",
                           page, flags=re.S), encoding="utf-8")


if __name__ == "__main__":
    main()
