#!/usr/bin/python3
"""Does faults to runs at random moments, and holds that nothing is lost and that the program says what is wrong.

Usage: faults.py PERIFRAC [--rounds N] [--kills N] [--seed N] [--only WORD] [--page FILE]

Each round does each fault to one scene; scenes of several kinds take turns. After each fault, whatever was complete
can be read and is right, and a restart from the last checkpoint ends with the bits of the run that nothing disturbed.
--page writes what was found into a page.
"""
import argparse
import collections
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from fault_list import FAULTS, out_of_memory
from fault_runs import LARGE, LONGEST, SCENES, Fault, Scene
from page_part import put_part, table
from perifrac_runs import PERIFRAC


def read_arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--kills", type=int, help="rounds of kill -9; as many as --rounds")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="faults whose name holds this")
    parser.add_argument("--page")
    return parser.parse_args()


def least_memory(is_enough):
    """The least address space [bytes], to a MiB, with which `perifrac --version` ends as wanted."""
    low, high = 1 << 20, 1 << 36
    while high - low > 1 << 20:
        middle = (low + high) // 2
        done = subprocess.run([PERIFRAC, "--version"], capture_output=True, timeout=LONGEST,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (middle, middle)))
        low, high = (low, middle) if is_enough(done.returncode) else (middle, high)
    return high


def can_mount(holder):
    place = Path(holder) / "mount"
    place.mkdir()
    done = subprocess.run(["mount", "-t", "tmpfs", "tmpfs", str(place)], capture_output=True)
    if done.returncode == 0:
        subprocess.run(["umount", str(place)], check=True)
    return done.returncode == 0


def walk(arguments, holder):
    """{fault: what came of each round}, and what failed."""
    loaders_memory = least_memory(lambda code: code != 127)  # below, the loader speaks, not the program
    to_begin = least_memory(lambda code: code == 0)
    scenes = {name: Scene(name, holder) for name in SCENES | LARGE}
    for scene in scenes.values():
        scene.loaders_memory, scene.least_memory = loaders_memory, to_begin
    found, failed = collections.defaultdict(list), []
    mounts = can_mount(holder)
    for turn, (name, fault) in enumerate(FAULTS.items()):
        if arguments.only not in name:
            continue
        if "tmpfs" in name and not mounts:
            print(f"{name}: skipped, no right to mount", flush=True)
            continue
        rounds = arguments.kills if name == "kill -9" and arguments.kills is not None else arguments.rounds
        begin = time.monotonic()
        for n in range(rounds):
            names = list(LARGE if fault is out_of_memory else SCENES)
            scene = scenes[names[(n + turn + arguments.seed) % len(names)]]
            moments = random.Random(f"{arguments.seed} {name} {n}")
            folder = Path(holder) / f"{name.replace(' ', '_')}_{n}"
            try:
                found[name].append(fault(scene, folder, moments))
                shutil.rmtree(folder)
            except Fault as error:
                found[name].append("FAILED")
                failed.append(f"{name}, round {n}, {scene.name}: {error}")
                print(failed[-1], flush=True)
        print(f"{name}: {rounds} times, {found[name].count('FAILED')} failed, {time.monotonic() - begin:.0f} s",
              flush=True)
    return found, failed


def page_of(found, arguments):
    rows = []
    for name, ends in found.items():
        kinds = collections.Counter(ends).most_common()
        what = "; ".join(f"{count} × {end}" for end, count in kinds)
        rows.append((name, len(ends), what, ends.count("FAILED")))
    kills = "" if arguments.kills is None else f" --kills {arguments.kills}"
    command = f"tests/robustness/faults.py build/release/bin/perifrac --rounds {arguments.rounds}{kills}"
    return table(("fault", "times", "what came of it", "lost, wrong, or without a clear word"), rows) + \
        f"\n\n`{command} --seed {arguments.seed}`; scenes, in turn: {', '.join(SCENES)}; " \
        f"for memory: {', '.join(LARGE)}."


def main():
    arguments = read_arguments()
    with tempfile.TemporaryDirectory() as holder:
        os.chmod(holder, 0o755)
        found, failed = walk(arguments, holder)
    if arguments.page:
        put_part(arguments.page, "faults", page_of(found, arguments))
    print(f"{sum(map(len, found.values()))} faults, {len(failed)} failed")
    sys.exit(1 if failed or not found else 0)


if __name__ == "__main__":
    main()
