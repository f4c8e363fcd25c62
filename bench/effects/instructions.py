#!/usr/bin/python3
"""What is absent costs no instructions, and work follows activity: counted by valgrind's callgrind, the same on a
busy machine as on a quiet one. Needs a build with -DPERIFRAC_NATIVE=OFF (valgrind knows no AVX-512): make instructions.

usage: bench/effects/instructions.py BUILD     (with bin/perifrac and bin/perifrac_solid_step)

1. A step of a solid alone in the program, where all modules are registered, against the same step driven by
   perifrac_solid_step, to which neither program nor coupling nor another physics is linked: within 0.1 %. Work of the
   program, the manager or the ledger that came to be done in every step of a module would show.
2. A step of the solid against the forces of its bonds alone: not above the recorded ratio by more than 0.1 %. A branch
   or a pass over the points for damage, pores or an interface that are not there would show in the step and not in the
   forces.
3. In the program's steps, functions of absent effects: none. In a scene that has the effect they are found.
4. Damage, fluid and crack network in 1 % of a body against everywhere (activity.py): at most a fifth, their own
   instructions; of the whole scene where the effect is most of it."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from activity import PAIRS

HERE = Path(__file__).resolve().parent
STEP = HERE / "step.yaml"
TOLERANCE = 1e-3

# Every array at the beginning of a page: where memory lies moves a count by a part in a thousand.
ENVIRONMENT = ("OMP_NUM_THREADS=1", "OPENBLAS_NUM_THREADS=1", "MALLOC_MMAP_THRESHOLD_=1024", "MALLOC_MMAP_MAX_=1000000")

# Instructions of a step of the solid over those of its bonds' forces, as counted with g++ 12 of Debian 12.
RECORDED_RATIO = 1.0904

# What the C library's heap does within a call, mostly for OpenMP: it follows what was freed before the steps, such as
# the names of files. The calls themselves are counted.
HEAP = r"^(_int_malloc|_int_free|_int_memalign|malloc_consolidate|unlink_chunk\S*|alloc_perturb)\b"

ABSENT = r"CriticalStretch|StretchBudget|CrackDynamics|CrackTips|CrackFront|DynamicFracture|Darcy|FluidDynamics|FreeFluid|" \
         r"WallMotion|Lubrication|CrackNetwork|LeakOff|perifrac::Link::|Mapping"

# Scenes of activity.py, short: until when, and the function whose instructions are the effect's own.
OWN = {"strip.yaml": ("400 us", "*CriticalStretch<2>::break_stretched*"),
       "film.yaml": ("0.2 s", "*FreeFluid<2>::advance*"),
       "slits.yaml": ("1 ms", "*CrackNetwork<2>::advance*")}
WHOLE = "perifrac::CouplingManager::advance(double)"
FOLLOWS_AS_A_WHOLE = ("film.yaml",)


class Counter:
    def __init__(self, build, folder):
        self.perifrac = build / "bin" / "perifrac"
        self.solid_step = build / "bin" / "perifrac_solid_step"
        self.folder = folder

    def count(self, command, toggle=None, functions=None):
        """Instructions of a command without the heap's own; within `toggle` alone; those of functions that match."""
        out = self.folder / "callgrind.out"
        only = [f"--toggle-collect={toggle}"] if toggle else []
        done = subprocess.run(
            ["env", *ENVIRONMENT, "valgrind", "--tool=callgrind",
             f"--callgrind-out-file={out}", *only, *map(str, command)], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr + done.stdout)
        table = subprocess.run(["callgrind_annotate", "--threshold=100", str(out)], capture_output=True, text=True)
        counts = re.findall(r"(?m)^\s*([\d,]+) \([^)]*\)\s+\S+?:(.*)$", table.stdout)
        found = sum(int(count.replace(",", "")) for count, name in counts if re.search(functions or HEAP, name))
        return found if functions else int(re.search(r"Collected : (\d+)", done.stderr).group(1)) - found

    def run(self, scene, keys, *options):
        settings = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
        return [self.perifrac, "run", scene, "--no-report", "--threads", "1", "--output", self.folder / "run",
                "--set", "output.checkpoint_interval=1e9 s", *settings, *options]

    def steps_done(self):
        text = (self.folder / "run" / "summary.json").read_text()
        return int(float(re.search(r'"integrator_steps": ([\d.]+)', text).group(1)))

    def program_step(self, scene, functions=None):
        """A step of the solid in the program, all that is done in a window included and nothing that is written:
        between two runs of one window each."""
        counts = []
        for end in ("100 us", "300 us"):
            keys = {"time.end": end, "coupling.window.first": end, "coupling.window.largest": end}
            counts.append((self.count(self.run(scene, keys), toggle=WHOLE, functions=functions), self.steps_done()))
        return (counts[1][0] - counts[0][0]) / (counts[1][1] - counts[0][1])

    def alone_step(self, *what):
        few, many = (self.count([self.solid_step, STEP, str(steps), *what]) for steps in (20, 220))
        return (many - few) / 200


def hold(held, text):
    print(("held:   " if held else "BROKEN: ") + text, flush=True)
    return held


def absent(counter):
    program, alone, forces = counter.program_step(STEP), counter.alone_step(), counter.alone_step("forces")
    strip = HERE / "strip.yaml"
    inside, present = counter.program_step(STEP, ABSENT), counter.program_step(strip, ABSENT)
    return [
        hold(abs(program / alone - 1.0) <= TOLERANCE,
             f"a step of the solid: {program:.0f} instructions in the program, {alone:.0f} alone"),
        hold(alone / forces <= RECORDED_RATIO * (1.0 + TOLERANCE),
             f"a step over its bonds' forces: {alone / forces:.5f}, recorded {RECORDED_RATIO:.5f}"),
        hold(inside == 0 and present > 1000,
             f"of absent effects {inside:.0f} instructions a step, {present:.0f} where bonds may break"),
    ]


def activity(counter):
    held = []
    for name, scene, everywhere, _ in PAIRS:
        end, function = OWN[scene]
        for toggle, what in ((function, "its own"), (WHOLE, "the whole scene")):
            few, all_of_it = (counter.count(counter.run(HERE / scene, keys, "--until", end), toggle=toggle)
                              for keys in ({}, everywhere))
            text = f"{name}, 1 % over everywhere, {what}: {few} / {all_of_it} = {few / all_of_it:.3f}"
            if toggle == function or scene in FOLLOWS_AS_A_WHOLE:
                held.append(hold(few > 0 and few <= 0.2 * all_of_it, text))
            else:
                print("        " + text, flush=True)
    return held


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        counter = Counter(Path(sys.argv[1]).resolve(), Path(folder))
        held = absent(counter) + activity(counter)
    raise SystemExit(0 if all(held) else 1)


if __name__ == "__main__":
    main()
