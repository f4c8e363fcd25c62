#!/usr/bin/python3
"""Holds the run times that `perifrac check` foretells against those that runs take.

Usage: forecast.py PERIFRAC [--page FILE] [SCENE ...]

Without SCENE: all shipped scenes. On one thread. Times are told, not judged, for they depend on what
else the machine does: run it on a quiet one. --page writes what was found as a page.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

CONFIGS = os.path.join(os.path.dirname(__file__), "..", "..", "configs")
WITHIN = 0.3


def foretold_and_taken(perifrac, scene):
    check = subprocess.run([perifrac, "check", scene, "--json", "--threads", "1"], check=True, capture_output=True)
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run([perifrac, "run", scene, "--json", "--threads", "1", "--no-report", "--output", folder],
                             check=True, capture_output=True)
    return json.loads(check.stdout)["forecast"], json.loads(run.stdout)


def rows(perifrac, scenes):
    for scene in scenes:
        foretold, taken = foretold_and_taken(perifrac, scene)
        yield {"scene": os.path.basename(scene)[:-len(".yaml")], "foretold": foretold["seconds"],
               "taken": taken["wall_time"] - taken["output_time"], "part": foretold["most_in"],
               "whole": foretold["trial"]["is_whole"],
               "windows": (foretold["windows"], taken["counts"]["windows"]),
               "memory": (foretold["peak_memory"] / 1e6, taken["peak_memory"] / 1e6)}


def line(row):
    ratio = row["foretold"] / row["taken"]
    mark = "" if abs(ratio - 1.0) <= WITHIN else " (!)"
    return (f"| {row['scene']} | {row['foretold']:.2f} | {row['taken']:.2f} | {ratio:.2f}{mark} | {row['part']} "
            f"| {row['windows'][0]} / {row['windows'][1]} | {row['memory'][0]:.0f} / {row['memory'][1]:.0f} "
            f"| {'whole' if row['whole'] else 'part'} |")


HEADER = ("| scene | foretold [s] | taken [s] | ratio | most in | windows | memory [MB] | trial |\n"
          "|---|---|---|---|---|---|---|---|")


def page(lines):
    return f"""# Run times, foretold and taken

How long the shipped scenes take and how much memory, and how well `perifrac check` foretells it.

`perifrac check SCENE` runs the first windows of a scene for four seconds of processor time (`--trial SECONDS`; 0: not at all), or for twelve, where cracks that are to grow have not done so ten times yet or a tenth of the way is done, and says what the whole run takes. A window costs a module what it did on average in the latter half of the trial or, where the module has a stable step of its own, what a step did; a facet that a crack gains costs what it did and half a window more, and how many are to come is known from the [regime](fracture.md#regime) of the crack where the body is as good as infinite, elsewhere from a run of the same scene on points two to five times as far apart, which takes seconds at most. Where neither tells, windows in which cracks grow count as any others. Why so: [decision 15](decisions/0015-run-times-are-tried.md).

`make forecast` writes this page: foretold and taken by all shipped scenes, on one thread, without writing results; some ten minutes. Where the trial came to the end ("whole") nothing is extrapolated. (!): off by more than 30 %.

{HEADER}
{os.linesep.join(lines)}
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--page")
    arguments = parser.parse_args()
    scenes = arguments.scenes or sorted(os.path.join(CONFIGS, name) for name in os.listdir(CONFIGS)
                                        if name.endswith(".yaml"))
    lines = []
    print(HEADER)
    for row in rows(os.path.abspath(arguments.perifrac), scenes):
        lines.append(line(row))
        print(lines[-1], flush=True)
    if arguments.page:
        with open(arguments.page, "w", encoding="utf-8") as file:
            file.write(page(lines))


if __name__ == "__main__":
    sys.exit(main())
