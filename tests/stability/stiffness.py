"""Stiff materials: permeability, fluid, storage, Biot coefficient, Poisson ratio, viscosity, density."""
import functools
import math
import os

from case import Case, Figure, rise
from runs import CONFIGS, HERE

GROUP = "Stiffness"
LOAD = 1e6  # Pa, of column.yaml
HEIGHT = 20.0  # m, of column.yaml, and the length of diffusion.yaml
TIMES = (0.05, 0.1, 0.2, 0.5)  # c t / H^2


def flow_integrators():
    return {"cvode": {}, "cvode krylov": {"pore_flow.integrator.linear_solver": "krylov"},
            "explicit": {"pore_flow.integrator.type": "explicit"}}


def windows(end, times):
    """Settings for outputs at `times`, windows from 1e-5 of the end to a fiftieth of it."""
    return {"time.end": end, "output.times": f"[{', '.join(repr(t) for t in times if t < end)}]"}


def diffusion(permeability=1e-12, viscosity=1e-3, bulk_modulus=2.2e9, porosity=0.1, times=TIMES):
    scale = HEIGHT**2 * porosity / bulk_modulus * viscosity / permeability
    return {"pore_flow.permeability": permeability, "pore_flow.fluid.viscosity": viscosity,
            "pore_flow.fluid.bulk_modulus": bulk_modulus, "pore_flow.porosity": porosity,
            **windows(times[-1] * scale, [t * scale for t in times])}


def measure_diffusion(run, largest_error=0.01, start=1e6):
    pressures = [frame["pore_pressure"] for frame in run.frames]
    overshoot = max(0.0, *(max(p.max() - start, -p.min()) for p in pressures)) / start
    bounds = [Figure("overshoot", overshoot, 0.02),
              Figure("rise of energy", rise(run.history["energy_stored"]), 1e-12),
              Figure("mass error", run.mass_error, 1e-12)]
    return bounds, [Figure("pressure error", run.errors("pressure_error"), largest_error)]


class Rock:
    """The column's material, and what follows from it."""

    def __init__(self, bulk=5e9, shear=3e9, porosity=0.1, fluid=2.2e9, biot=1.0, grains=None,
                 permeability=1e-12, viscosity=1e-3):
        self.settings = {
            "solid.material.bulk_modulus": bulk, "solid.material.shear_modulus": shear,
            "pore_flow.porosity": porosity, "pore_flow.fluid.bulk_modulus": fluid,
            "pore_flow.biot_coefficient": biot, "pore_flow.permeability": permeability,
            "pore_flow.fluid.viscosity": viscosity}
        if grains:
            self.settings["pore_flow.grain_bulk_modulus"] = grains
        storage = porosity / fluid + ((biot - porosity) / grains if grains else 0.0)
        modulus = bulk + 4.0 / 3.0 * shear
        self.strength = biot**2 / storage / bulk
        self.undrained = biot / modulus / (storage + biot**2 / modulus) * LOAD  # Pa
        self.diffusivity = permeability / viscosity / (storage + biot**2 / modulus)
        self.time = HEIGHT**2 / self.diffusivity

    def column(self, times=TIMES):
        return {**self.settings, **windows(times[-1] * self.time, [t * self.time for t in times])}


def measure_column(rock, largest_error=0.03, open_energy=0.02, overshoot_limit=0.02):
    def measure(run):
        pressures = [frame["pore_pressure"] for frame in run.frames]
        overshoot = max(0.0, *(max(p.max() - rock.undrained, -p.min()) for p in pressures)) / rock.undrained
        bounds = [Figure("overshoot", overshoot, overshoot_limit),
                  Figure("open energy", run.summary["ledger"]["energy_error"], open_energy),
                  Figure("mass error", run.mass_error, 1e-12)]
        return bounds, [Figure("pressure error", run.errors("pressure_error"), largest_error)]
    return measure


ITERATED = {"coupling.iterations.max": 40}
COLUMN = {
    "cvode": {}, "cvode krylov": {"pore_flow.integrator.linear_solver": "krylov"},
    "explicit": {"pore_flow.integrator.type": "explicit"},
    "bond flow": {"pore_flow.operator": "bond"},
    "iterated, anderson": ITERATED,
    "iterated, aitken": {**ITERATED, "coupling.acceleration": "aitken"},
    "iterated, plain": {**ITERATED, "coupling.acceleration": "none"},
    "explicit, iterated": {**ITERATED, "pore_flow.integrator.type": "explicit"},
}


# Coupling strength beyond which plain iteration, where storage is not stabilised, needs more passes
# than it is given.
STRONG = 100.0


