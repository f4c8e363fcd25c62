#!/usr/bin/python3
"""The tests of cracks in builds for other instruction sets than this machine's own.

Rounding differs from one to the next, and cracks choose: where to begin, which tip goes first,
which window is cut. No such choice may hang on rounding.
"""
import argparse
import os
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# Programs, and which of their tests.
TESTS = {"unit_fracture": "*", "unit_crack_fluid": "*", "verification_fracture": "*", "verification_slow": "*Kgd*:HfStorage*"}
# A flag of /proc/cpuinfo that says whether the machine has the set.
SETS = {"x86-64-v3": "avx2", "x86-64-v4": "avx512vl"}


def machine_flags():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("flags"):
            return set(line.split())
    return set()


def run(*words):
    print("$", *words, flush=True)
    return subprocess.run([str(word) for word in words], cwd=SOURCE).returncode == 0


def tests_pass(instructions, folder):
    build = folder / instructions
    jobs = os.cpu_count()
    return (run("cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                "-DPERIFRAC_NATIVE=OFF", f"-DPERIFRAC_INSTRUCTIONS={instructions}")
            and run("cmake", "--build", build, "--parallel", jobs, "--target", *TESTS)
            and all([run(build / "bin" / target, "--gtest_brief=1", f"--gtest_filter={tests}")
                     for target, tests in TESTS.items()]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="of the builds")
    arguments = parser.parse_args()
    flags = machine_flags()
    sets = [name for name, flag in SETS.items() if flag in flags]
    if not sets:
        sys.exit("this machine has none of " + ", ".join(SETS))
    failed = [name for name in sets if not tests_pass(name, arguments.folder)]
    if failed:
        sys.exit("tests fail with the instructions of " + ", ".join(failed))


if __name__ == "__main__":
    main()
