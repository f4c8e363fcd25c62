#!/usr/bin/python3
"""What each effect costs: one body, effects added one by one, time per step and bytes per point.

usage: bench/effects/effects.py PERIFRAC [--rounds N] [--page docs/effects.md]
Every round runs every variant once, in turn, on one thread. Times are of the processor; a ratio is
the median over the rounds of ratios within a round, so that a machine that grows slower or faster
does not show."""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

import activity
import instructions

HERE = Path(__file__).resolve().parent
BODY = HERE / "body.yaml"

NOTCH = {"cracks": "[{name: notch, path: [100 mm, 75 mm, 200 mm, 75 mm]}]",
         "damage": "{type: energy_release, fracture_energy: 1e9 J/m^2}"}
STRETCH = {"damage": "{type: critical_stretch, stretch: 0.1}"}
WATER = "density: 1000 kg/m^3, viscosity: 1 cP, bulk_modulus: 22 MPa"
PORES = {"pore_flow": "{type: darcy, permeability: 1e-15 m^2, porosity: 0.2, fluid: {%s}, "
                      "integrator: {type: explicit}}" % WATER}
GRAVITY = {"gravity": "[0 m/s^2, -9.81 m/s^2]"}
FILM = {"fluid": "{type: semi_lagrangian, %s, container: {from: [0 mm, 150 mm], to: [300 mm, 300 mm], "
                 "faces: {left: periodic, right: periodic, bottom: open, top: open}}, "
                 "blocks: [{name: film, from: [0 mm, 150 mm], to: [300 mm, 160 mm]}]}" % WATER,
        "interface": "{exchange: none}"}
SEEPAGE = {"interface": "{exchange: bond_flux}"}
NETWORK = {"crack_fluid": "{type: network, %s, inlets: [{name: well, at: [150 mm, 75 mm], "
                          "rate: 1e-6 m^2/s}]}" % WATER}
# What seeps into the pores comes from one side.
LEAK_OFF = {"crack_fluid.leak_off": "pores", "interface": "{exchange: none}"}

QUASI_STATIC = {"solid.type": "quasi_static", "coupling.window.type": "schedule", "time.end": "1 ms",
                "output.interval": "1 ms", "output.history_interval": "1 ms"}

# Effects in the order in which they are added; each keeps those before it.
CHAINS = {
    "dynamic": [("solid", {}), ("+ damage", NOTCH), ("+ pore flow", PORES), ("+ gravity", GRAVITY),
                ("+ fluid", FILM), ("+ seepage through the interface", SEEPAGE), ("+ crack network", NETWORK),
                ("+ leak-off into pores, no seepage", LEAK_OFF)],
    "dynamic, bonds that break by stretch": [("solid", {}), ("+ damage", STRETCH), ("+ pore flow", PORES)],
    "quasi_static": [("solid", QUASI_STATIC), ("+ damage", NOTCH), ("+ pore flow", PORES),
                     ("+ gravity", GRAVITY), ("+ crack network", NETWORK),
                     ("+ leak-off into pores", {"crack_fluid.leak_off": "pores"})],
}


def settings(keys):
    return [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]


def run(perifrac, scene, keys, folder, *options):
    """summary.json of a run with --profile."""
    command = [perifrac, "run", str(scene), "--no-report", "--threads", "1", "--profile", "--output",
               str(folder), *settings(keys), *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr + done.stdout)
    return json.loads((Path(folder) / "summary.json").read_text())


def check(perifrac, scene, keys):
    done = subprocess.run([perifrac, "check", str(scene), "--json", "--trial", "0", *settings(keys)],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)


# Of a run, all that is not done in every window.
ONCE = ("scene", "set-up", "output", "restart points", "body")


def per_step(summary):
    """Processor time [s] of a window, whatever is written apart."""
    parts = summary["profile"]["parts"]
    return sum(part["cpu_seconds"] for part in parts if part["name"] not in ONCE) / summary["counts"]["windows"]


def part_seconds(summary, name):
    """Of a part of that name anywhere but in the set-up, per window."""
    def find(parts):
        return sum(part["cpu_seconds"] if part["name"] == name else find(part.get("parts", [])) for part in parts)
    return find([part for part in summary["profile"]["parts"] if part["name"] not in ONCE]) / summary["counts"]["windows"]