def column_cases(name, rock, words=COLUMN):
    scene = os.path.join(HERE, "column.yaml")
    for modules, settings in words.items():
        yield Case(GROUP, name, f"quasi_static, darcy {modules}", scene,
                   {**rock.column(), **settings}, measure_column(rock))
        if modules == "iterated, plain" and rock.strength > STRONG:
            yield Case(GROUP, name, f"quasi_static, darcy {modules}, not stabilised", scene,
                       {**rock.column(), **settings, "coupling.window.retries": 0,
                        "pore_flow.undrained_stabilisation": 0}, measure_column(rock),
                       known="iterations without acceleration")


def dynamic(rock, damping):
    """The column with inertia, loaded over a time that is long for waves and short for flow."""
    return {"solid.type": "dynamic", "solid.density": 2000, "solid.damping": damping,
            "solid.boundary.top.schedule.ramp": 0.003 * rock.time,
            "coupling.window.first": rock.time / 5000, "coupling.window.largest": rock.time / 1000}


def dynamic_cases():
    scene = os.path.join(HERE, "column.yaml")
    for fluid, permeability in ((22e6, 1e-10), (2.2e9, 2e-12)):
        rock = Rock(fluid=fluid, permeability=permeability)
        for modules, words in flow_integrators().items():
            yield Case(GROUP, f"fluid bulk modulus {fluid / 1e9:g} GPa", f"dynamic, darcy {modules}", scene,
                       {**rock.column(), **dynamic(rock, 100.0), **words}, measure_column(rock))
    explicit, iterated = {"pore_flow.integrator.type": "explicit"}, {"coupling.iterations.max": 20}
    for fluid in (1e10, 1e11):
        rock = Rock(fluid=fluid, permeability=2e-12)
        for modules, words, known in (
                ("cvode, iterated", iterated, ""),
                ("cvode, one pass", {}, ""),
                ("explicit, one pass", explicit, ""),
                ("explicit, iterated", {**explicit, **iterated},
                 "iterations of the undrained split do not close over explicit sub-steps")):
            yield Case(GROUP, f"fluid bulk modulus {fluid / 1e9:g} GPa", f"dynamic, darcy {modules}", scene,
                       {**rock.column(times=(0.05, 0.1)), **dynamic(rock, 100.0), **words},
                       measure_column(rock), known=known, ours=bool(known))


def measure_reference(columns):
    """`columns`: of the reference's table, with what each may be at most."""
    def measure(run):
        found = [Figure("open energy", run.summary["ledger"]["energy_error"], 0.02),
                 Figure("mass error", run.mass_error, 1e-12)]
        return found, [Figure(name.replace("_", " "), run.errors(name), limit)
                       for name, limit in columns.items()]
    return measure


def slit_cases():
    """Poiseuille's flow between a high and a low pressure, after ten times what it takes to spread."""
    for viscosity in (1e-6, 1e-3, 1.0):
        for fluid in (22e6, 2.2e9, 1e15):
            spread = 12.0 * viscosity * 0.045**2 / (50e-6**2 * fluid)
            end = max(0.1, 10.0 * spread)
            settings = {"crack_fluid.viscosity": viscosity, "crack_fluid.bulk_modulus": fluid,
                        "time.end": end, "output.interval": end / 5, "coupling.window.largest": end / 100}
            yield Case(GROUP, f"viscosity {viscosity:g} Pa s, fluid bulk modulus {fluid / 1e9:g} GPa",
                       "network", os.path.join(CONFIGS, "slit_flow.yaml"), settings, measure_slit)


def measure_slit(run):
    last = run.summary["reference"]["table"][-1]
    return ([Figure("mass error", run.mass_error, 1e-12)],
            [Figure("flow rate error", abs(last["flow_rate_error"]), 0.01),
             Figure("pressure error", abs(last["pressure_error"]), 0.01)])


def contrast_cases():
    for cap, below in ((1.02e-11, 1.02e-19), (1.02e-19, 1.02e-11)):
        end = 300.0 * 1.02e-12 / min(cap, below)
        settings = {"pore_flow.permeability": below, "pore_flow.regions.cap.permeability": cap,
                    **windows(end, [0.3 * end]),
                    "coupling.window.first": 1e-11 * end, "coupling.window.largest": end / 100,
                    "pore_flow.integrator.tolerance": 1e-7}
        name = "contrast 1e8, " + ("permeable over tight" if cap > below else "tight over permeable")
        for modules, words in {"one pass": {}, "iterated": ITERATED,
                               "krylov": {"pore_flow.integrator.linear_solver": "krylov"}}.items():
            yield Case(GROUP, name, f"quasi_static, darcy cvode, {modules}",
                       os.path.join(CONFIGS, "layered_column.yaml"), {**settings, **words},
                       measure_reference({"pressure_error": 0.06, "settlement_error": 0.01}))


