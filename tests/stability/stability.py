#!/usr/bin/python3
"""Runs hard cases in many combinations of modules, and holds each to a bound and to
an accuracy.

Usage: stability.py PERIFRAC [--page FILE] [--quick] [--only WORD]

Fails where a case does not do what is expected of it: a default scheme to hold, a scheme for
comparison to fail. --quick runs a few cases, --only those whose name or modules hold WORD; --page
writes what was found as a page.
"""
import argparse
import functools
import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import distinct
import geometry
import long_runs
import steps
import stiffness
from case import Outcome
from page import page
from runs import run


QUICK = {
    ("permeability 1e-20 m², fixed time", "darcy conservative cvode"), ("drainage of a slab", "darcy bond explicit"),
    ("permeability 1e-8 m², fixed time", "quasi_static, darcy cvode"),
    ("drainage of a slab", "darcy nested explicit, smoothing boundary"),
    ("fluid bulk modulus 1e+06 GPa", "quasi_static, darcy cvode"),
    ("Poisson ratio 0.499", "quasi_static, darcy explicit"), ("sudden load", "quasi_static, darcy cvode"),
    ("windows of 1 of the diffusion time", "quasi_static, darcy cvode"),
    ("sudden shut-in", "network, fluid bulk modulus 2.2 GPa"),
    ("crack that splits the body", "darcy conservative explicit"), ("isolated point", "quasi_static"),
    ("spacing that jumps by two", "quasi_static"), ("spacing that jumps by two", "darcy conservative explicit"),
    ("families with two bonds", "dynamic"), ("jitter 30 %", "darcy conservative cvode, seed 1"),
    ("source in nearly undrained rock, fluid of 1e6 GPa, c t / Δx² = 0.01", "quasi_static, darcy cvode"),
}

NOTHING_TO_COMPARE = -1  # in place of an exit code


@functools.lru_cache(maxsize=None)
def cached_run(perifrac, scene, settings):
    return run(perifrac, scene, dict(settings))


def fine_run(perifrac, case):
    return cached_run(perifrac, case.scene, tuple(case.fine.items()))


def outcome(perifrac, case):
    begin = time.monotonic()
    one = run(perifrac, case.scene, case.settings)
    bounds, accuracy, complaint, code = [], [], "" if one.done else one.complaint, one.code
    if one.done and not case.fine:
        bounds, accuracy = case.measure(one)
    elif one.done:
        fine = fine_run(perifrac, case)
        if fine.done:
            bounds, accuracy = case.measure(one, fine)
        else:  # says nothing of the case, whatever is expected of it
            complaint, code = f"the finer run: {fine.complaint}", NOTHING_TO_COMPARE
    return Outcome(case, bounds, accuracy, complaint, code, time.monotonic() - begin, "warning" in one.said)


def line(found):
    case = found.case
    verdict = "as expected" if found.as_expected else "NOT AS EXPECTED"
    figures = ", ".join(str(figure) for figure in found.bounds + found.accuracy) or found.complaint
    return f"{verdict}  {case.group}: {case.name}; {case.modules}: {figures}  ({found.seconds:.1f} s)"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("perifrac")
    parser.add_argument("--page")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only")
    arguments = parser.parse_args()
    perifrac = os.path.abspath(arguments.perifrac)
    cases = [case for group in (stiffness, steps, geometry, long_runs) for case in group.cases()]
    if arguments.quick:
        cases = [case for case in cases if (case.name, case.modules) in QUICK]
    if arguments.only:
        cases = [case for case in cases if arguments.only in f"{case.group}: {case.name}; {case.modules}"]
    found = []
    with ThreadPoolExecutor(2) as pool:
        for one in pool.map(lambda case: outcome(perifrac, case), cases):
            found.append(one)
            if sys.stdout.isatty() or not one.as_expected or arguments.only:
                print(line(one), flush=True)
    if arguments.page:
        with open(arguments.page, "w", encoding="utf-8") as file:
            file.write(page(found, distinct.count([one.case for one in found], perifrac)))
    wrong = [one for one in found if not one.as_expected]
    print(f"{len(found)} cases, {len(wrong)} not as expected")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
