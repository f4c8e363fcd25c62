"""Sudden and long steps: windows, loads, drainage, shut-in, injection at a hundred times the rate."""
import math
import os

import numpy

from case import Case, Figure, rise
from runs import CONFIGS, HERE
from stiffness import (HEIGHT, ITERATED, Rock, diffusion, flow_integrators, measure_column,
                       measure_diffusion, windows)

GROUP = "Steps"
COLUMN, SLAB = os.path.join(HERE, "column.yaml"), os.path.join(HERE, "diffusion.yaml")


def drained(x, time):
    """Part of a pressure step that is left at x from the face, after c t / L^2 = `time`."""
    if time <= 0.0:
        return numpy.ones_like(x)
    modes = (numpy.arange(2000) + 0.5) * math.pi
    return numpy.array([numpy.sum(2.0 / modes * numpy.sin(modes * one) * numpy.exp(-modes**2 * time))
                        for one in x])


def long_windows():
    """Windows of 1e-3 to 1e3 of the diffusion time: ten of each, all of one length."""
    rock = Rock()
    for part in (1e-3, 1e-2, 1e-1, 1.0, 10.0, 1e3):
        window = part * rock.time
        settings = {**rock.settings, "time.end": 10 * window, "output.times": f"[{window}, {2 * window}]",
                    "coupling.window.first": window, "coupling.window.largest": window}
        # Before diffusion has come three spacings far no lattice resolves it; windows of a tenth of
        # the diffusion time and more are first order, and exact again where all has drained.
        limit = 0.1 if part < 1e-2 else 0.05 if part < 1e-1 or part >= 1.0 else 0.1
        for modules, words in {**flow_integrators(), "iterated": ITERATED}.items():
            if modules == "explicit" and part > 10.0:
                continue  # millions of steps
            yield Case(GROUP, f"windows of {part:g} of the diffusion time",
                       f"quasi_static, darcy {modules}", COLUMN, {**settings, **words},
                       measure_long(rock, limit))


def measure_long(rock, limit):
    def measure(run):
        bounds, accuracy = measure_column(rock, limit)(run)
        return [figure for figure in bounds if figure.name != "open energy"], accuracy
    return measure


def whole_run_windows():
    """One window for all there is to simulate, and two, and five."""
    rock = Rock()
    for count in (1, 2, 5):
        end = 0.5 * rock.time
        settings = {**rock.settings, "time.end": end, "coupling.window.first": end / count,
                    "coupling.window.largest": end / count}
        for modules, words in {**flow_integrators(), "iterated": ITERATED}.items():
            yield Case(GROUP, f"the whole run in {count} window{'s' * (count > 1)}",
                       f"quasi_static, darcy {modules}", COLUMN, {**settings, **words},
                       measure_long(rock, 0.1))
        slab = {**diffusion(), "output.times": "[]"}
        for modules, words in flow_integrators().items():
            yield Case(GROUP, f"the whole run in {count} window{'s' * (count > 1)}", f"darcy {modules}", SLAB,
                       {**slab, "coupling.window.first": slab["time.end"] / count,
                        "coupling.window.largest": slab["time.end"] / count, **words}, measure_diffusion)


def sudden(rock, start):
    """A schedule that jumps from 0 to 1 within a millionth of the diffusion time."""
    return f"[{start!r}, {start + 1e-6 * rock.time!r}]"


def sudden_load():
    rock = Rock()
    start = 0.1 * rock.time
    times = [start + t * rock.time for t in (0.05, 0.1, 0.2, 0.5)]
    settings = {**rock.settings, **windows(times[-1], times),
                "solid.boundary.top.schedule.times": sudden(rock, start),
                "solid.boundary.top.schedule.factors": "[0, 1]"}

    def measure(run):
        errors, overshoot = [], 0.0
        for frame in run.frames:
            exact = drained((HEIGHT - frame["x"][:, 1]) / HEIGHT, (frame["time"] - start) / rock.time)
            part = frame["pore_pressure"] / rock.undrained
            overshoot = max(overshoot, part.max() - 1.0, -part.min())
            if frame["time"] > start:
                errors.append(numpy.abs(part - exact).max())
        quiet = numpy.abs(run.history["energy_stored"][run.history["time"] < start]).max()
        return ([Figure("overshoot", overshoot, 0.02), Figure("mass error", run.mass_error, 1e-12),
                 Figure("energy before the load", quiet / run.history["energy_stored"].max(), 1e-12)],
                [Figure("pressure error", max(errors), 0.05)])

    for modules, words in {**flow_integrators(), "iterated": ITERATED}.items():
        yield Case(GROUP, "sudden load", f"quasi_static, darcy {modules}", COLUMN,
                   {**settings, **words}, measure)