def added_mass_cases():
    """Water on an elastic plate that is a tenth as heavy as it, as heavy, and ten times as heavy."""
    scene = os.path.join(CONFIGS, "water_on_plate.yaml")
    short = {"time.end": 0.3, "output.interval": 0.05}

    def measure(run):  # the reference is the plate at rest, after it has swung
        error = abs(run.summary["reference"]["table"][-1]["deflection_error"])
        return ([Figure("open energy", run.summary["ledger"]["energy_error"], 0.02),
                 Figure("mass error", run.mass_error, 1e-12)],
                [Figure("deflection error", error, 0.1)])

    for ratio in (10.0, 1.0, 0.1):
        yield Case(GROUP, f"density of fluid over solid {ratio:g}", "dynamic, fluid", scene,
                   {**short, "solid.density": 1000.0 / ratio}, measure)
    light = {**short, "solid.type": "quasi_static"}
    name = "density of fluid over solid infinite (no inertia)"
    yield Case(GROUP, name, "quasi_static, fluid, iterated", scene,
               {**light, "coupling.iterations.max": 20}, measure)
    yield Case(GROUP, name, "quasi_static, fluid, one pass", scene, light, measure,
               known="one pass")
    yield Case(GROUP, "density of fluid over solid 1", "dynamic, fluid, force one_sided", scene,
               {**short, "interface.force": "one_sided"}, measure, known="force one_sided")


def seepage_cases():
    """Free fluid that presses into pores from the first moment on."""
    scene = os.path.join(CONFIGS, "infiltration.yaml")
    settings = {"time.end": 10, "output.times": "[5]", "ledger.mass_error": 1}
    for fluid in (22e6, 220e6):
        words = {**settings, "fluid.bulk_modulus": fluid, "pore_flow.fluid.bulk_modulus": fluid}
        for modules, more, known in (
                ("darcy explicit, fluid", {}, ""),
                ("darcy cvode, fluid", {"pore_flow.integrator.type": "cvode"}, ""),
                ("darcy explicit, fluid, exchange paper", {"interface.exchange": "paper"}, "exchange paper")):
            yield Case(GROUP, f"seepage of free fluid of {fluid / 1e6:g} MPa", modules, scene,
                       {**words, **more}, measure_reference({"pressure_error": 0.05, "volume_error": 0.05}),
                       known=known)


def plate_cases():
    """A plate in plane strain: exact in peridynamics that is exact for linear fields."""
    exact = {"displacement_x_error": 1e-9, "displacement_y_error": 1e-9}
    for ratio in (0.0, 0.25, 0.4, 0.49, 0.499):
        settings = {"solid.material.poisson_ratio": ratio}
        scene = os.path.join(CONFIGS, "drained_plate.yaml")
        yield Case(GROUP, f"Poisson ratio {ratio:g}, dry", "quasi_static", scene, settings,
                   measure_reference(exact))
        for material in ("lps", "lps_printed"):
            yield Case(GROUP, f"Poisson ratio {ratio:g}, dry", f"quasi_static, {material}", scene,
                       {**settings, "solid.material.type": material},
                       measure_reference({name: 0.02 for name in exact}), known=f"material {material}")


def paper_cases():
    """The schemes that are there for comparison, on the same column and slab."""
    slab, column = os.path.join(HERE, "diffusion.yaml"), os.path.join(HERE, "column.yaml")
    explicit = {"pore_flow.integrator.type": "explicit", "pore_flow.operator": "nested"}
    for smoothing in ("none", "boundary", "everywhere"):
        yield Case(GROUP, "drainage of a slab", f"darcy nested explicit, smoothing {smoothing}",
                   slab, {**diffusion(), **explicit, "pore_flow.nested.smoothing": smoothing}, measure_diffusion,
                   known="nested operator")
    schemes = {
        "nested operator": explicit,
        "split drained, one pass": {"coupling.split": "drained", "coupling.window.retries": 0},
        "split drained, plain iterations": {
            **ITERATED, "coupling.split": "drained", "coupling.acceleration": "none"},
        "one pass": {"coupling.iterations.max": 1},
        "material lps": {"solid.material.type": "lps"},
        "material lps_printed": {"solid.material.type": "lps_printed"},
        "bonded layer at the drained face": {"body.boundary.top": "layer"},
    }
    for fluid in (22e6, 2.2e9, 1e11):
        rock = Rock(fluid=fluid)
        for scheme, settings in schemes.items():
            known = scheme
            if rock.strength < 1.0 / 3.0 and scheme.startswith("split") or scheme in ("one pass", "nested operator"):
                known = ""  # it is as good as any there, the nested operator since neighbours make up for its smoothing
            yield Case(GROUP, f"fluid bulk modulus {fluid / 1e9:g} GPa", f"quasi_static, darcy, {scheme}",
                       column, {**rock.column(), **settings}, measure_column(rock), known=known)


