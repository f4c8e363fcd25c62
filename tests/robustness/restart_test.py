#!/usr/bin/python3
"""A restart from a scheduled checkpoint gives the uninterrupted run, bit for bit."""
import shutil
import tempfile
import unittest
from itertools import product
from pathlib import Path

from perifrac_runs import CONFIGS, FLUIDS, MANDEL, METHODS, SMALL, VARIANTS, RunTest, checkpoints, perifrac, settings

SCHEMES = {
    "explicit": {"pore_flow.integrator.type": "explicit"},
    "cvode, direct": {},
    "cvode, krylov": {"pore_flow.integrator.linear_solver": "krylov"},
    "drained, iterated with anderson": {
        "coupling.split": "drained", "coupling.iterations.max": "60", "coupling.acceleration": "anderson",
        "pore_flow.integrator.type": "explicit", "pore_flow.fluid.bulk_modulus": "1 GPa"},
    "fixed stress, iterated with aitken": {
        "coupling.iterations.max": "20", "coupling.iterations.tolerance": "1e-3", "coupling.acceleration": "aitken"},
    "stabilised": {"pore_flow.undrained_stabilisation": "0.25"},
    "stabilised, explicit, iterated": {
        "pore_flow.undrained_stabilisation": "0.25", "pore_flow.integrator.type": "explicit",
        "coupling.iterations.max": "20"},
    "windows from the end": {"coupling.window": "{}"},
    "rows apart": {"output.history_interval": "0.7 s"},
}


