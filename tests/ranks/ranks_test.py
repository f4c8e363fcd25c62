#!/usr/bin/python3
"""A run that mpirun divides among processes: the same bits, one voice, nothing lost."""
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from itertools import product
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "robustness"))
from perifrac_runs import (CONFIGS, FLUIDS, MANDEL, METHODS, PATIENCE, RunTest, SMALL, VARIANTS,  # noqa: E402
                           checkpoints, perifrac, run_command)

# More processes than processors, all on this machine; loops over few points are divided too.
ENVIRONMENT = os.environ | {
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_odls_base_sigkill_timeout": "3", "OMP_NUM_THREADS": "1",
    "PERIFRAC_LEAST_DIVIDED": "1"}

# A few steps are enough: what is wrong at all is wrong in the first.
STEPS = {"time.end": "0.4 ms", "output.times": "[0.2 ms]", "output.history_interval": "0 s"}
PLATE = STEPS | {"body.spacing": "0.5 m", "body.size": "[40 m, 13 m]"}
SHORT = {"dynamic": PLATE, "the paper's, in windows of one step": PLATE,
         "ball": {"time.end": "1 s", "output.times": "[0.5 s]"}}


def divided(count, command):
    return ["mpirun", "--quiet", "-n", str(count), *command]


class RanksTest(RunTest):
    def divide(self, count, keys, folder, *options, scene=MANDEL, code=0, **more):
        done = subprocess.run(divided(count, run_command(scene, keys, self.folder / folder, *options)),
                              capture_output=True, text=True, timeout=PATIENCE, cwd=self.folder, env=ENVIRONMENT, **more)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        self.said = done.stderr
        return self.folder / folder

    def start(self, count, keys, folder, **more):
        return subprocess.Popen(divided(count, run_command(MANDEL, keys, self.folder / folder)), cwd=self.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT, **more)


class SameBits(RanksTest):
    def assert_processes_change_nothing(self, keys, scene, counts):
        one = self.run_scene(keys, "1", scene=scene)
        for count in counts:
            with self.subTest(scene.stem, processes=count):
                self.assert_same_results(one, self.divide(count, keys, str(count), scene=scene))

    def test_of_saturated_rock(self):
        self.assert_processes_change_nothing(SMALL, MANDEL, (2, 3, 5))

    def test_of_other_modules(self):
        for name, (scene, keys) in VARIANTS.items():
            with self.subTest(name):
                self.setUp()
                self.assert_processes_change_nothing(keys | SHORT.get(name, {}), scene, (3,))

    def test_where_a_crack_grows(self):
        scene = CONFIGS / "hf_storage.yaml"
        keys = {"body.spacing": "5 mm", "time.end": "20 ms", "output.interval": "20 ms"}
        for solid in ("quasi_static", "dynamic"):
            with self.subTest(solid):
                self.setUp()
                self.assert_processes_change_nothing(keys | {"solid.type": solid}, scene, (2,))

    def test_of_free_fluid(self):
        for (name, scene), method in product(FLUIDS.items(), METHODS):
            with self.subTest(name, method=method):
                self.setUp()
                self.assert_processes_change_nothing(STEPS | {"fluid.type": method}, scene, (3,))


