#!/usr/bin/python3
"""Speed and size: kernels beside LAMMPS and what the machine allows, growth with the points, threads, whole scenes.

usage: bench/benchmarks/benchmarks.py PERIFRAC PERIFRAC_BENCH [--only PART ...] [--page docs/benchmarks.md]
                                      [--largest POINTS]
Parts: kernels, explicit, equilibrium, scenes. What a part measured goes into a table, benchmarks/PART.csv beside the
page; the page and its pictures are made of the tables that are there. Kernels are medians of five repeats, whose order
is random; LAMMPS takes its turn between them. Times of whole runs are of the processor.
"""
import argparse
import csv
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
TREE = HERE.parent.parent
sys.path.insert(0, str(TREE / "app" / "report"))
REPEATS = 5

# Kernels of perifrac_bench by the words of the page: benchmark and arguments but the threads, dimension, what bonds a
# second are asked to be (issue 24) [M/s], flops a bond and doubles a point that move between memory and caches where
# points lie on a lattice, counted in linear_exact_lattice.hpp and lps_lattice.hpp; none: not counted.
LINEAR_EXACT, FLOW = {2: (26, 23), 3: (50, 42)}, {2: (14, 15), 3: (18, 22)}
LPS = {2: (20, 17), 3: (28, 22)}
KERNELS = [
    ("`lps`", "apply_lps<{D}>", "load:0/bonds:0", {2: 700, 3: 700}, LPS),
    ("`lps`, every hundredth bond broken", "apply_lps<{D}>", "load:0/bonds:1", {}, LPS),
    ("`lps`, pore stress", "apply_lps<{D}>", "load:1/bonds:0", {}, LPS),
    ("`lps`, jittered points", "apply_lps<{D}>", "load:0/bonds:2", {2: 300, 3: 300}, None),
    ("`linear_exact`", "apply_linear_exact<{D}>", "load:0/bonds:0", {2: 700, 3: 400}, LINEAR_EXACT),
    ("`linear_exact`, every hundredth bond broken", "apply_linear_exact<{D}>", "load:0/bonds:1", {}, LINEAR_EXACT),
    ("`linear_exact`, pore stress", "apply_linear_exact<{D}>", "load:1/bonds:0", {2: 400, 3: 400}, LINEAR_EXACT),
    ("`linear_exact`, pore stress and stress at rest", "apply_linear_exact<{D}>", "load:2/bonds:0", {}, LINEAR_EXACT),
    ("`linear_exact`, jittered points", "apply_linear_exact<{D}>", "load:0/bonds:2", {2: 300, 3: 300}, None),
    ("flow, one mobility", "apply_flow<{D}>", "cloud:0", {2: 400, 3: 400}, FLOW),
    ("flow, a tensor", "apply_tensor_flow<{D}>", "cloud:0", {2: 400, 3: 400}, FLOW),
    ("flow, jittered points", "apply_flow<{D}>", "cloud:2", {2: 300, 3: 300}, None),
]
FLUID_AIMS = {2: 8, 3: 2}  # million points times steps a second
LPS_OVER_LAMMPS = {2: 30, 3: 20}

LAMMPS = """units si
dimension {D}
boundary {boundary}
atom_style peri
atom_modify map array
neighbor 0.5 bin
lattice {lattice} 1.0
region body block 0 {last} 0 {last} {depth} units box
create_box 1 body
create_atoms 1 region body
pair_style peri/lps
pair_coeff * * 1.0e9 0.6e9 {horizon} 1e10 0.0
set group all density 2000
set group all volume 1.0
velocity all create 1e-6 1 dist uniform loop geom
timestep 1e-5
fix move all nve
run {steps}
"""

