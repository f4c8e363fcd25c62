"""Small scenes in SI, between them all modules, in 2D. Their spacings are no powers of two, so that
rounding differs once they are moved."""


def probes(*places):
    return [{"name": f"p{n}", "at": list(place)} for n, place in enumerate(places)]


def mandel():
    return {
        "dimension": 2,
        "body": {"shape": "box", "size": [1.2, 1.0], "spacing": 0.1},
        "solid": {
            "type": "quasi_static", "material": {"lame_lambda": 4e8, "shear_modulus": 4e8},
            "boundary": {"left": {"type": "roller"}, "bottom": {"type": "roller"},
                         "top": {"type": "rigid_plate", "force": 1e4}}},
        "pore_flow": {
            "type": "darcy", "permeability": 1e-11, "porosity": 0.3, "grain_bulk_modulus": 1e10,
            "fluid": {"bulk_modulus": 2e9, "viscosity": 1e-3},
            "boundary": {"right": {"type": "pressure", "pressure": 0.0}}},
        "coupling": {"window": {"first": 1e-3, "largest": 0.01}},
        "time": {"end": 0.1},
        "output": {"times": [0.05], "probes": probes((0.13, 0.21), (0.5, 0.3), (1.17, 0.98))},
    }


def plate():
    return {
        "dimension": 2,
        "body": {"shape": "box", "size": [1.4, 1.2], "spacing": 0.1, "horizon_ratio": 3,
                 "regions": {"soft": {"from": [0.6, -1.0], "to": [2.0, 2.0]}}},
        "solid": {
            "type": "quasi_static", "material": {"youngs_modulus": 1e10, "poisson_ratio": 0.3},
            "regions": {"soft": {"material": {"youngs_modulus": 3e9, "poisson_ratio": 0.2}}},
            "body_force": [2e3, -2.7e4],
            "boundary": {"left": {"type": "fixed"}, "right": {"type": "traction", "traction": [1e6, 4e5]},
                         "top": {"type": "traction", "traction": [0.0, -2e6]}}},
        "time": {"end": 1.0},
        "coupling": {"window": {"first": 0.2, "largest": 0.2}},
        "output": {"times": [0.4], "probes": probes((0.33, 0.41), (0.75, 0.35), (1.4, 1.2))},
    }


def dynamic():
    scene = mandel()
    scene["solid"] = {
        "type": "dynamic", "density": 2000.0, "damping": 50.0, "material": {"lame_lambda": 4e8, "shear_modulus": 4e8},
        "boundary": {"left": {"type": "roller"}, "bottom": {"type": "roller"},
                     "top": {"type": "traction", "traction": [3e3, -1e4], "schedule": {"ramp": 2e-3}}}}
    scene["pore_flow"]["integrator"] = {"type": "explicit"}
    scene["coupling"] = {"window": {"first": 2e-4, "largest": 2e-4}}
    scene["time"] = {"end": 6e-3}
    scene["output"]["times"] = [3e-3]
    return scene


def aquifer():
    return {
        "dimension": 2, "gravity": [0.5, -9.81],
        "body": {"shape": "box", "size": [1.4, 0.8], "spacing": 0.1,
                 "regions": {"tight": {"from": [0.7, -1.0], "to": [3.0, 3.0]}}},
        "pore_flow": {
            "type": "darcy", "permeability": 1e-12, "porosity": 0.2,
            "regions": {"tight": {"permeability": 1e-13}},
            "fluid": {"bulk_modulus": 2e9, "viscosity": 1e-3, "density": 1000.0},
            "initial_pressure": 2e5,
            "sources": [{"at": [0.35, 0.25], "rate": 1e-6}],
            "boundary": {"left": {"type": "pressure", "pressure": 1e5, "hydrostatic": True},
                         "top": {"type": "flux", "flux": 1e-6}}},
        "coupling": {"window": {"first": 1e-3, "largest": 2e-2}},
        "time": {"end": 0.2},
        "output": {"times": [0.1], "probes": probes((0.31, 0.44), (0.7, 0.4), (1.33, 0.02))},
    }


def well():
    """From no pressure at all."""
    scene = aquifer()
    del scene["gravity"]
    flow = scene["pore_flow"]
    flow["initial_pressure"] = 0.0
    flow["boundary"]["left"] = {"type": "pressure", "pressure": 0.0}
    return scene


