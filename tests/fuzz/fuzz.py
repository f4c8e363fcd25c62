#!/usr/bin/python3
"""Fuzzes the readers of scenes and of checkpoints.

Usage: fuzz.py PERIFRAC FOLDER [--seconds N | --inputs N] [--only WORD]

FOLDER holds fuzz_scene and fuzz_checkpoint. Each runs so long, or takes so many inputs; fails where an input crashed,
leaked, hung or ended otherwise than by a plain refusal: that input is then named. What they learn is kept in
FOLDER/../fuzz and used again.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from dictionary import ROOT, first_scenes, write_dictionary

LONGEST_INPUT = {"scene": 2500, "checkpoint": 20000}  # [bytes]
SLOW = 5  # [s] of wall time, on a machine that does other things too


def first_inputs(perifrac, what, folder):
    """What the fuzzer begins with, copied to a folder."""
    folder.mkdir()
    for n, scene in enumerate(dict.fromkeys(first_scenes())):
        if what == "scene":
            shutil.copy(scene, folder / f"{n}.yaml")
    if what == "checkpoint":
        subprocess.run([perifrac, "run", ROOT / "tests" / "robustness" / "solid_only.yaml", "--no-report", "--output",
                        folder / "run"], check=True, capture_output=True)
    return folder


def fuzz(perifrac, binaries, what, limit, holder):
    """Gives (inputs, seconds of the slowest, complaint)."""
    learnt = binaries.parent / "fuzz" / what
    learnt.mkdir(parents=True, exist_ok=True)
    words = Path(holder) / "dictionary"
    write_dictionary(perifrac, words)
    done = subprocess.run(
        [binaries / f"fuzz_{what}", learnt, first_inputs(perifrac, what, Path(holder) / what), f"-dict={words}",
         limit, f"-max_len={LONGEST_INPUT[what]}", f"-timeout={SLOW}", "-print_final_stats=1",
         f"-artifact_prefix={learnt.parent}/{what}-"], capture_output=True, text=True, errors="replace",
        env=os.environ | {"OMP_NUM_THREADS": "1", "ASAN_SYMBOLIZER_PATH": "/usr/lib/llvm-16/bin/llvm-symbolizer"})

    def figure(name):
        found = re.search(rf"{name}:\s*(\d+)", done.stderr)
        return int(found[1]) if found else 0

    return (figure("number_of_executed_units"), figure("slowest_unit_time_sec"),
            "" if done.returncode == 0 else done.stderr[-4000:])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac", type=os.path.abspath)
    parser.add_argument("binaries", type=lambda path: Path(path).resolve())
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--inputs", type=int)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    limit = f"-runs={arguments.inputs}" if arguments.inputs else f"-max_total_time={arguments.seconds}"
    failed = False
    for what in LONGEST_INPUT:
        if arguments.only not in what:
            continue
        with tempfile.TemporaryDirectory() as holder:
            count, slowest, complaint = fuzz(arguments.perifrac, arguments.binaries, what, limit, holder)
        failed = failed or bool(complaint) or count == 0
        verdict = "A FAULT: " + complaint if complaint else "no fault"
        print(f"{what}: {count} inputs, the slowest took {slowest} s, {verdict}", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