EXPLICIT_STEPS, EXPLICIT_STEP = 50, 1.21e-3  # of explicit.yaml [s]
EXPLICIT_SIZES = [12, 22, 46, 100, 160]  # points an axis
EQUILIBRIUM_SIZES = {2: [12, 16, 32, 64, 100, 215], 3: [12, 16, 32, 64, 100]}  # by horizon ratio
SCENES = [
    ("mandel", []), ("mandel", ["pore_flow.integrator={type: explicit}"]), ("dam_break", []), ("kalthoff", []),
    ("hf_storage", []), ("hf_storage_pores", []), ("hf_leakoff", []), ("kgd_viscosity", []), ("radial", []),
    ("hf_complete", []), ("two_fractures", []),
]  # fmt: skip


def one_thread():
    return os.environ | {"OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}


def bench(program, pattern):
    """Of each benchmark that matches: its counters, once."""
    done = subprocess.run([program, f"--benchmark_filter={pattern}", "--benchmark_format=json",
                           "--benchmark_min_time=0.2"], capture_output=True, text=True, check=True)
    return {run["name"].removesuffix("/real_time"): run for run in json.loads(done.stdout)["benchmarks"]}


def lammps(D, steps=20):
    """Bonds a second by Debian's LAMMPS, on the lattice of perifrac_bench [M/s]; None where it is not installed."""
    program = shutil.which("lmp")
    if program is None:
        return None
    count = 316 if D == 2 else 46
    script = LAMMPS.format(D=D, boundary="s s p" if D == 2 else "s s s", lattice="sq" if D == 2 else "sc",
                           last=count - 1, depth="-0.5 0.5" if D == 2 else f"0 {count - 1}",
                           horizon=2.5001 if D == 2 else 3.0001, steps=steps)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "in.lmp").write_text(script)
        done = subprocess.run([program, "-in", "in.lmp", "-log", "none"], cwd=folder, capture_output=True, text=True,
                              env=one_thread(), check=True)
    bonds = float(re.search(r"total # of bonds = (\d+)", done.stdout).group(1))
    return 1e-6 * bonds * steps / float(re.search(r"Loop time of ([\d.]+)", done.stdout).group(1))


def measure_kernels(options):
    pattern = "apply_|step_fluid|stream_memory|multiply_and_add"
    runs, peers = [], {2: [], 3: []}
    for _ in range(REPEATS):
        runs.append(bench(options.bench, pattern))
        for D, rates in peers.items():
            if (rate := lammps(D)) is not None:
                rates.append(rate)
    rows = []
    for name, first in runs[0].items():
        for counter, scale in (("million_bonds_per_s", 1.0), ("million_particle_steps_per_s", 1.0),
                               ("bytes_per_second", 1e-9), ("flop_per_s", 1e-9)):
            if counter not in first:
                continue
            values = [scale * run[name][counter] for run in runs]
            rows.append({"benchmark": name, "unit": counter, "median": statistics.median(values),
                         "least": min(values), "most": max(values), "path": first.get("label", "")})
    for D, rates in peers.items():
        if rates:
            rows.append({"benchmark": f"lammps<{D}>/threads:1", "unit": "million_bonds_per_s",
                         "median": statistics.median(rates), "least": min(rates), "most": max(rates), "path": ""})
    return rows


def run(perifrac, scene, keys, threads=1):
    """summary.json of a run with --profile."""
    with tempfile.TemporaryDirectory() as folder:
        command = [perifrac, "run", str(scene), "--no-report", "--profile", "--threads", str(threads),
                   "--output", folder, "--overwrite"]
        for key in keys:
            command += ["--set", key]
        done = subprocess.run(command, capture_output=True, text=True, env=one_thread())
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        return json.loads((Path(folder) / "summary.json").read_text())


def seconds(summary, name):
    return next((part["cpu_seconds"] for part in summary["profile"]["parts"] if part["name"] == name), 0.0)


def sized(count, ratio):
    return [f"body.size=[{count} m, {count} m, {count} m]", f"body.horizon_ratio={ratio}"]


