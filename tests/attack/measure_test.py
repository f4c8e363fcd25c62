#!/usr/bin/python3
"""The attack's own measure: made-up histories of which it is known whether they differ."""
import os
import sys
import types

import numpy

sys.path[:0] = [os.path.join(os.path.dirname(os.path.abspath(__file__)), *folder) for folder in ((), (os.pardir,))]
import answers  # noqa: E402

WATER = {"fluid": {"bulk_modulus": 1e6, "density": 1000.0}}
FALLING = {"gravity": [0.0, -10.0], "fluid": {"bulk_modulus": 1e6, "blocks": [{"from": [0.0, 1.0], "to": [1.0, 3.0]}]}}
ANSWER = ("last_spacing", "mean")


def history(**columns):
    answer = types.SimpleNamespace(time=numpy.array([0.0, 1.0]))
    answer.columns = {"time": answer.time, **{name.replace("__", " at "): numpy.array(column) for name, column in columns.items()}}
    for name in ANSWER:
        setattr(answer, name, types.MethodType(getattr(answers.Answer, name), answer))
    return answer


def far(one, other, pressure):
    """Of two runs of one metre of water whose speed ends at one and at the other [m/s]."""
    return answers.farthest(*(history(fluid_velocity__p0=[0.0, speed], fluid_pressure__size0=[pressure, pressure])
                              for speed in (one, other)), WATER)[0]


def main():
    wrong = []
    if far(0.002, 0.010, 1e4) > 0.05:  # water at rest under its weight: 0.316 m/s would be sound of 10 kPa
        wrong.append("what sound stirs in water at rest counts as flow")
    if not far(0.5, 1.0, 1e3) > 0.4:
        wrong.append("flow faster than sound of its pressure does not count")
    # A tonne a metre, two metres high: 20 kJ.
    for difference, counts in ((100.0, False), (5e3, True)):
        runs = (history(energy_stored=[0.0, 1e3 + more], fluid_mass_stored=[1e3, 1e3]) for more in (0.0, difference))
        if (answers.farthest(*runs, FALLING)[0] > 0.05) != counts:
            wrong.append(f"{difference} J of water that falls: counts ought to be {counts}")
    # A rock of 0.02 m^2 under 1 MPa: 20 kJ by a strain of 1.
    rock = {"body": {"size": [0.1, 0.2]}}
    for energy, counts in ((6e-17, False), (1e-7, True)):
        runs = (history(energy_gained=[0.0, more], effective_stress_xx__size0=[-1e6, -1e6]) for more in (0.0, energy))
        if (answers.farthest(*runs, rock)[0] > 0.05) != counts:
            wrong.append(f"{energy} J of a rock under stress: counts ought to be {counts}")
    for leaked, counts in ((6e-10, False), (6e-7, True)):
        runs = (history(crack_volume=[0.0, 1e-6], leak_off_volume=[0.0, volume]) for volume in (1e-11, leaked))
        if (answers.farthest(*runs, {})[0] > 0.05) != counts:
            wrong.append(f"a leak-off of {leaked} of 1e-6: counts ought to be {counts}")
    sys.exit("\n".join(wrong) if wrong else 0)


if __name__ == "__main__":
    main()
