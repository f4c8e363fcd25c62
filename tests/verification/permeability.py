#!/usr/bin/python3
"""Runs configs/aquifer.yaml over twelve decades of permeability with both integrators.

Usage: permeability.py PERIFRAC [--page FILE]

Fails where a run leaves the analytic solution, the integrators disagree or mass is lost; times are
told, not judged. --page writes what was found as a page.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

SCENE = os.path.join(os.path.dirname(__file__), "..", "..", "configs", "aquifer.yaml")
DROP = 98.1e3  # Pa
LENGTH, SPACING, END = 100.0, 1.0, 1.0  # m, m, s
STORAGE, VISCOSITY = 0.2 / 2e9, 1e-3
PLACES = [0.5, 1.5, 4.5, 9.5, 19.5, 49.5]
DECADES = range(-20, -7)
LARGEST_ERROR, LARGEST_MASS_ERROR = 5e-3, 1e-12  # of the drop; relative
UNRESOLVED_ERROR = 0.1  # while diffusion has come less than three spacings far


def fallen(x, permeability):
    """Part of the drop that has come to x: images while it is short, the series when it is long."""
    diffusivity = permeability / (VISCOSITY * STORAGE)
    if diffusivity * END < 0.1 * LENGTH**2:
        reach = math.sqrt(4.0 * diffusivity * END)
        return sum((-1)**n * (math.erfc((2 * n * LENGTH + x) / reach) +
                              math.erfc((2 * (n + 1) * LENGTH - x) / reach)) for n in range(5))
    modes = [(n + 0.5) * math.pi / LENGTH for n in range(50)]
    return 1.0 - sum(2.0 / (k * LENGTH) * math.sin(k * x) * math.exp(-k * k * diffusivity * END)
                     for k in modes)


def run(perifrac, integrator, permeability):
    with tempfile.TemporaryDirectory() as folder:
        settings = {"pore_flow.integrator.type": integrator, "pore_flow.permeability": permeability,
                    "time.end": END, "output.times": "[]", "coupling.window.first": END}
        words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        subprocess.run([perifrac, "run", SCENE, "--no-report", "--threads", "1", "--output", folder,
                        *words], check=True, capture_output=True)
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
            pressures = [float(entry) for entry in file.read().split("\n")[-2].split(",")[2:8]]
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
    module = summary["modules"][0]
    at_rest = 200e3 + 0.5 * SPACING * 9810.0
    return {"fallen": [(at_rest - p) / DROP for p in pressures],
            "steps": int(module["statistics"]["integrator_steps"]), "time": module["wall_time"],
            "mass_error": summary["ledger"]["mass_error"]}


def rows(perifrac):
    for decade in DECADES:
        permeability = 10.0**decade
        exact = [fallen(x, permeability) for x in PLACES]
        runs = {name: run(perifrac, name, permeability) for name in ("explicit", "cvode")}

        def difference(a, b):
            return max(abs(p - q) for p, q in zip(a, b))

        yield {"decade": decade, **runs,
               "disagreement": difference(runs["explicit"]["fallen"], runs["cvode"]["fallen"]),
               "error": max(difference(one["fallen"], exact) for one in runs.values()),
               "mass_error": max(one["mass_error"] for one in runs.values())}


def within_limits(row):
    reach2 = 10.0**row["decade"] / (VISCOSITY * STORAGE) * END
    limit = LARGEST_ERROR if reach2 >= 9.0 * SPACING**2 else UNRESOLVED_ERROR
    return max(row["error"], row["disagreement"]) <= limit and row["mass_error"] <= LARGEST_MASS_ERROR


def table(found):
    yield ("| permeability [m²] | largest error | explicit against cvode | explicit: steps | time [s] "
           "| cvode: steps | time [s] |")
    yield "|---|---|---|---|---|---|---|"
    for row in found:
        yield (f"| 1e{row['decade']} | {row['error']:.1e} | {row['disagreement']:.1e} "
               f"| {row['explicit']['steps']} | {row['explicit']['time']:.3f} "
               f"| {row['cvode']['steps']} | {row['cvode']['time']:.3f} |")


def page(found):
    most = max(found, key=lambda row: row["explicit"]["steps"])
    per_mobility = most["explicit"]["steps"] * 0.9 * 2.0 * STORAGE * SPACING**2 / END
    eigenvalue = per_mobility * VISCOSITY / 10.0**most["decade"]
    cheaper = [row["decade"] for row in found if row["explicit"]["time"] <= row["cvode"]["time"]]
    return f"""# Permeability over twelve decades

`make permeability` writes this page: [configs/aquifer.yaml](../configs/aquifer.yaml) for {END:g} s in one window, with both integrators on one thread. Errors are differences in pressure at six places from {PLACES[0]:g} to {PLACES[-1]:g} m, over the drop at the river; "largest error" is against the analytic solution, the worse of the two runs.

{os.linesep.join(table(found))}

The explicit step is at most 2 S Δx² / (κ L), with κ = permeability / viscosity and L = {eigenvalue:.2f} the largest eigenvalue of the operator over κ/Δx² (measured, with a margin of 2 %): a tenfold permeability takes ten times the steps, and where one step covers the whole time, none can be saved. CVODE chooses its steps by accuracy and needs about as many at any permeability; each costs a solve. Here it is the slower one up to 1e{max(cheaper)} m². That limit scales with the time to simulate over S Δx²: finer points, stiffer fluids and longer times move it to lower permeabilities.

Errors are largest where diffusion has come about one spacing far, κ t / S near Δx²: the lattice cannot resolve it, and explicit steps at their limit are then too few to be accurate. From three spacings on, errors are held to {LARGEST_ERROR:g}, before to {UNRESOLVED_ERROR:g}.
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--page")
    arguments = parser.parse_args()
    found = list(rows(os.path.abspath(arguments.perifrac)))
    print("\n".join(table(found)))
    if arguments.page:
        with open(arguments.page, "w", encoding="utf-8") as file:
            file.write(page(found))
    sys.exit("\n".join(f"1e{row['decade']} m^2: error {row['error']:.1e}, integrators apart by "
                       f"{row['disagreement']:.1e}, mass {row['mass_error']:.1e}" for row in found
                       if not within_limits(row)) or 0)


if __name__ == "__main__":
    main()