def measure_explicit(options):
    rows = []
    for count in EXPLICIT_SIZES:
        if count**3 > options.largest:
            continue
        steps = EXPLICIT_STEPS if count <= 100 else 10
        summary = run(options.perifrac, HERE / "explicit.yaml",
                      [*sized(count, 3), f"time.end={steps * EXPLICIT_STEP} s"])
        solid = summary["modules"][0]
        rows.append({"points": summary["counts"]["points"], "bonds": summary["counts"]["bonds"],
                     "steps": summary["counts"]["windows"], "set-up [s]": seconds(summary, "set-up"),
                     "a step [s]": solid["cpu_time"] / solid["advances"], "whole [s]": summary["cpu_time"],
                     "peak [B]": summary["peak_memory"]})
    return rows


def measure_equilibrium(options):
    rows = []
    for ratio, counts in EQUILIBRIUM_SIZES.items():
        for count in counts:
            if count**3 > options.largest:
                continue
            threads = 2 if count > 100 else 1
            summary = run(options.perifrac, HERE / "equilibrium.yaml", sized(count, ratio), threads=threads)
            rows.append({"ratio": ratio, "points": summary["counts"]["points"], "bonds": summary["counts"]["bonds"],
                         "threads": threads, "set-up [s]": seconds(summary, "set-up"),
                         "whole [s]": summary["cpu_time"], "wall [s]": summary["wall_time"],
                         "peak [B]": summary["peak_memory"]})
    return rows


def measure_scenes(options):
    rows = []
    for name, keys in SCENES:
        row = {"scene": name, "with": " ".join(keys)}
        for threads in (1, 2):
            summary = run(options.perifrac, TREE / "configs" / f"{name}.yaml", keys, threads=threads)
            points = sum(count for name, count in summary["counts"].items() if name.endswith("points"))
            row |= {"points": points, "windows": summary["counts"]["windows"],
                    f"processor, {threads} [s]": summary["cpu_time"], f"wall, {threads} [s]": summary["wall_time"],
                    "peak [B]": summary["peak_memory"]}
        rows.append(row)
    return rows


MEASURES = {"kernels": measure_kernels, "explicit": measure_explicit, "equilibrium": measure_equilibrium,
            "scenes": measure_scenes}


def write_table(rows, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        table.writeheader()
        for row in rows:
            table.writerow({key: f"{value:.5g}" if isinstance(value, float) else value for key, value in row.items()})


def read_table(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file)) if path.exists() else []


def short(value):
    """Three digits."""
    return f"{value:#.3g}".rstrip(".") if value < 1000 else f"{value:.0f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


class Kernels:
    """The table of kernels: medians by benchmark, and what the machine allows."""

    def __init__(self, rows):
        self.rows = {row["benchmark"]: row for row in rows}

    def median(self, name):
        return float(self.rows[name]["median"]) if name in self.rows else None

    def rate(self, benchmark, arguments, D, threads):
        return self.median("/".join([benchmark.format(D=D), f"threads:{threads}", *arguments.split("/")]).rstrip("/"))

    def bound(self, counts, D):
        """The fewer bonds a second of what arithmetic and memory allow one thread, and which."""
        flops, doubles = counts[D]
        bonds_a_point = {2: 20, 3: 122}[D]
        arithmetic = 1e3 * self.median("multiply_and_add/threads:1") / flops
        memory = 1e3 * self.median("stream_memory/threads:1/MiB:128") / (8 * doubles / bonds_a_point)
        return min((arithmetic, "arithmetic"), (memory, "memory"))


