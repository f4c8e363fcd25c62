#!/usr/bin/python3
"""Runs the commands of the tutorials, and holds what a page says that they print to what they do.

Usage: tutorials.py PERIFRAC [PAGE ...]    the pages of docs/tutorials by default
       tutorials.py PERIFRAC --pictures    ... and keeps the pictures that the pages show

A block ```sh is run as one script, with `perifrac` on the path, in a folder of the page's own. A block ```text right
after it is what its output holds: every line but `...`, the words as they stand and numbers within a tenth, so that
rounding, the machine and the clock say nothing. A block ```yaml with a first line `# FILE` is written to that file.
"""
import argparse
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = ROOT / "docs" / "tutorials"
BLOCK = re.compile(r"^```(sh|text|yaml|csv)\n(.*?)^```$", flags=re.S | re.M)
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
PICTURE = re.compile(r"!\[[^]]*\]\(images/([^)]*)\)\s*<!-- (\S+) -->")
TOLERANCE = 0.1


def parts(line):
    """The words of a line, with a mark for every number, and the numbers."""
    return " ".join(NUMBER.sub("#", line).split()), [float(number) for number in NUMBER.findall(line)]


def agrees(wanted, line):
    words, numbers = parts(wanted)
    other_words, others = parts(line)
    return words == other_words and all(
        math.isclose(a, b, rel_tol=TOLERANCE, abs_tol=1e-12) for a, b in zip(numbers, others))


def missing(wanted, output):
    lines = output.splitlines()
    return [line for line in wanted.splitlines()
            if line.strip() not in ("", "...") and not any(agrees(line, other) for other in lines)]


def run_page(page, perifrac, keep_pictures):
    text = page.read_text(encoding="utf-8")
    environment = dict(os.environ, PATH=f"{perifrac.parent}:{os.environ['PATH']}", OMP_NUM_THREADS="1",
                       COLUMNS="100")
    failures, output = [], ""
    with tempfile.TemporaryDirectory() as folder:
        for kind, body in BLOCK.findall(text):
            if kind == "sh":
                done = subprocess.run(["sh", "-ec", body], cwd=folder, env=environment, text=True, check=False,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                output = done.stdout
                if done.returncode != 0:
                    failures.append(f"{page.name}: exit code {done.returncode} of\n{body}\n{output}")
            elif kind == "text":
                failures += [f"{page.name}: nothing printed agrees with\n  {line}\nin\n{output}"
                             for line in missing(body, output)]
            elif body.startswith("# "):
                name, _, content = body[2:].partition("\n")
                Path(folder, name).write_text(content, encoding="utf-8")
        for image, source in PICTURE.findall(text):
            made = Path(folder, source)
            if not made.exists():
                failures.append(f"{page.name}: the commands leave no {source}")
            elif keep_pictures:
                (PAGES / "images").mkdir(exist_ok=True)
                shutil.copy(made, PAGES / "images" / image)
    return failures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac", type=lambda name: Path(name).resolve())
    parser.add_argument("pages", nargs="*", type=Path)
    parser.add_argument("--pictures", action="store_true")
    arguments = parser.parse_args()
    failures = []
    for page in arguments.pages or sorted(PAGES.glob("*.md")):
        failures += run_page(page, arguments.perifrac, arguments.pictures)
    print("\n".join(failures) or "every command of the tutorials does what its page says")
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
