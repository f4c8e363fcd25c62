#!/usr/bin/python3
"""Changes the physics, one patch at a time, and sees that the test named for it fails.

Usage: mutants.py [--build FOLDER] [NAME ...]

Each NAME.patch of this folder says what it changes and which test is to notice:

    What: the physics that is changed
    Test: gtest BINARY FILTER   or   verification SCRIPT CASE

The tree is copied to FOLDER (build/mutants by default), where each patch is applied, what its test needs
is built, and the test is run. It must pass before any patch, and fail with its own.
"""
import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def header(patch):
    lines = dict(line.split(": ", 1) for line in patch.read_text(encoding="utf-8").split("\n\n", 1)[0].splitlines())
    return lines["What"], lines["Test"].split(maxsplit=2)


def run(*command, where, **options):
    return subprocess.run(command, cwd=where, check=False, **options)


def copy_tree(to):
    """What git knows and what is new: times of files stay, so that only what changed is built anew."""
    names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.splitlines()
    for name in names:
        source, target = ROOT / name, to / name
        if not source.is_file():
            continue
        if target.exists() and target.read_bytes() == source.read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        shutil.copymode(source, target)


def build(tree, test):
    target = test[1] if test[0] == "gtest" else "perifrac"
    # A tree that does not build must not pass for one that is caught.
    if run("cmake", "--build", "build/release", "--target", target, where=tree, stdout=subprocess.DEVNULL).returncode:
        sys.exit(f"{target} does not build")


def passes(tree, test):
    kind, name, which = test
    programs = tree / "build" / "release" / "bin"
    command = [programs / name, f"--gtest_filter={which}"]
    if kind == "verification":
        command = ["/usr/bin/python3", "-B", tree / "tests" / "verification" / f"{name}.py", programs / "perifrac", which]
    return run(*command, where=tree, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", default=ROOT / "build" / "mutants", type=Path)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    patches = [patch for patch in sorted(HERE.glob("*.patch"))
               if not arguments.names or patch.stem in arguments.names]
    tree = arguments.build.resolve()
    copy_tree(tree)
    run("cmake", "--preset", "release", "--log-level=WARNING", where=tree, stdout=subprocess.DEVNULL)
    wrong = []
    for test in sorted({tuple(header(patch)[1]) for patch in patches}):
        build(tree, test)
        if not passes(tree, test):
            wrong.append(f"{' '.join(test)} fails without any change")
    for patch in patches:
        what, test = header(patch)
        if run("patch", "-p1", "-s", "-i", patch, where=tree).returncode:
            sys.exit(f"{patch.name} no longer fits the tree")
        build(tree, test)
        is_caught = not passes(tree, test)
        run("patch", "-p1", "-s", "-R", "-i", patch, where=tree)
        print(f"{'caught' if is_caught else 'MISSED':8}{patch.stem:24}{what}", flush=True)
        if not is_caught:
            wrong.append(f"{patch.stem} is not noticed by {' '.join(test)}")
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