class OneVoice(RanksTest):
    def test_a_mistake_is_told_once(self):
        self.divide(3, {"pore_flow.porosity": "2"}, "none", code=2)
        self.assertEqual(self.said.count("out of range"), 1, self.said)
        self.assertFalse((self.folder / "none").exists())

    def test_check_foretells_a_run_of_many(self):
        picture = self.folder / "setup.png"
        words = ["check", str(MANDEL), "--trial", "0.2"]
        done = subprocess.run(divided(2, [*run_command(MANDEL, {}, "none")[:1], *words, "--json", "--picture", str(picture)]),
                              capture_output=True, text=True, env=ENVIRONMENT, timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)  # of one voice
        one = json.loads(perifrac(*words, "--json").stdout)
        self.assertEqual(told["counts"], one["counts"])
        self.assertEqual((told["forecast"]["processes"], one["forecast"]["processes"]), (2, 1))
        self.assertEqual(told["forecast"]["windows"], one["forecast"]["windows"])
        self.assertTrue(picture.exists())
        told["memory"]["available"] *= 2  # shared by the two
        self.assertLess(abs(told["memory"]["available"] / one["memory"]["available"] - 1), 0.3)
        done = subprocess.run(divided(2, [*run_command(MANDEL, {}, "none")[:1], *words]), capture_output=True, text=True,
                              env=ENVIRONMENT, timeout=PATIENCE)
        self.assertRegex(done.stdout, r"run time: .* MB in each of 2 processes,")

    def test_other_verbs_have_no_use_for_many(self):
        done = subprocess.run(divided(2, [*run_command(MANDEL, {}, "none")[:1], "list"]), capture_output=True, text=True,
                              env=ENVIRONMENT, timeout=PATIENCE)
        self.assertEqual(done.returncode, 2)
        self.assertIn("2 processes were started", done.stderr)


class NothingLost(RanksTest):
    def test_a_report_takes_its_time(self):
        """Longer than processes wait for each other where one has failed."""
        command = [word for word in run_command(MANDEL, SMALL, self.folder / "slow") if word != "--no-report"]
        process = subprocess.Popen(divided(2, command), cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        drawing = []
        while not drawing and process.poll() is None:
            drawing = subprocess.run(["pgrep", "-f", f"report.py.*{self.folder}"], capture_output=True,
                                     text=True).stdout.split()
        self.assertTrue(drawing, "no report was begun")
        os.kill(int(drawing[0]), signal.SIGSTOP)
        time.sleep(13)
        os.kill(int(drawing[0]), signal.SIGCONT)
        said = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 0, said)
        self.assertTrue((self.folder / "slow" / "report.html").exists())

    def test_restart_on_other_numbers_of_processes(self):
        whole = self.run_scene(SMALL, "whole")
        parts = self.divide(4, SMALL, "parts", "--until", "5 s")
        self.divide(2, SMALL, "parts", "--restart", str(checkpoints(parts)[-1]), "--until", "9 s")
        self.divide(4, SMALL, "parts", "--restart", str(checkpoints(parts)[-1]))
        self.assert_same_results(whole, parts)

    def wait_for_checkpoint(self, process, folder):
        end = time.monotonic() + PATIENCE
        while len(checkpoints(folder)) < 2:
            self.assertIsNone(process.poll(), "it ended too soon")
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    LONG = SMALL | {"body.spacing": "0.5 m", "time.end": "1000 s", "coupling.window.largest": "20 ms"}

    def go_on(self, folder):
        """A short way, from the last checkpoint."""
        last = checkpoints(folder)[-1]
        self.divide(2, self.LONG, folder.name, "--restart", str(last), "--until", f"{self.time_of(last) + 0.1} s")

    def time_of(self, checkpoint):
        import h5py
        with h5py.File(checkpoint, "r") as file:
            return float(file["time"][()].flat[0])

    def test_a_signal_to_mpirun_ends_all(self):
        process = self.start(3, self.LONG, "stopped")
        self.wait_for_checkpoint(process, self.folder / "stopped")
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=PATIENCE)
        self.assertNotEqual(process.returncode, 0)
        self.go_on(self.folder / "stopped")

    def test_a_process_that_is_killed_ends_all(self):
        process = self.start(3, self.LONG, "killed")
        self.wait_for_checkpoint(process, self.folder / "killed")
        children = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout.split()
        os.kill(int(children[-1]), signal.SIGKILL)
        process.communicate(timeout=PATIENCE)
        self.assertNotEqual(process.returncode, 0)
        self.go_on(self.folder / "killed")

    def test_a_file_that_cannot_be_written_ends_all(self):
        process = self.start(3, self.LONG, "gone")
        self.wait_for_checkpoint(process, self.folder / "gone")
        shutil.rmtree(self.folder / "gone")
        said = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 1)
        self.assertEqual(said.count("perifrac:"), 1, said)
        self.assertIn(str(self.folder / "gone"), said)


if __name__ == "__main__":
    unittest.main()