def kernels_part(rows, images):
    kernels = Kernels(rows)
    lines = []
    for D in (2, 3):
        peer = kernels.median(f"lammps<{D}>/threads:1")
        for words, benchmark, arguments, aims, counts in KERNELS:
            one, two = (kernels.rate(benchmark, arguments, D, threads) for threads in (1, 2))
            if one is None:
                continue
            bound, which = kernels.bound(counts, D) if counts else (None, "")
            is_peer = peer and words == "`lps`"
            lines.append([f"{D}D", words, short(one), short(aims[D]) if D in aims else "",
                          f"{short(bound)}, {which}" if bound else "", f"{two / one:.2f}",
                          f"{one / peer:.1f} (asked: {LPS_OVER_LAMMPS[D]})" if is_peer else ""])
        if peer:
            lines.append([f"{D}D", "LAMMPS, `peri/lps`, one thread", short(peer), "", "", "", "1"])
    text = table(["", "kernel", "one thread [M bonds/s]", "asked", "the machine's bound", "two threads over one",
                  "over LAMMPS"], lines)
    fluid = []
    for D in (2, 3):
        one, two = (kernels.median(f"step_fluid<{D}>/threads:{threads}") for threads in (1, 2))
        fluid.append([f"{D}D", short(one), short(FLUID_AIMS[D]), f"{two / one:.2f}"])
    text += "\n" + table(["", "free fluid, one thread [M points x steps/s]", "asked", "two threads over one"], fluid)
    machine = [short(kernels.median(f"{name}/threads:{threads}{more}"))
               for name, more in (("stream_memory", "/MiB:128"), ("multiply_and_add", "")) for threads in (1, 2)]
    draw_kernels(kernels, images / "benchmarks_kernels.svg")
    return ("## Kernels\n\nA hundred thousand points, ratio 2.5 in 2D and 3 in 3D; a bond is a directed one, and a "
            "force is all passes over the bonds. In the same run the machine moves "
            f"{machine[0]} GB/s by one thread and {machine[1]} by two, and multiplies and adds {machine[2]} and "
            f"{machine[3]} Gflop/s. A kernel's bound is the lesser of what flops a bond and bytes a point allow, both "
            "counted in its code; what it loads from caches is not counted. LAMMPS is Debian's, a whole step of which next to all is the force.\n\n"
            f"![Kernels](images/benchmarks_kernels.svg)\n\n{text}\n")


def draw_kernels(kernels, path):
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True)
    for D, axis in zip((2, 3), axes):
        shown = [(words, kernels.rate(name, arguments, D, 1), counts) for words, name, arguments, _, counts in KERNELS]
        if (peer := kernels.median(f"lammps<{D}>/threads:1")) is not None:
            shown.append(("LAMMPS, peri/lps", peer, None))
        names = [words.replace("`", "") for words, _, _ in shown]
        axis.barh(names, [rate for _, rate, _ in shown], color=["C0"] * len(KERNELS) + ["C1"])
        bounds = [(n, kernels.bound(counts, D)[0]) for n, (_, _, counts) in enumerate(shown) if counts]
        axis.plot([b for _, b in bounds], [n for n, _ in bounds], "k|", markersize=9, label="the machine's bound")
        axis.set(xscale="log", xlabel="M bonds/s, one thread", title=f"{D}D")
    axes[0].invert_yaxis()
    axes[0].legend(loc="lower right", frameon=False)
    save(figure, path)


def save(figure, path):
    import matplotlib.pyplot as plt
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def growth_part(explicit, equilibrium, images):
    lines = [[f"{int(row['points']):,}", row["steps"], short(float(row["set-up [s]"])),
              short(1e3 * float(row["a step [s]"])), short(1e-6 * float(row["bonds"]) / float(row["a step [s]"])),
              short(float(row["whole [s]"])), short(float(row["peak [B]"]) / int(row["points"]))] for row in explicit]
    text = ("## Growth with the points\n\nA block in 3D in explicit steps, `lps`, ratio 3 "
            "([explicit.yaml](../bench/benchmarks/explicit.yaml)), one thread; the whole holds two frames and two "
            "checkpoints. Memory is the peak of the process, 17 MB of which are there before any point; 900 B a point "
            "were asked.\n\n")
    text += table(["points", "steps", "set-up [s]", "a step [ms]", "M bonds/s", "whole [s]", "peak [B/point]"], lines)
    lines = [[row["ratio"], f"{int(row['points']):,}", row["threads"], short(float(row["whole [s]"])),
              short(float(row["wall [s]"])), short(1e-6 * float(row["peak [B]"])),
              short(float(row["peak [B]"]) / int(row["points"]))] for row in equilibrium]
    text += ("\nThe same block in equilibrium on three rollers, `linear_exact`, by multigrid where `automatic` chooses "
             "it ([equilibrium.yaml](../bench/benchmarks/equilibrium.yaml)): set-up, one solution, a frame. Asked were "
             "a million points at ratio 3 in 60 s and 2.5 GB, and ten million at ratio 2 in 10 minutes and 18 GB.\n\n")
    text += table(["ratio", "points", "threads", "processor [s]", "wall [s]", "peak [MB]", "peak [B/point]"], lines)
    draw_growth(explicit, equilibrium, images / "benchmarks_growth.svg")
    return text + "\n![Growth](images/benchmarks_growth.svg)\n\n"