def measure_chain(perifrac, chain, rounds, folder):
    """Rows (effect, s a step, ratio to the one before, of it to the first, bytes a point ...)."""
    keys, variants = {}, []
    for effect, added in chain:
        keys = {**keys, **added}
        variants.append((effect, dict(keys)))
    times = [[] for _ in variants]
    heap = [0.0] * len(variants)
    for _ in range(rounds):
        for k, (_, of_variant) in enumerate(variants):
            summary = run(perifrac, BODY, of_variant, folder)
            times[k].append(per_step(summary))
            heap[k] = summary["profile"]["memory"]["parts"]
    rows = []
    for k, (effect, of_variant) in enumerate(variants):
        said = check(perifrac, BODY, of_variant)
        points = said["counts"]["points"]
        fields = sum(array["bytes"] for array in said["arrays"])
        rows.append({"effect": effect, "step": min(times[k]),
                     "ratio": statistics.median(t / s for t, s in zip(times[k], times[0])),
                     "arrays": len(said["arrays"]), "fields": fields / points,
                     "families": said["family_bytes"] / points, "heap": heap[k] / points})
    return rows


def chain_table(rows):
    lines = ["| effect | time of a step [ms] | over the solid alone | arrays | fields [B/point] | families "
             "[B/point] | all that is held [B/point] |", "|---|---|---|---|---|---|---|"]
    for row in rows:
        lines.append(f"| {row['effect']} | {1e3 * row['step']:.3g} | {row['ratio']:.2f} | {row['arrays']} | "
                     f"{row['fields']:.0f} | {row['families']:.0f} | {row['heap']:.0f} |")
    return "\n".join(lines)


HEAD = """# What an effect costs

A scene pays for what it calls for. `make effects` measures it and writes this page; one thread, {rounds} rounds, in each of which every variant ran once. Times are of the processor, the least of all rounds; ratios are medians of ratios within a round.

## Effects added one by one

One body of 7200 points in 2D ([body.yaml](../bench/effects/body.yaml)), pushed from the left; every row keeps the effects above it. A step is a window: of the `dynamic` solid one step of its own, of the `quasi_static` one solve. `fields` are the evolving ones that `perifrac check --arrays` lists, `families` what modules share of bonds, which is not all: a solid whose bonds may break, and pore flow beside it, have families of their own. `All that is held` is by how much the heap has grown when the run ends, with matrices, factors, workspace, and the copies of the fields that a restart point and a window to be repeated need. The notch has 40 facets and does not grow; the film of fluid has 480 points, which are not among the body's. Beside pores a `dynamic` solid finds the forces of its bonds point by point and twice a window, without them packet by packet and once: more than half of what pore flow adds is that.
"""

ABSENT = """## What is absent

`tests/robustness/absent_effects_test.py` holds, exactly, that modules, links, arrays and bytes of a scene are those of what it names, and that a solid alone holds no number a point more than it did. `make instructions` counts, by valgrind:

- a step of a solid in the program, where all physics is registered, against the same step in a binary to which no other physics, no coupling and no program is linked: within 0.1 %, what the C library's heap does within its calls left out;
- that step against the forces of its bonds alone: {ratio} times as many, as recorded, and not 0.1 % more;
- functions of absent effects: none is called in a step;
- what [work follows activity](#work-follows-activity) says, in instructions.
"""


def page(chains, pairs, rounds):
    text = HEAD.format(rounds=rounds)
    for name, rows in chains.items():
        text += f"\n### `{name.split(',')[0]}`{name[len(name.split(',')[0]):]}\n\n{chain_table(rows)}\n"
    return text + "\n" + ABSENT.format(ratio=instructions.RECORDED_RATIO) + "\n" + activity.section(pairs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("perifrac")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--page", help="file to write")
    arguments = parser.parse_args()
    perifrac = str(Path(arguments.perifrac).resolve())
    with tempfile.TemporaryDirectory() as folder:
        chains = {}
        for name, chain in CHAINS.items():
            chains[name] = measure_chain(perifrac, chain, arguments.rounds, folder)
            print(f"\n{name}\n{chain_table(chains[name])}", flush=True)
        pairs = activity.measure(perifrac, arguments.rounds, folder, run, per_step, part_seconds)
        print("\n" + activity.table(pairs))
    if arguments.page:
        Path(arguments.page).write_text(page(chains, pairs, arguments.rounds))


if __name__ == "__main__":
    main()
