"""A million explicit steps, and the undrained limit, where pressure may change sign from point to point."""
import os

import numpy

from case import Case, Figure, zigzag
from runs import HERE
from stiffness import Rock, measure_column

GROUP = "Long runs and limits"
MILLION = 1_000_000


def steps_of(run):
    return [m["statistics"].get("integrator_steps", 0) for m in run.summary["modules"]]


def enough_steps(run):
    return Figure("steps short of a million", float(max(0.0, MILLION - max(steps_of(run)))), 0.0)


def measure_at_rest(run):
    """Sealed rock evens out and stays so."""
    stored = run.history["fluid_mass_stored"]
    last = run.frames[-1]["pore_pressure"]
    mean = run.frames[0]["pore_pressure"].mean()
    return ([Figure("drift of mass", float(numpy.abs(stored - stored[0]).max() / abs(stored[0])), 1e-12),
             Figure("rise of energy", float(max(0.0, numpy.diff(run.history["energy_stored"]).max()) /
                                            run.history["energy_stored"][0]), 1e-12), enough_steps(run)],
            [Figure("distance from the mean pressure", float(numpy.abs(last / mean - 1.0).max()), 1e-9)])


def measure_swing(run):
    """A plate that was let go swings for ever: energy wanders with the step and does not drift."""
    free = run.history["time"] > 0.02 * run.history["time"][-1]
    energy = run.history["energy_stored"][free]
    tenth = len(energy) // 10
    drift = abs(energy[-tenth:].mean() / energy[:tenth].mean() - 1.0)
    return ([Figure("drift of energy", float(drift), 1e-3), enough_steps(run),
             Figure("spread of energy", float(energy.max() / energy.min() - 1.0), 0.2)],
            [Figure("open energy at the end", run.summary["ledger"]["energy_error"], 0.1)])


def measure_coupled(run):
    return ([Figure("mass error", run.mass_error, 1e-12), enough_steps(run),
             Figure("open energy", run.summary["ledger"]["energy_error"], 0.02)],
            [Figure("pressure error at the end", abs(run.errors("pressure_error")), 0.05)])


def million_cases():
    yield Case(GROUP, "a million steps of sealed rock", "darcy conservative explicit",
               os.path.join(HERE, "sealed.yaml"), {}, measure_at_rest)
    yield Case(GROUP, "a million steps of sealed rock", "darcy bond explicit",
               os.path.join(HERE, "sealed.yaml"), {"pore_flow.operator": "bond", "time.end": 22000},
               measure_at_rest)
    for material in ("linear_exact", "lps"):
        yield Case(GROUP, "a million steps of a plate that swings", f"dynamic, {material}",
                   os.path.join(HERE, "swing.yaml"), {"solid.material.type": material}, measure_swing)


def measure_undrained(rock, largest, error):
    def measure(run):
        found = []
        for frame in run.frames:
            inside = zigzag(frame["pore_pressure"], frame["x"])
            found.append(inside * numpy.abs(frame["pore_pressure"]).max() / rock.undrained)
        bounds, accuracy = measure_column(rock, error)(run)
        return ([Figure("alternating part of the pressure", float(max(found)), largest),
                 *(figure for figure in bounds if figure.name == "mass error")], accuracy)
    return measure


def undrained_cases():
    """Just after the load, before diffusion has come one spacing far."""
    for name, rock in (("storage of water", Rock()), ("storage 1e-10 of water's", Rock(fluid=2.2e19))):
        for times in ((1e-6, 1e-5, 1e-4), (3e-4, 1e-3, 3e-3)):
            for modules, words in {"cvode": {}, "explicit": {"pore_flow.integrator.type": "explicit"},
                                   "bond flow": {"pore_flow.operator": "bond"}}.items():
                settings = {**rock.column(times=times), **words,
                            "coupling.window.first": times[0] / 20 * rock.time}
                yield Case(GROUP, f"undrained, {name}, c t / Δx² to {times[-1] * 400:g}",
                           f"quasi_static, darcy {modules}", os.path.join(HERE, "column.yaml"), settings,
                           measure_undrained(rock, 0.05, 0.15))