class Restart(RunTest):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.whole_runs = Path(holder.name)

    def whole_run(self, name):
        """The uninterrupted run of that scheme, made once."""
        folder = self.whole_runs / name
        return folder if folder.exists() else self.run_scene(SMALL | SCHEMES[name], folder)

    def test_from_the_last_checkpoint_but_one(self):
        for name, keys in SCHEMES.items():
            with self.subTest(name):
                whole = self.whole_run(name)
                # As a crash after that checkpoint leaves the folder, with rows and frames beyond it.
                again = self.folder / name / "again"
                shutil.copytree(whole, again)
                start, end = checkpoints(again)
                end.unlink()
                self.run_scene(SMALL | keys, again, "--restart", str(start))
                self.assert_same_results(whole, again)

    def test_in_parts_by_until(self):
        for name, keys in SCHEMES.items():
            with self.subTest(name):
                whole = self.whole_run(name)
                parts = self.run_scene(SMALL | keys, f"{name}/parts", "--until", "5 s")
                for end in ("9 s", "20 s"):
                    self.run_scene(SMALL | keys, parts, "--restart", checkpoints(parts)[-1], "--until", end)
                self.assert_same_results(whole, parts)

    def test_other_scenes_in_parts(self):
        for name, (scene, keys) in VARIANTS.items():
            with self.subTest(name):
                spacing = "2.5 m" if name == "ball" else "2 m"
                keys = keys | {"body.spacing": spacing, "time.end": "0.3 s", "output.times": "[0.1 s, 0.2 s]",
                               "output.checkpoint_interval": "0 s"}
                whole = self.run_scene(keys, f"{name}/whole", scene=scene)
                parts = self.run_scene(keys, f"{name}/parts", "--until", "0.1 s", scene=scene)
                for end in ("0.2 s", "0.3 s"):
                    self.run_scene(keys, parts, "--restart", checkpoints(parts)[-1], "--until", end, scene=scene)
                self.assert_same_results(whole, parts)

    def test_a_growing_crack_in_parts(self):
        dry = {"body.spacing": "2.5 mm", "time.end": "20 ms"}
        pores = {"body.spacing": "5 mm", "time.end": "10 ms"}
        cvode = pores | {"pore_flow.integrator.type": "cvode", "coupling.window.largest": "1 ms"}
        stabilised = pores | {"pore_flow.undrained_stabilisation": "0.25"}
        front = {"body.size": "[8 mm, 8 mm, 32 mm]", "time.end": "12 ms"}
        multigrid = {"solid.linear_solver.type": "multigrid"}
        wet = multigrid | {"body.spacing": "2.5 mm", "time.end": "8 ms"}
        published = {"damage.fracture_energy": "1e-4 J/m^2", "time.end": "0.3 ms", "output.interval": "0.25 ms",
                     "output.history_interval": "0.1 ms"}
        for name, scene, until, keys in (("dry", "hf_storage", "10 ms", dry),
                                         ("begins later", "three_point_bending", "0.2 s", {"time.end": "0.3 s"}),
                                         ("inertia", "hf_storage", "10 ms", dry | {"solid.type": "dynamic"}),
                                         ("in 3D", "radial", "10 ms", front),
                                         ("by multigrid", "hf_storage", "5 ms", wet),
                                         ("by multigrid, in 3D", "radial", "10 ms", front | multigrid),
                                         ("by multigrid, pores", "hf_storage_pores", "5 ms", pores | multigrid),
                                         ("as published", "paper/hf_storage", "0.25 ms", published),
                                         ("explicit pores", "hf_storage_pores", "5 ms", pores),
                                         ("stabilised pores", "hf_storage_pores", "5 ms", stabilised),
                                         ("cvode pores", "hf_storage_pores", "5 ms", cvode)):
            with self.subTest(name):
                path, keys = CONFIGS / f"{scene}.yaml", keys | {"output.checkpoint_interval": "0 s"}
                whole = self.run_scene(keys, f"{name}/whole", scene=path)
                parts = self.run_scene(keys, f"{name}/parts", "--until", until, scene=path)
                self.run_scene(keys, parts, "--restart", checkpoints(parts)[-1], scene=path)
                self.assert_same_results(whole, parts)

    def test_a_sliding_crack_in_parts(self):
        path = CONFIGS / "sliding_crack.yaml"
        keys = {"body.spacing": "4 mm", "time.end": "2.5 s", "output.checkpoint_interval": "0 s",
                "damage": "{type: energy_release, fracture_energy: 5 J/m^2}"}
        whole = self.run_scene(keys, "whole", scene=path)
        # It slides and has grown, then sticks, when the parts end.
        parts = self.run_scene(keys, "parts", "--until", "0.8 s", scene=path)
        for end in ("1.6 s", "2.5 s"):
            self.run_scene(keys, parts, "--restart", checkpoints(parts)[-1], "--until", end, scene=path)
        self.assert_same_results(whole, parts)

    def test_a_fault_beside_pores_in_parts(self):
        path, keys = CONFIGS / "fault_slip.yaml", {"body.spacing": "8 m", "time.end": "50000 s"}
        whole = self.run_scene(keys, "whole", scene=path)
        parts = self.run_scene(keys, "parts", "--until", "25000 s", scene=path)
        self.run_scene(keys, parts, "--restart", checkpoints(parts)[-1], scene=path)
        self.assert_same_results(whole, parts)

    def test_fluids_in_parts(self):
        for name, method in product(FLUIDS, METHODS):
            with self.subTest(name, method=method):
                scene, keys, folder = FLUIDS[name], {"fluid.type": method}, f"{name}/{method}"
                whole = self.run_scene(keys, f"{folder}/whole", scene=scene)
                parts = self.run_scene(keys, f"{folder}/parts", "--until", "0.1 s", scene=scene)
                for end in ("0.2 s", "0.3 s"):
                    self.run_scene(keys, parts, "--restart", checkpoints(parts)[-1], "--until", end, scene=scene)
                self.assert_same_results(whole, parts)

    def test_beyond_the_scenes_end(self):
        whole = self.run_scene(SMALL, "whole", "--until", "25 s")
        parts = self.run_scene(SMALL, "parts")
        self.run_scene(SMALL, parts, "--restart", checkpoints(parts)[-1], "--until", "25 s")
        self.assert_same_results(whole, parts)

    def test_until_between_output_times_is_the_last_of_them(self):
        keys = SMALL | {"output.interval": "0.1 s", "time.end": "3 s", "output.times": "[0.3 s]"}
        whole = self.run_scene(keys, "whole")
        # 3 * 0.1 is not 0.3 in binary numbers: the two must not make two frames.
        parts = self.run_scene(keys, "parts", "--until", "0.7 s")
        self.run_scene(keys, parts, "--restart", checkpoints(parts)[-1])
        self.assert_same_results(whole, parts)

    def test_with_another_number_of_threads(self):
        whole = self.run_scene(SMALL, "whole", "--threads", "1")
        parts = self.run_scene(SMALL, "parts", "--threads", "2", "--until", "5 s")
        self.run_scene(SMALL, parts, "--restart", checkpoints(parts)[-1], "--threads", "3")
        self.assert_same_results(whole, parts)

    def test_stays_in_the_checkpoints_folder_by_default(self):
        whole = self.whole_run("cvode, direct")
        parts = self.run_scene(SMALL, "parts", "--until", "9 s")
        done = perifrac("run", MANDEL, "--no-report", *settings(SMALL), "--restart", checkpoints(parts)[-1],
                        cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_results(whole, parts)
        self.assertFalse((self.folder / "runs").exists())

    def test_into_a_new_folder_leaves_the_old_one_alone(self):
        whole = self.run_scene(SMALL, "whole", "--until", "9 s")
        first = self.run_scene(SMALL, "first", "--until", "5 s")
        before = {file: file.read_bytes() for file in first.rglob("*") if file.is_file()}
        second = self.run_scene(SMALL, "second", "--restart", checkpoints(first)[-1], "--until", "9 s")
        self.assertTrue(before == {file: file.read_bytes() for file in first.rglob("*") if file.is_file()})
        self.assert_same_checkpoint(checkpoints(whole)[-1], checkpoints(second)[-1])
        # It holds its own start: another restart needs nothing of the first folder.
        self.assert_same_checkpoint(checkpoints(first)[-1], checkpoints(second)[0])

    def test_from_the_end_makes_the_summary_that_a_kill_prevented(self):
        whole = self.whole_run("cvode, direct")
        again = self.folder / "again"
        shutil.copytree(whole, again)
        (again / "summary.json").unlink()
        self.run_scene(SMALL, again, "--restart", checkpoints(again)[-1])
        self.assert_same_results(whole, again)

    def test_gives_up_what_lies_beyond_an_earlier_checkpoint(self):
        run = self.run_scene(SMALL, "run")
        earlier = checkpoints(run)[0]
        self.run_scene(SMALL, run, "--restart", earlier, "--until", "13 s")
        self.assertIn(earlier, checkpoints(run))
        with open(run / "history.csv", encoding="utf-8") as rows:
            self.assertEqual(rows.readlines()[-1].split(",")[0], "13")
        self.assert_no_remains(run)


if __name__ == "__main__":
    unittest.main()
