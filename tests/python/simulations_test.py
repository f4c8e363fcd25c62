#!/usr/bin/python3
"""Runs in the process: windows, ports as arrays, loads and inputs of one's own, callbacks, Ctrl-C, what goes wrong.

Usage: simulations_test.py PROGRAM BUILD [unittest's arguments]
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import perifrac

sys.argv[1:3] = []
SOURCE = Path(__file__).resolve().parents[2]
TOP = "solid.boundary.top"


def mandel(**keys):
    scene = perifrac.Scene.example("mandel")
    scene["body.spacing"] = "4 m"
    scene["output.times"] = ["1 s"]
    del scene["reference"]
    for key, value in keys.items():
        scene[key.replace("__", ".")] = value
    return scene


class Simulations(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_goes_window_by_window(self):
        simulation = perifrac.Simulation(mandel(time__end="2 s"))
        self.assertEqual((simulation.time, simulation.step, simulation.end), (0.0, 0, 2.0))
        self.assertTrue(simulation.advance())
        self.assertAlmostEqual(simulation.time, 0.02)
        simulation.advance_to(0.5)
        self.assertEqual(simulation.time, 0.5)
        seen = []
        simulation.run(lambda s: seen.append(s.time))
        self.assertEqual(seen[-1], 2.0)
        self.assertIn(1.0, seen)  # an output
        self.assertTrue(simulation.done)
        self.assertFalse(simulation.advance())

    def test_ports_are_views(self):
        simulation = perifrac.Simulation(mandel(time__end="2 s"))
        simulation.advance()
        ports = {f"{p.module}.{p.name}": p for p in simulation.ports()}
        self.assertEqual(ports["pore_flow.pore_pressure"].unit, "Pa")
        self.assertTrue(ports["solid.pore_stress"].linked)
        self.assertFalse(ports["solid.interface_impulse"].linked)
        self.assertEqual(ports["solid.displacement"].components, 2)
        pressure = simulation.fields["pore_pressure"]
        count = ports["pore_flow.pore_pressure"].count
        self.assertEqual((pressure.shape, simulation.fields["displacement"].shape), ((count,), (count, 2)))
        self.assertFalse(pressure.flags.writeable or pressure.flags.owndata)
        with self.assertRaises(ValueError):
            pressure[0] = 1.0
        before = pressure.copy()
        simulation.advance()
        self.assertFalse(np.array_equal(pressure, before))  # it shows what is there now: no copy
        np.testing.assert_array_equal(pressure, simulation.port("pore_flow.pore_pressure"))
        positions = simulation.points("pore_pressure")
        self.assertEqual((positions.shape, positions.max(axis=0).tolist()), ((count, 2), [38.0, 18.0]))
        self.assertEqual(simulation.port("dilatation", "slope").shape, (count,))
        with self.assertRaisesRegex(KeyError, "did you mean 'pore_pressure'"):
            simulation.port("pore_presure")
        self.assertIn("dilatation", simulation.fields)

    def test_a_view_keeps_the_simulation(self):
        simulation = perifrac.Simulation(mandel())
        pressure = simulation.fields["pore_pressure"]
        before = pressure.copy()
        del simulation
        np.testing.assert_array_equal(pressure, before)

    def test_a_load_changed_midway_adds_what_a_second_one_would(self):
        """Linear: at factor 2 from t = 4 s on the pressure is that of one load, and of one that began at 4 s."""

        def pressures(times, change_at=None):
            simulation = perifrac.Simulation(mandel(time__end="20 s"), loads=[TOP])
            found = []
            for t in times:
                simulation.advance_to(t)
                found.append(simulation.fields["pore_pressure"][0])
                if t == change_at:
                    simulation.loads[TOP] = 2.0
            return np.array(found)

        later = np.array([4.02, 5.0, 8.0, 16.0])
        one, twice = pressures([4.0, *later])[1:], pressures([4.0, *later], change_at=4.0)[1:]
        np.testing.assert_allclose(twice, one + pressures(later - 4.0), rtol=1.3e-4)
        self.assertGreater(twice[0] / one[0], 1.9)

    def test_a_load_of_factor_one_changes_nothing(self):
        plain, given = perifrac.Simulation(mandel(time__end="4 s")), perifrac.Simulation(mandel(time__end="4 s"), loads=[TOP])
        plain.run()
        given.run(lambda s: s.loads.__setitem__(TOP, 1.0))
        np.testing.assert_allclose(given.fields["pore_pressure"], plain.fields["pore_pressure"], rtol=1e-14)
        self.assertEqual(given.step, plain.step)

    def test_inputs_that_the_scene_leaves_unlinked(self):
        """A column that stands on its end under forces of one's own, against its weight."""
        scene = {
            "dimension": 2, "time": {"end": "1 s"}, "body": {"shape": "box", "size": [1, 4], "spacing": 0.25},
            "coupling": {"window": {"first": "0.25 s", "growth": 1, "largest": "0.25 s"}},
            "solid": {"type": "quasi_static", "material": {"youngs_modulus": "1 GPa", "poisson_ratio": 0},
                      "boundary": {"bottom": {"type": "roller"}, "left": {"type": "roller"}}},
        }  # fmt: skip
        heavy = perifrac.Simulation({**scene, "solid": {**scene["solid"], "body_force": [0, "-1000 N/m^3"]}})
        given = perifrac.Simulation(scene, inputs=["solid.interface_impulse"])
        impulse = given.inputs["solid.interface_impulse"]
        self.assertEqual((impulse.shape, impulse.flags.writeable), ((64, 2), True))
        heavy.run()
        while not given.done:
            given.inputs["solid.interface_impulse"][:, 1] = -1000 * 0.25**2 * 0.25  # N/m^3, volume, window
            given.advance()
        here, there = given.fields["displacement"], heavy.fields["displacement"]
        np.testing.assert_allclose(here, there, atol=1e-14 * np.abs(there).max())
        self.assertLess(here[:, 1].min(), -1e-6)
        with self.assertRaisesRegex(perifrac.SceneError, "expected one of: solid.pore_stress, solid.interface_impulse"):
            perifrac.Simulation(scene, inputs=["solid.interface_impulses"])
        with self.assertRaisesRegex(perifrac.SceneError, "leaves unlinked"):
            perifrac.Simulation(mandel(), inputs=["solid.pore_stress"])

    def test_loads_that_are_not_there(self):
        with self.assertRaisesRegex(perifrac.SceneError, "'crack_fluid.inlets' takes no schedule"):
            perifrac.Simulation(mandel(), loads=["crack_fluid.inlets"])
        simulation = perifrac.Simulation(mandel())
        with self.assertRaisesRegex(perifrac.SceneError, "was not asked for"):
            simulation.loads[TOP] = 2

    def test_an_inlet_that_is_shut(self):
        scene = perifrac.Scene.example("kgd_viscosity")
        for key, value in {"body.spacing": "10 mm", "time.end": "30 ms", "output.interval": "30 ms"}.items():
            scene[key] = value
        inlet = "crack_fluid.inlets[0]"
        simulation = perifrac.Simulation(scene, loads=[inlet])
        simulation.advance_to(0.015)
        held = simulation.port("crack_fluid.crack_fluid_mass").sum()
        simulation.loads[inlet] = 0.0
        simulation.run()
        self.assertAlmostEqual(simulation.port("crack_fluid.crack_fluid_mass").sum() / held, 1.0, delta=1e-14)
        self.assertLess(simulation.summary()["ledger"]["mass_error"], 1e-14)

    def test_what_a_callback_raises_ends_the_run(self):
        simulation = perifrac.Simulation(mandel(time__end="4 s"), output=self.folder)

        def look(simulation):
            if simulation.step == 3:
                raise ValueError("no\nsense")

        with self.assertRaisesRegex(perifrac.ModuleError, r"look \(simulations_test.py:\d+\): ValueError: no sense") as caught:
            simulation.run(look)
        self.assertIsInstance(caught.exception.__cause__, ValueError)
        summary = json.loads((self.folder / "summary.json").read_text())
        self.assertEqual(summary["outcome"], "failed")
        self.assertIn("ValueError: no sense", summary["failure"]["error"])
        self.assertFalse(simulation.advance())

    def test_numbers_that_go_wrong_are_an_error_with_a_place(self):
        scene = mandel(pore_flow__integrator__type="explicit")
        scene["solid.boundary.top.force"] = "1e308 N/m"
        with self.assertRaises(perifrac.NumericalError) as caught:
            perifrac.Simulation(scene).run()
        self.assertNotIn("\n", str(caught.exception))
        self.assertTrue(caught.exception.field and caught.exception.place)

    def test_close_stops_it(self):
        with perifrac.Simulation(mandel(time__end="4 s"), output=self.folder) as simulation:
            simulation.advance()
        run = perifrac.read_run(self.folder)
        self.assertEqual((run.outcome, len(run.history["time"])), ("stopped", 2))
        simulation.close()

    def test_others_run_while_it_advances(self):
        """The GIL is free: another thread sees that the simulation advances, and may not touch it."""
        simulation = perifrac.Simulation(mandel(body__spacing="1 m", time__end="40 s"))
        refused, done = [], threading.Event()

        def look():
            while not done.is_set():
                try:
                    simulation.fields["pore_pressure"]
                except RuntimeError as error:
                    refused.append(str(error))
                time.sleep(1e-4)

        thread = threading.Thread(target=look)
        thread.start()
        while not refused and simulation.advance():
            pass
        done.set()
        thread.join()
        self.assertTrue(any("one thread at a time" in line for line in refused))

    def test_ctrl_c_stops_a_run(self):
        code = textwrap.dedent(f"""
            import perifrac
            scene = perifrac.Scene.example("mandel")
            scene["time.end"] = "1e6 s"
            scene["coupling.window.largest"] = "0.1 s"
            print("begun", flush=True)
            perifrac.Simulation(scene, output={str(self.folder)!r}).run(lambda s: print("window", flush=True))
        """)
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        lines = iter(process.stdout.readline, "")
        self.assertTrue(any(line.strip() == "window" for line in lines))
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=600)
        self.assertEqual(process.returncode, -signal.SIGINT, errors)
        self.assertIn("KeyboardInterrupt", errors)
        self.assertEqual(json.loads((self.folder / "summary.json").read_text())["outcome"], "stopped")
        self.assertTrue(list(self.folder.glob("checkpoint_*.h5")))

    def test_results_of_others_stay(self):
        (self.folder / "history.csv").write_text("mine")
        with self.assertRaisesRegex(perifrac.SceneError, "history.csv"):
            perifrac.Simulation(mandel(), output=self.folder)
        self.assertEqual((self.folder / "history.csv").read_text(), "mine")

    def test_the_example_of_two_loads(self):
        code = SOURCE / "python/examples/two_loads.py"
        self.assertLessEqual(len(code.read_text().splitlines()), 30)
        subprocess.run([sys.executable, code], cwd=self.folder, check=True, env=os.environ, capture_output=True)
        self.assertGreater((self.folder / "runs/two_loads/pressure.png").stat().st_size, 10000)
        history = perifrac.read_run(self.folder / "runs/two_loads").history
        pressure = history["pore_pressure at middle"]
        jump = np.diff(pressure)[np.searchsorted(history["time"], 20.0) :][:2].max()
        self.assertAlmostEqual(jump / pressure[0], 1.0, delta=3.3e-4)  # as the first load's, at once


if __name__ == "__main__":
    unittest.main()
