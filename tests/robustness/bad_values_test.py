#!/usr/bin/python3
"""Every number and list of numbers of every shipped scene is replaced by what is none: each is told of with its place.

Usage: bad_values_test.py PERIFRAC [CONFIGS]

The catalogue of `perifrac list` says which keys hold numbers and lists of them. All of a scene are
replaced at once, each by another of the words below, for all mistakes of a scene are told at once:
nothing may be taken for a number, passed over, or end the program otherwise than by exit code 2.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, *folder) for folder in ((os.pardir,), (os.pardir, "metamorphic"))]
import scene_values  # noqa: E402
from transforms import Keys, walk  # noqa: E402

NUMBERS = (".nan", ".inf", '""', "true", "1 parsec s", "{a: 1}", "0x10", "1e999", "[[1]]", "-.inf", "abc")
LISTS = ("{a: 1}", "[[1]]", "[.nan, 1]", "[true, 1]", "abc", '[1, ""]', "[1e999, 1]")
KINDS = {"number": NUMBERS, "integer": NUMBERS, "vector": LISTS, "numbers": LISTS}
WHOLE = ("dimension",)  # says how long vectors are
TURNS = 3  # from scene to scene words go on to other keys
LEAST_KEYS = 100  # numbers that shipped scenes give


def held_by(scene, keys):
    """(path, key) of what holds numbers."""
    found = []

    def note(path, value):
        key = keys.find(path, scene)
        if key and key["kind"] in KINDS and path[-1] not in WHOLE:
            found.append((path, key))
        return value

    walk(scene, note)
    return found


def spoilt(scene, held, turn):
    """As YAML, a value a line; and by line the key and the word that stand there."""
    marks = {path: f"@{n}@" for n, (path, _) in enumerate(held)}
    lines = json.dumps(walk(scene, lambda path, value: marks.get(path, value)), indent=1).splitlines()
    where = {}
    for number, line in enumerate(lines, 1):
        mark = re.search(r'"@(\d+)@"', line)
        if mark:
            path, key = held[int(mark[1])]
            words = KINDS[key["kind"]]
            word = words[(int(mark[1]) + 4 * turn) % len(words)]
            where[number] = (path, word)
            lines[number - 1] = line.replace(mark[0], word)
    return "\n".join(lines) + "\n", where


def complaints(perifrac, name, yaml, where):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scene.yaml"), "w", encoding="utf-8") as file:
            file.write(yaml)
        done = subprocess.run([perifrac, "check", "scene.yaml", "--trial", "0"], cwd=folder, capture_output=True, text=True)
    if done.returncode != 2 or done.stdout:
        yield f"{name}: exit code {done.returncode}, expected 2: {done.stderr[-300:]}"
        return
    told = {}
    for line in done.stderr.splitlines():
        place = re.match(r"scene\.yaml:(\d+):\d+: .+; expected .+", line)
        if place:
            told[int(place[1])] = line
        else:
            yield f"{name}: no place, or no word of what is expected: {line}"
    for number, (path, word) in where.items():
        last = [part for part in path if isinstance(part, str)][-1]
        if last not in told.get(number, ""):
            yield f"{name}: {word} at {'.'.join(map(str, path))}: {told.get(number, 'nothing is said')}"


def main():
    perifrac = os.path.abspath(sys.argv[1])
    configs = sys.argv[2] if len(sys.argv) > 2 else os.path.join(HERE, os.pardir, os.pardir, "configs")
    listed = subprocess.run([perifrac, "list", "--json"], capture_output=True, text=True, check=True)
    keys = Keys(json.loads(listed.stdout))
    wrong, tried = [], set()
    for number, name in enumerate(sorted(os.listdir(configs), reverse=True)):
        if name.endswith(".yaml"):
            scene = scene_values.read(os.path.join(configs, name))
            held = held_by(scene, keys)
            tried.update(f"{key['section']}.{key['path']}" for _, key in held)
            wrong += complaints(perifrac, name, *spoilt(scene, held, number % TURNS))
    if len(sys.argv) == 2 and len(tried) < LEAST_KEYS:
        wrong.append(f"{len(tried)} keys were tried, expected {LEAST_KEYS} or more")
    sys.exit("\n".join(wrong) if wrong else 0)


if __name__ == "__main__":
    main()
