#!/usr/bin/python3
"""Runs `perifrac check` and `perifrac run` on one bad scene and compares what they say.

Usage: check.py PERIFRAC CASE.yaml

The case begins with comments:
  # expect: MESSAGE     the line that must come on stderr, with {file} for the scene's name; of a scene with several
                        mistakes there are several, in their order
  # args: ARGUMENTS     further arguments, if any
  # scene: NAME         the scene to ask for, if not the case itself
Files that cases name are in `clouds`. Exit code 2, nothing on stdout and no file written are expected of both verbs.
"""
import os
import shlex
import shutil
import subprocess
import sys
import tempfile


def read_header(case):
    header = {}
    with open(case, encoding="utf-8") as lines:
        for line in lines:
            name, colon, value = line.removeprefix("# ").partition(": ")
            if not line.startswith("# ") or not colon or name not in ("expect", "args", "scene"):
                break
            value = value.rstrip("\n")
            header[name] = f"{header[name]}\n{value}" if name == "expect" and name in header else value
    return header


def complaints(perifrac, verb, case, header):
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(case, folder)
        shutil.copytree(os.path.join(os.path.dirname(case), "clouds"), os.path.join(folder, "clouds"))
        before = sorted(os.walk(folder))
        scene = header.get("scene", os.path.basename(case))
        command = [perifrac, verb, scene] + shlex.split(header.get("args", ""))
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=900)
        expected = header["expect"].replace("{file}", scene) + "\n"
        if done.returncode != 2:
            yield f"exit code {done.returncode}, expected 2"
        if done.stderr != expected:
            yield f"stderr:   {done.stderr}\n  expected: {expected}"
        if done.stdout:
            yield f"stdout is not empty: {done.stdout}"
        if sorted(os.walk(folder)) != before:
            yield "files were written"


def main():
    perifrac, case = os.path.abspath(sys.argv[1]), sys.argv[2]
    header = read_header(case)
    if "expect" not in header:
        sys.exit(f"{case}: no line '# expect: MESSAGE' at the top")
    wrong = [f"{verb}: {complaint}" for verb in ("check", "run")
             for complaint in complaints(perifrac, verb, case, header)]
    sys.exit("\n".join(wrong) if wrong else 0)


if __name__ == "__main__":
    main()
