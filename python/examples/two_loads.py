"""Mandel's slab whose load doubles after 20 s: built, run window by window, read and plotted."""
import matplotlib.pyplot as plt

import perifrac

TOP = "solid.boundary.top"
scene = perifrac.Scene({
    "dimension": 2,
    "body": {"shape": "box", "size": ["40 m", "20 m"], "spacing": "2 m"},
    "solid": {"type": "quasi_static", "material": {"lame_lambda": "400 MPa", "shear_modulus": "400 MPa"},
              "boundary": {"left": {"type": "roller"}, "bottom": {"type": "roller"},
                           "top": {"type": "rigid_plate", "force": "10 kN/m"}}},
    "pore_flow": {"type": "darcy", "permeability": "1.019368e-11 m^2", "biot_coefficient": 1, "porosity": 0.3,
                  "grain_bulk_modulus": "10 GPa",
                  "fluid": {"bulk_modulus": "2 GPa", "viscosity": "1 cP", "density": "1000 kg/m^3"},
                  "boundary": {"right": {"type": "pressure", "pressure": "0 Pa"}}},
    "coupling": {"window": {"first": "20 ms", "largest": "0.5 s"}},
    "time": {"end": "60 s"},
    "output": {"probes": [{"name": "middle", "at": [0, 0], "field": "pore_pressure"}]},
})  # fmt: skip
simulation = perifrac.Simulation(scene, output="runs/two_loads", loads=[TOP])
while simulation.advance():
    if simulation.time >= 20:
        simulation.loads[TOP] = 2  # beside the 10 kN/m of the scene
history = perifrac.read_run("runs/two_loads").history
plt.plot(history["time"], history["pore_pressure at middle"])
plt.xlabel("time [s]")
plt.ylabel("pressure in the middle [Pa]")
plt.savefig("runs/two_loads/pressure.png")
