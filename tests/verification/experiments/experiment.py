"""What scripts that hold runs to experiments share: runs with some inputs changed, and their page."""
import argparse
import csv
import os
import re
import subprocess
import unittest
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs/experiments.md"


def run(perifrac, scene, folder, keys, *words):
    """The history's columns, by name without unit."""
    settings = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    command = [perifrac, "run", scene, *settings, *words, "--no-report", "--output", folder]
    subprocess.run(command, check=True, capture_output=True)
    with open(folder / "history.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name.split(" [")[0]: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def write_table(name, lines):
    """In place of what the page has between <!-- name --> and <!-- end -->."""
    text = re.sub(rf"(<!-- {name} -->\n).*?(<!-- end -->)", lambda found: found[1] + "\n".join(lines) + "\n" + found[2],
                  PAGE.read_text(encoding="utf-8"), flags=re.S)  # fmt: skip
    PAGE.write_text(text, encoding="utf-8")


def new_picture(columns, size):
    """pyplot, the figure and its axes: the same bytes each time."""
    import matplotlib  # only the page needs it

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "perifrac"
    from matplotlib import pyplot

    return pyplot.subplots(1, columns, figsize=size, layout="constrained")


def save(figure, name):
    figure.savefig(ROOT / f"docs/images/{name}.svg", metadata={"Date": None})


def main(module, write_page):
    """Runs the tests of the module or writes its part of the page; its PERIFRAC is the program's path."""
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--page", action="store_true")
    arguments, rest = parser.parse_known_args()
    module["PERIFRAC"] = os.path.abspath(arguments.perifrac)
    if arguments.page:
        write_page()
    else:
        unittest.main(argv=[module["__file__"], *rest])