def measure_injected(run, fine, most_passes=100):
    """Pressure falls off from the source and nowhere below what it was."""
    last = run.frames[-1]["pore_pressure"]
    means = [float(one.frames[-1]["pore_pressure"].mean()) for one in (run, fine)]
    return ([Figure("undershoot over the largest pressure", float(max(0.0, -last.min()) / last.max()), 0.02),
             Figure("mass error", run.mass_error, 1e-12),
             Figure("open energy", run.summary["ledger"]["energy_error"], 0.02),
             Figure("passes in a window", float(run.summary["counts"]["most_passes"]), most_passes)],
            [Figure("mean pressure against half the spacing", abs(means[0] / means[1] - 1.0), 0.05)])


def measure_stabilised(run, fine):
    """The modules agree at once, however stiff the fluid."""
    return measure_injected(run, fine, most_passes=8)


PLAIN = {"pore_flow.undrained_stabilisation": 0}  # stabilised by default


def injected_cases():
    """Fluid forced into one point: the sharpest field there is, before diffusion smooths it."""
    flows = {"cvode": {}, "explicit": {"pore_flow.integrator.type": "explicit"}}
    more = {"cvode krylov": {"pore_flow.integrator.linear_solver": "krylov"},
            "bond flow": {"pore_flow.operator": "bond"}}
    for name, rock in (("fluid of 2.2 GPa", Rock()), ("fluid of 100 GPa", Rock(fluid=1e11)),
                       ("fluid of 1e6 GPa", Rock(fluid=1e15))):
        for part in (0.01, 0.1, 1.0, 10.0):
            settings = {"pore_flow.fluid.bulk_modulus": rock.settings["pore_flow.fluid.bulk_modulus"],
                        "time.end": part / rock.diffusivity}
            known = "nearly undrained pressure without stabilisation" if part < 1.0 else ""
            for modules, words in {**flows, **more}.items():
                yield injected_case(f"{name}, c t / Δx² = {part:g}", f"darcy {modules}", settings, words)
            for modules, words in flows.items():
                yield injected_case(f"{name}, c t / Δx² = {part:g}", f"darcy {modules}, not stabilised", settings,
                                    {**words, **PLAIN}, known)


def injected_case(name, flow, settings, words, known=""):
    measure = measure_injected if "not stabilised" in flow else measure_stabilised
    return Case(GROUP, f"source in nearly undrained rock, {name}", f"quasi_static, {flow}",
                os.path.join(HERE, "injected.yaml"), {**settings, **words}, measure, known=known,
                fine={**settings, "body.size": "[15 m, 15 m]", "body.spacing": 0.5})


def measure_swing_at_a_step(run, implicit):
    far = numpy.abs(run.frames[-1]["pore_pressure"] - implicit.frames[-1]["pore_pressure"]).max()
    return ([Figure("mass error", run.mass_error, 1e-12),
             Figure("open energy", run.summary["ledger"]["energy_error"], 0.02)],
            [Figure("pressure against cvode", float(far / implicit.frames[-1]["pore_pressure"].max()), 2e-3)])


def one_step_cases():
    """The same source for long, explicit, in windows that hold just one step at its limit, or two."""
    rock = Rock()
    for window, words in ((0.45, PLAIN), (0.8, PLAIN), (0.7, {}), (1.2, {})):
        settings = {**words, "time.end": 30.0 / rock.diffusivity, "coupling.window.first": 1e-3 / rock.diffusivity,
                    "coupling.window.largest": window / rock.diffusivity}
        yield Case(GROUP, f"source in nearly undrained rock, windows of {window:g} Δx²/c",
                   "quasi_static, darcy explicit" + (", not stabilised" if words else ""),
                   os.path.join(HERE, "injected.yaml"), {**settings, "pore_flow.integrator.type": "explicit"},
                   measure_swing_at_a_step, fine=settings)


def cases():
    yield from million_cases()
    yield from undrained_cases()
    yield from injected_cases()
    yield from one_step_cases()