FIXED_END = 5.0  # s: a quarter of the time in which rock of 1e-12 m^2 drains
MOST_EXPLICIT = 2.3e3  # m^2/s; beyond it explicit steps are counted in millions


def is_thin(diffusivity):
    """At the first output the layer that has drained is thinner than the spacing, 1 m: it is not resolved."""
    return math.sqrt(diffusivity * 0.1 * FIXED_END) < 1.0


def walks():
    """One property from end to end of its range, all else as it is, end time and loads too: what a
    user does. From rock in which nothing moves to rock that has drained at once."""
    for decade in range(-20, -7):
        yield f"permeability 1e{decade} m², fixed time", {"permeability": 10.0**decade}
    for viscosity in (3e-6, 3e-5, 3e-4, 3e-3, 3e-2, 0.3, 3.0, 300.0):
        yield f"viscosity {viscosity:g} Pa s, fixed time", {"viscosity": viscosity}
    for fluid in (1e5, 1e7, 5e8, 1e10, 1e12):
        yield f"fluid bulk modulus {fluid / 1e9:g} GPa, fixed time", {"fluid": fluid}
    for porosity in (3e-4, 3e-3, 3e-2, 0.5):
        yield f"porosity {porosity:g}, fixed time", {"porosity": porosity}


def fixed_time_cases():
    scene = os.path.join(HERE, "diffusion.yaml")
    fixed = windows(FIXED_END, [part * FIXED_END for part in (0.1, 0.2, 0.5)])
    for name, words in walks():
        rock = Rock(**words)
        mobility = rock.settings["pore_flow.permeability"] / rock.settings["pore_flow.fluid.viscosity"]
        slab = {key: value for key, value in rock.settings.items() if key.startswith("pore_flow") and "biot" not in key}
        for modules, integrator in flow_integrators().items():
            diffusivity = mobility / (slab["pore_flow.porosity"] / slab["pore_flow.fluid.bulk_modulus"])
            if modules == "explicit" and diffusivity > MOST_EXPLICIT:
                continue
            allowed = 0.15 if is_thin(diffusivity) else 0.05
            yield Case(GROUP, name, f"darcy conservative {modules}", scene, {**slab, **fixed, **integrator},
                       functools.partial(measure_diffusion, largest_error=allowed))
            most = 0.07 if is_thin(rock.diffusivity) else 0.02
            yield Case(GROUP, name, f"quasi_static, darcy {modules}", os.path.join(HERE, "column.yaml"),
                       {**rock.settings, **fixed, **integrator},
                       measure_column(rock, largest_error=0.1, overshoot_limit=most))


def cases():
    scene = os.path.join(HERE, "diffusion.yaml")
    for operator in ("conservative", "bond"):
        for modules, words in flow_integrators().items():
            yield Case(GROUP, "drainage of a slab", f"darcy {operator} {modules}", scene,
                       {**diffusion(), **words, "pore_flow.operator": operator}, measure_diffusion)
    yield from fixed_time_cases()
    for fluid in (22e6, 2.2e9, 1e11, 1e13, 1e15):
        yield from column_cases(f"fluid bulk modulus {fluid / 1e9:g} GPa", Rock(fluid=fluid))
    for porosity in (0.3, 0.1, 1e-2, 1e-4):
        yield from column_cases(f"storage {porosity / 1e15:.0e} 1/Pa", Rock(porosity=porosity, fluid=1e15))
    for biot in (0.1, 0.2, 0.5, 0.8, 1.0):
        yield from column_cases(f"Biot coefficient {biot:g}", Rock(porosity=0.1, biot=biot, grains=1e12))
    for ratio in (0.0, 0.25, 0.4, 0.45, 0.49, 0.499):
        shear = 1e9
        bulk = 2.0 * shear * (1.0 + ratio) / (3.0 * (1.0 - 2.0 * ratio))
        yield from column_cases(f"Poisson ratio {ratio:g}", Rock(bulk=bulk, shear=shear))
    yield from dynamic_cases()
    yield from slit_cases()
    yield from contrast_cases()
    yield from added_mass_cases()
    yield from seepage_cases()
    yield from plate_cases()
    yield from paper_cases()
