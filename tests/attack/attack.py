#!/usr/bin/python3
"""Attacks the program with made-up scenes and says how each ended.

Usage: attack.py PERIFRAC [--count N] [--seed S] [--first N] [--jobs N] [--folder DIR] [--only SCENE ...] [--again]

Each scene is run, and run again at half the spacing and with windows half as long. Outcomes:
right (the three agree to 20 %), warned, refused (exit 2), failed (exit 1 with field, place and
time), and the faults: refused or failed without a reason, crash, hang, and silent, exit 0 without
a warning where an answer differs by more than 20 %. DIR keeps what was found, a line a scene, so
that an attack goes on where it was stopped; faults keep their scene there too. Exits with 1 where
there are faults.
"""
import argparse
import collections
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

import mutate  # first: it says where the others are
import answers
import small
from transforms import Keys

SEED = 20
WRONG, NEAR = 0.2, 0.05
SHORTEST, PATIENCE = 30.0, 10.0  # s; a hang takes ten times what was foretold, or this if that is more
DEAR = 0.5  # s; of runs foretold to take longer only the beginning is run
TRIAL = 0.5  # s
MOST_POINTS = 5000
OUT_OF_TIME = (-signal.SIGXCPU,)
FAULTS = ("crash", "hang", "silent", "refused without a reason", "failed without a reason")
TOO_LARGE = "too large to be tried here"  # of `check`: what memory there is would not do
REASON = re.compile(r"error: .+ in \S.* at .+, t = \S+ s")
REFUSAL = re.compile(r":\d+(:\d+)?: .+; |expected")


class Attack:
    def __init__(self, arguments):
        self.perifrac = os.path.abspath(arguments.perifrac)
        self.seed = arguments.seed
        self.folder = Path(arguments.folder)
        listed = subprocess.run([self.perifrac, "list", "--json"], capture_output=True, text=True, check=True)
        self.keys = Keys(json.loads(listed.stdout))
        self.scenes = {name: scene for name, scene in small.shipped().items() if not arguments.only or name in arguments.only}

    def scene(self, number):
        """Of that number: small enough, or made up anew."""
        for attempt in range(100):
            chance = random.Random(f"{self.seed}/{number}/{attempt}")
            name, changes, scene = mutate.made_up(chance, self.scenes, self.keys)
            if 1 < mutate.points_of(scene) <= MOST_POINTS and changes:
                return name, changes, scene
        raise RuntimeError(f"no scene of number {number}")

    def command(self, *words, patience):
        """Ended after so many seconds of processor time: a machine busy with other things needs the room."""
        limit = int(patience) + 1
        try:
            done = subprocess.run([self.perifrac, *words], capture_output=True, text=True, errors="replace",
                                  timeout=20.0 * patience,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)))
        except subprocess.TimeoutExpired:
            return None, "", ""
        return (None if done.returncode in OUT_OF_TIME else done.returncode), done.stderr, done.stdout

    def foretell(self, file, *more):
        """(exit code, what it said, seconds)."""
        code, said, told = self.command("check", str(file), "--json", "--trial", str(TRIAL), "--threads", "1", *more,
                                        patience=SHORTEST)
        if code != 0:
            return code, said, 0.0
        told = json.loads(told)
        return code, " ".join([said, *told.get("warnings", [])]), (told.get("forecast") or {}).get("seconds") or 0.0

    def run(self, scene, file, foretold, until):
        file.write_text(json.dumps(scene), encoding="utf-8")
        folder = file.with_suffix("")
        words = ["run", str(file), "--no-report", "--threads", "1", "--output", str(folder)]
        if until is not None:
            words += ["--until", repr(until)]
        code, said, _ = self.command(*words, patience=max(SHORTEST, PATIENCE * foretold))
        return code, said, folder

    def attack(self, number):
        name, changes, scene = self.scene(number)
        found = {"number": number, "scene": name, "changes": changes, "difference": None, "figure": ""}
        work = Path(tempfile.mkdtemp(prefix="attack_"))
        try:
            found.update(self.outcome(scene, work))
        finally:
            shutil.rmtree(work, ignore_errors=True)
        if judged(found)["outcome"] in FAULTS:
            kept = self.folder / f"{number}.yaml"
            kept.write_text(json.dumps(scene, indent=1), encoding="utf-8")
        return found

    def outcome(self, scene, work):
        file = work / "scene.yaml"
        file.write_text(json.dumps(scene), encoding="utf-8")
        code, said, foretold = self.foretell(file)
        until = None
        if code == 0 and TOO_LARGE in said:
            return {"outcome": "warned", "said": TOO_LARGE, "warned": True}
        if code == 0 and foretold > DEAR:
            until = scene["time"]["end"] * DEAR / foretold
            foretold = max(DEAR, self.foretell(file, "--set", f"time.end={until!r} s")[2])  # first windows are short
        if code in (0, 1):
            code, said, folder = self.run(scene, file, foretold, until)
        ended = {**ending(code, said), "foretold": foretold, "until": until}
        if ended["outcome"] != "right":
            return ended
        return {**ended, **self.comparison(scene, work, answers.Answer(folder), foretold, until)}

    def comparison(self, scene, work, answer, foretold, until):
        dear = 2**(scene["dimension"] + 2)
        result = {"difference": 0.0, "figure": "", "compared": []}
        for word, other, cost in (("spacing", mutate.finer(scene), dear), ("window", mutate.shorter_windows(scene), 2)):
            if other is None:
                continue
            code, said, folder = self.run(other, work / f"{word}.yaml", cost * foretold, until)
            if code != 0:
                result[f"at half the {word}"] = ending(code, said)["said"]
                continue
            result["compared"].append(word)
            far, figure = answers.farthest(answer, answers.Answer(folder), scene)
            if far > result["difference"]:
                result.update(difference=far, figure=f"{figure} at half the {word}")
        return result