def water():
    return {
        "dimension": 2, "gravity": [0.0, -9.81],
        "fluid": {
            "type": "semi_lagrangian", "spacing": 0.1, "bulk_modulus": 1e5, "viscosity": 1.0,
            "container": {"from": [0.0, 0.0], "to": [1.2, 0.8], "faces": {"top": "open"}},
            "blocks": [{"name": "water", "from": [0.0, 0.0], "to": [0.7, 0.6], "hydrostatic": True,
                        "velocity": [0.3, 0.1]}]},
        "coupling": {"window": {"first": 5e-3, "largest": 5e-3}},
        "time": {"end": 0.06},
        "output": {"times": [0.03], "probes": probes((0.31, 0.27), (0.62, 0.11))},
    }


def fluid_driven():
    """A crack beside the middle, so that it turns, under rates that rise."""
    return {
        "dimension": 2,
        "body": {"shape": "box", "size": [0.15, 0.15], "spacing": 0.005},
        "cracks": [{"name": "notch", "path": [0.06, 0.15, 0.06, 0.115]}],
        "solid": {
            "type": "quasi_static", "material": {"youngs_modulus": 7e8, "poisson_ratio": 0.25},
            "confining_stress": [2.1e5, 1.05e5], "boundary": {"bottom": {"type": "roller"}},
            "pins": [{"at": [0.0725, 0.0], "axis": "x"}]},
        "damage": {"type": "energy_release", "fracture_energy": 5.0},
        "crack_fluid": {
            "type": "network", "viscosity": 1e-3, "bulk_modulus": 2.2e9,
            "inlets": [{"name": "notch", "at": [0.06, 0.15], "rate": 1.6e-4,
                        "schedule": {"ramp": 2e-3}}]},
        "coupling": {"window": {"first": 1e-4, "largest": 1e-3}, "iterations": {"max": 20}},
        "time": {"end": 0.02},
        "output": {"times": [0.01], "probes": probes((0.041, 0.117), (0.1, 0.051))},
    }


def torn():
    """An edge crack that a plate under tension and shear turns aside."""
    return {
        "dimension": 2,
        "body": {"shape": "box", "size": [0.1, 0.1], "spacing": 0.005,
                 "regions": {"tough": {"from": [0.065, -1.0], "to": [1.0, 1.0]}}},
        "cracks": [{"name": "edge", "path": [0.0, 0.045, 0.03, 0.045]}],
        "solid": {
            "type": "quasi_static", "material": {"youngs_modulus": 1e9, "poisson_ratio": 0.25},
            "boundary": {"bottom": {"type": "fixed"},
                         "top": {"type": "fixed", "displacement": [5e-5, 2e-4], "schedule": {"ramp": 1.0}}}},
        "damage": {"type": "energy_release", "fracture_energy": 50.0, "regions": {"tough": {"fracture_energy": 5e4}}},
        "coupling": {"window": {"first": 0.02, "largest": 0.02}},
        "time": {"end": 1.0},
        "output": {"times": [0.5], "probes": probes((0.041, 0.061), (0.09, 0.012))},
    }


def stretched():
    """Bonds that break in a solid with inertia, from a notch under a blow."""
    return {
        "dimension": 2,
        "body": {"shape": "box", "size": [0.06, 0.06], "spacing": 0.002, "horizon_ratio": 3},
        "cracks": [{"name": "notch", "path": [0.0, 0.032, 0.03, 0.032]}],
        "solid": {
            "type": "dynamic", "density": 8000.0, "material": {"youngs_modulus": 1.9e11, "poisson_ratio": 0.25},
            "boundary": {"top": {"type": "traction", "traction": [1e8, 6e8]},
                         "bottom": {"type": "roller"}}},
        "damage": {"type": "critical_stretch", "fracture_energy": 2.22e4},
        "coupling": {"window": {"first": 5e-7, "largest": 5e-7}},
        "time": {"end": 3e-5},
        "output": {"times": [1.5e-5], "probes": probes((0.041, 0.041), (0.012, 0.053))},
    }


def leaking():
    """A crack in the middle of a plate, whose fluid goes into the rock by Carter's law."""
    scene = fluid_driven()
    scene["cracks"] = [{"name": "wing", "path": [0.0, 0.08, 0.03, 0.08]}]
    scene["solid"]["confining_stress"] = [3e5, 3e5]
    scene["solid"]["boundary"] = {"left": {"type": "roller"}, "bottom": {"type": "roller"}}
    scene["solid"].pop("pins")
    scene["crack_fluid"].update(leak_off="carter", leak_off_coefficient=3e-5)
    scene["crack_fluid"]["inlets"][0]["at"] = [0.0, 0.08]
    return scene


LINEAR = {"mandel": mandel, "plate": plate, "dynamic": dynamic}
GROWING = {"fluid_driven": fluid_driven, "torn": torn, "stretched": stretched, "leaking": leaking}
SCENES = {**LINEAR, "aquifer": aquifer, "well": well, "water": water, **GROWING}
