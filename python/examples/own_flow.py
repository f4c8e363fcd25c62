"""Pore flow in Python, to try an idea with: implicit in time, from each point of a lattice to its neighbours.

    content  m = S p + alpha theta,    dm/dt = div(kappa grad p)

with theta the dilatation that the solid gives. `pore_flow: {type: own_flow}` in a scene, after `import own_flow`.
"""
import numpy as np

import perifrac
from perifrac import Key, Port, View


class OwnFlow(perifrac.Module):
    meaning = "Darcy's law between neighbours on a lattice, implicit in time."
    keys = [
        Key("storage", unit="1/Pa", range="(0, inf)", required=True, meaning="S, at constant strain."),
        Key("mobility", unit="m^2/(Pa s)", range="(0, inf)", required=True, meaning="kappa."),
        Key("biot_coefficient", range="(0, 1]", default="1", meaning="alpha."),
        Key("density", unit="kg/m^3", range="(0, inf)", default="1000 kg/m^3", meaning="Of the fluid."),
        Key("drained", type="text", required=True, meaning="The face where the pressure is 0."),
    ]

    def __init__(self, section, body):
        self.storage, self.alpha = section.number("storage"), section.number("biot_coefficient")
        self.density, self.volumes = section.number("density"), body.volumes
        if section.text("drained") not in body.faces:
            section.fail("drained", "no such face", "one of " + ", ".join(body.faces))
        self.flow, self.leak = conductances(body, section.number("mobility"), section.text("drained"))
        mass = "kg/m" if body.dimension == 2 else "kg"
        self.ports = [
            Port("dilatation", "1", direction="in"),
            Port("pore_pressure", "Pa"),
            Port("pore_stress", "Pa"),
            Port("fluid_mass", mass, kind="extensive", role="mass_stored"),
            Port("fluid_gained", mass, kind="extensive", role="mass_gained"),
        ]
        self.dilatation = View(np.empty(0))  # no room before some module writes it

    def port(self, name):
        if name == "dilatation":
            return self.dilatation
        if name == "pore_pressure":
            return self.pressure
        if name == "pore_stress":
            return View(self.stress, slope=self.stress_slope)
        return self.density * float(self.content @ self.volumes) if name == "fluid_mass" else self.gained

    def initialize(self, t):
        self.pressure, self.stress, self.content = np.zeros((3, len(self.volumes)))
        self.stress_slope = np.full(len(self.volumes), -self.alpha**2 / self.storage)
        self.gained = 0.0

    def connect(self, name):
        count = len(self.volumes)
        self.dilatation = View(np.zeros(count), slope=np.zeros(count))

    def advance(self, begin, end):
        theta, slope = self.dilatation.value, self.dilatation.slope
        # theta + slope (alpha p) is the dilatation that the solid answers with.
        stores = np.full(len(self.volumes), self.storage)
        rest = np.zeros(len(self.volumes))
        if slope is not None:
            stores, rest = stores + self.alpha**2 * slope, self.alpha * theta
        if end > begin:
            matrix = np.diag(stores * self.volumes) + (end - begin) * self.flow
            self.pressure[:] = np.linalg.solve(matrix, (self.content - rest) * self.volumes)
            self.gained -= (end - begin) * self.density * float(self.leak @ self.pressure)
            self.content[:] = stores * self.pressure + rest
        else:  # nothing flows
            self.pressure[:] = (self.content - rest) / stores
        self.stress[:] = self.alpha * self.pressure
        return end

    def may_end_windows(self):
        return False

    def visit_state(self, state):
        self.content = state.visit("content", self.content)
        self.pressure = state.visit("pressure", self.pressure)
        self.gained = state.visit("gained", self.gained)

    def on_restored(self, t):
        self.stress[:] = self.alpha * self.pressure


def conductances(body, mobility, drained):
    """What flows out of every point at pressures p is `flow @ p`; of it, `leak @ p` through the drained face."""
    place = {tuple(np.rint(x / body.spacing * 2).astype(int)): i for i, x in enumerate(body.positions)}
    between = mobility * body.spacing ** (body.dimension - 2)
    flow = np.zeros((len(place), len(place)))
    leak = np.zeros(len(place))
    axis, direction, _ = body.faces[drained]
    for x, i in place.items():
        for a in range(body.dimension):
            for side in (-1, 1):
                j = place.get(tuple(v + 2 * side * (k == a) for k, v in enumerate(x)))
                if j is not None:
                    flow[i, i] += between
                    flow[i, j] -= between
                elif (a, side) == (axis, direction):
                    leak[i] = 2 * between  # half a spacing away
    return flow + np.diag(leak), leak


perifrac.add_module_type("pore_flow", "own_flow", OwnFlow)