def ending(code, said):
    lines = [line for line in said.splitlines() if line.strip()]
    # Of the probes that tell how large a quantity is (small.py), and that no answer is read at, nothing need be said.
    warnings = [line for line in lines if "warning:" in line and "warning: probe 'size" not in line]
    errors = [line for line in lines if "error" in line] or lines[-1:]
    last = (errors[-1] if errors else "")[-400:]
    if code is None:
        return {"outcome": "hang", "said": last, "warned": False}
    if code == 0:
        return {"outcome": "right", "said": warnings[0][-400:] if warnings else "", "warned": bool(warnings)}
    if code == 2:
        return {"outcome": "refused" if REFUSAL.search(said) else "refused without a reason",
                "said": (lines[0] if lines else "")[-400:], "warned": False}
    if code == 1:
        return {"outcome": "failed" if REASON.search(said) else "failed without a reason", "said": last, "warned": False}
    return {"outcome": "crash", "said": f"exit {code}: {last}", "warned": False}


def judged(found):
    """The last word on a scene that ran: right, warned or silent."""
    if found["outcome"] == "right":
        if found["warned"]:
            found["outcome"] = "warned"
        elif (found["difference"] or 0.0) > WRONG:
            found["outcome"] = "silent"
    return found


def read(file):
    if not file.exists():
        return {}
    found = {}
    for line in file.read_text(encoding="utf-8").splitlines():
        try:
            one = json.loads(line)
        except json.JSONDecodeError:
            continue  # cut short when it was stopped
        found[one["number"]] = one
    return found


def report(found):
    counts = collections.Counter(one["outcome"] for one in found)
    ran = [one for one in found if one.get("compared")]
    agreeing = [one for one in ran if one["difference"] <= NEAR]
    for outcome, count in counts.most_common():
        print(f"{outcome:26} {count:5}  {100.0 * count / len(found):5.1f} %")
    needless = sum(one["warned"] for one in agreeing)
    print(f"agree to 5 %: {len(agreeing)} of {len(ran)} compared, of which {needless} warn")
    for one in found:
        if one["outcome"] in FAULTS:
            far = f", {one['figure']} differs by {one['difference']:.0%}" if one["outcome"] == "silent" else ""
            print(f"{one['outcome']}: {one['number']} {one['scene']} {' '.join(one['changes'])}{far} {one['said'][-160:]}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--count", type=int, default=3000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--folder", default="runs/attack")
    parser.add_argument("--only", nargs="*", help="of these shipped scenes")
    parser.add_argument("--again", action="store_true")
    arguments = parser.parse_args()
    attack = Attack(arguments)
    attack.folder.mkdir(parents=True, exist_ok=True)
    file = attack.folder / f"seed_{arguments.seed}.jsonl"
    if arguments.again:
        file.unlink(missing_ok=True)
    numbers = range(arguments.first, arguments.first + arguments.count)
    found = read(file)
    left = [number for number in numbers if number not in found]
    with open(file, "a", encoding="utf-8") as lines, ThreadPoolExecutor(arguments.jobs) as pool:
        for done in as_completed([pool.submit(attack.attack, number) for number in left]):
            if done.exception():
                pool.shutdown(cancel_futures=True)
            one = done.result()
            found[one["number"]] = one
            lines.write(json.dumps(one) + "\n")
            lines.flush()
            if sys.stdout.isatty():
                print(one["number"], one["scene"], one["outcome"], one["said"][-100:], flush=True)
    chosen = [found[number] for number in numbers]
    report(chosen)
    sys.exit(1 if any(one["outcome"] in FAULTS for one in chosen) else 0)


if __name__ == "__main__":
    main()