def draw_growth(explicit, equilibrium, path):
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.8))
    groups = {"50 explicit steps, ratio 3": explicit}
    for ratio in ("2", "3"):
        groups[f"equilibrium, ratio {ratio}"] = [row for row in equilibrium if row["ratio"] == ratio]
    for name, rows in groups.items():
        points = [int(row["points"]) for row in rows]
        steps = [50 / int(row["steps"]) if "steps" in row else 1.0 for row in rows]
        times = [float(row["whole [s]"]) * n if n == 1.0 else float(row["set-up [s]"]) + 50 * float(row["a step [s]"])
                 for row, n in zip(rows, steps)]
        left.loglog(points, times, "o-", label=name)
        right.loglog(points, [float(row["peak [B]"]) for row in rows], "o-", label=name)
    left.set(xlabel="points", ylabel="processor [s]")
    right.set(xlabel="points", ylabel="peak [B]")
    left.legend(frameon=False)
    save(figure, path)


def scenes_part(rows):
    lines = []
    for row in rows:
        keys = f", `{row['with']}`" if row["with"] else ""
        lines.append([f"[{row['scene']}](../configs/{row['scene']}.yaml){keys}", f"{int(row['points']):,}",
                      row["windows"], short(float(row["processor, 1 [s]"])), short(float(row["wall, 1 [s]"])),
                      short(float(row["wall, 2 [s]"])), short(1e-6 * float(row["peak [B]"]))])
    return ("## Whole scenes\n\nAs shipped, without the report.\n\n" +
            table(["scene", "points", "windows", "processor, one thread [s]", "wall, one thread [s]",
                   "wall, two threads [s]", "peak [MB]"], lines) + "\n")


def write_page(page, folder, machine):
    tables = {part: read_table(folder / f"{part}.csv") for part in MEASURES if (folder / f"{part}.csv").exists()}
    images = page.parent / "images"
    text = "# Speed and size\n\n`make benchmarks` measures this and writes this page; what it measured lies in "
    text += "[benchmarks](benchmarks). Ratios within a run say more than seconds, for the machine is shared. "
    text += f"Measured on {machine}.\n\n"
    if "kernels" in tables:
        text += kernels_part(tables["kernels"], images)
    if {"explicit", "equilibrium"} <= tables.keys():
        text += growth_part(tables["explicit"], tables["equilibrium"], images)
    if "scenes" in tables:
        text += scenes_part(tables["scenes"])
    text += ("What single effects cost is in [effects.md](effects.md), what accuracy costs in "
             "[studies.md](studies.md).\n")
    page.write_text(text)


def describe_machine(perifrac):
    summary = run(perifrac, TREE / "bench" / "effects" / "step.yaml", [])
    machine = summary["machine"]
    return (f"{machine['cores']} cores of an {machine['processor']}, {machine['memory'] / 2**30:.0f} GiB, "
            f"{summary['build']['instructions']}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("bench")
    parser.add_argument("--only", nargs="*", choices=list(MEASURES), default=list(MEASURES),
                        help="none: the page alone")
    parser.add_argument("--page", type=Path, default=TREE / "docs" / "benchmarks.md")
    parser.add_argument("--largest", type=float, default=1.1e7, help="points")
    options = parser.parse_args()
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "perifrac"
    folder = options.page.parent / "benchmarks"
    for part in options.only:
        write_table(MEASURES[part](options), folder / f"{part}.csv")
    write_page(options.page, folder, describe_machine(options.perifrac))


if __name__ == "__main__":
    main()