def sudden_drainage():
    """A slab under pressure, whose face is let go at once."""
    settings = diffusion()
    scale = settings["time.end"] / 0.5
    start = 0.1 * scale
    times = [start + t * scale for t in (0.05, 0.1, 0.2, 0.5)]
    settings.update({**windows(times[-1], times), "pore_flow.boundary.left.pressure": 1e6,
                     "pore_flow.boundary.left.schedule.times": f"[{start!r}, {start + 1e-6 * scale!r}]",
                     "pore_flow.boundary.left.schedule.factors": "[1, 0]"})

    def measure(run):
        errors, overshoot = [], 0.0
        for frame in run.frames:
            part = frame["pore_pressure"] / 1e6
            overshoot = max(overshoot, part.max() - 1.0, -part.min())
            exact = drained(frame["x"][:, 0] / HEIGHT, (frame["time"] - start) / scale)
            errors.append(numpy.abs(part - exact).max())
        after = run.history["time"] >= start
        return ([Figure("overshoot", overshoot, 0.02), Figure("mass error", run.mass_error, 1e-12),
                 Figure("rise of energy", rise(run.history["energy_stored"][after]), 1e-12)],
                [Figure("pressure error", max(errors), 0.01)])

    for operator in ("conservative", "bond"):
        for modules, words in flow_integrators().items():
            yield Case(GROUP, "sudden drainage", f"darcy {operator} {modules}",
                       os.path.join(HERE, "released.yaml"),
                       {**settings, **words, "pore_flow.operator": operator}, measure)


def pumped(rate, stop, fluid=2.2e9):
    """A sealed slit that is pumped up until `stop` [s]: what is in it is then under one pressure."""
    return {"crack_fluid.inlets[0].rate": rate, "crack_fluid.bulk_modulus": fluid,
            "crack_fluid.inlets[0].schedule.times": f"[{stop!r}, {stop * 1.000001!r}]",
            "crack_fluid.inlets[0].schedule.factors": "[1, 0]"}


def shut_in():
    length, width, stop = math.hypot(0.04, 0.02), 50e-6, 0.05
    for name, rate in (("sudden shut-in", 1e-8), ("injection at 100 times the rate, shut in", 1e-6)):
        for fluid in (22e6, 2.2e9):
            exact = rate * stop / (length * width) * fluid

            def measure(run, exact=exact):
                rising = run.history["time"] <= stop
                mean = run.history["mean_crack_pressure"]
                jump = numpy.abs(numpy.diff(mean[~rising])).max() / exact
                return ([Figure("mass error", run.mass_error, 1e-12),
                         Figure("change of mean pressure after shut-in", jump, 1e-3)],
                        [Figure("pressure error", abs(mean[-1] / exact - 1.0), 0.01),
                         Figure("pressure at the inlet off the mean",
                                abs(run.last("inlet_pump_pressure") - mean[-1]) / exact, 0.01)])

            yield Case(GROUP, name, f"network, fluid bulk modulus {fluid / 1e9:g} GPa",
                       os.path.join(HERE, "sealed_slit.yaml"), pumped(rate, stop, fluid), measure)


def cases():
    yield from whole_run_windows()
    yield from long_windows()
    yield from sudden_load()
    yield from sudden_drainage()
    yield from shut_in()
    yield from fracture()


def fracture():
    """A crack driven by a pump that stops at once, also at a hundred times the rate."""
    scene = os.path.join(CONFIGS, "shut_in.yaml")
    for factor in (1, 100):
        end = 0.08 / factor

        def measure(run, fine):
            length = run.history["crack_length"]
            opened = [one.history["mean_crack_pressure"].max() for one in (run, fine)]
            return ([Figure("mass error", run.mass_error, 1e-12),
                     Figure("shrinking of the crack", float(max(0.0, -numpy.diff(length).min())), 0.0)],
                    [Figure("length against half the window",
                            abs(length[-1] / fine.last("crack_length") - 1.0), 0.05),
                     Figure("largest pressure against half the window",
                            float(abs(opened[0] / opened[1] - 1.0)), 0.1)])
        settings = {"body.spacing": 0.005, "crack_fluid.inlets[0].rate": 1.6e-4 * factor, "time.end": end,
                    "output.interval": end / 4, "coupling.window.largest": end / 160,
                    "crack_fluid.inlets[0].schedule.times":
                        f"[{end / 4}, {end / 4 * 1.005}, {end / 2}, {end / 2 * 1.0025}]"}
        yield Case(GROUP, f"injection at {factor} times the rate, shut-in and flow-back" if factor > 1 else
                   "shut-in and flow-back", "quasi_static, energy_release, network", scene, settings, measure,
                   fine={**settings, "coupling.window.largest": end / 320})
