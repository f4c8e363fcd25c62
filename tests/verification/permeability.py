#!/usr/bin/python3
"""Holds configs/studies/permeability.yaml to the analytic solution, and its steps to the stable step.

Usage: permeability.py PERIFRAC

Times are not judged, but that they cross once.
"""
import json
import os
import subprocess
import sys
import tempfile

STUDY = os.path.join(os.path.dirname(__file__), "..", "..", "configs", "studies", "permeability.yaml")
SPACING, END, STORAGE, VISCOSITY = 1.0, 1.0, 0.2 / 2e9, 1e-3
EIGENVALUE, MARGIN = 5.29, 0.9  # of the operator over kappa/dx^2; of the stable step that is taken
# The river's fall is a jump: steps begin with an eighth of the longest, then take half of the time since
# it. Eight of them go as far as 2.85 of the longest.
SHORT_STEPS = 6
LARGEST_ERROR, LARGEST_MASS_ERROR = 5e-3, 1e-12  # of the drop; relative
UNRESOLVED_ERROR = 0.1  # while diffusion has come less than three spacings far


def complaints(folder):
    with open(os.path.join(folder, "study.json"), encoding="utf-8") as file:
        study = json.load(file)
    for variant in study["variants"]:
        name = variant["name"]
        if variant["status"] != "done":
            yield f"{name}: {variant['status']}: {variant['message']}"
            continue
        mobility = float(variant["choice"]["permeability"].split()[0]) / VISCOSITY
        resolved = mobility / STORAGE * END >= 9.0 * SPACING**2
        limit = LARGEST_ERROR if resolved else UNRESOLVED_ERROR
        if not variant["error"] <= limit:
            yield f"{name}: error {variant['error']:.1e}, at most {limit:.1e} expected"
        with open(os.path.join(folder, "variants", name, "summary.json"), encoding="utf-8") as file:
            mass_error = json.load(file)["ledger"]["mass_error"]
        if not mass_error <= LARGEST_MASS_ERROR:
            yield f"{name}: mass off by {mass_error:.1e}"
        steps = variant["modules"][0]["statistics"]["integrator_steps"]
        stable = END * mobility * EIGENVALUE / (2.0 * MARGIN * STORAGE * SPACING**2)
        least, most = 0.9 * stable, 1.1 * stable + 1.0 + SHORT_STEPS
        if variant["choice"]["integrator"] == "explicit" and not least <= steps <= most:
            yield f"{name}: {steps:g} steps, about {stable:.0f} expected"
    places = [place for crossing in study["crossings"] for place in crossing["places"]]
    if len(places) != 1:
        yield f"costs cross at {places}, one place expected"


def main():
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([os.path.abspath(sys.argv[1]), "study", STUDY, "--no-report", "--output", folder],
                              capture_output=True, text=True, check=False)
        print(done.stdout)
        wrong = list(complaints(folder)) if done.returncode == 0 else [done.stderr]
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
