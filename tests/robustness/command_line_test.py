#!/usr/bin/python3
"""Verbs, options, exit codes; one JSON document where JSON is asked for."""
import json
import os
import unittest

from perifrac_runs import CONFIGS, HERE, MANDEL, PERIFRAC, RunTest, SMALL, perifrac, settings


class CommandLine(RunTest):
    def test_version_and_help(self):
        for arguments in (["--version"], ["--help"], ["run", "--help"], ["check", "--help"], ["list", "--help"],
                          ["report", "--help"]):
            with self.subTest(arguments):
                done = perifrac(*arguments)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertTrue(done.stdout)
        self.assertRegex(perifrac("--version").stdout, r"^perifrac \d+\.\d+\.\d+\n$")

    def test_misuse_gets_one_line(self):
        for arguments, word in ((["frobnicate"], "frobnicate"), ([], "a verb is missing"), (["run"], "scene"),
                                (["run", MANDEL, "--frobnicate"], "--frobnicate"),
                                (["run", MANDEL, "extra"], "extra"), (["list", "extra"], "extra"),
                                (["report"], "folder"), (["report", self.folder / "none"], "none"),
                                (["run", MANDEL, "--threads", "0"], "--threads"),
                                (["run", MANDEL, "--threads", "-1"], "--threads"),
                                (["run", MANDEL, "--threads", "two"], "--threads"),
                                (["run", MANDEL, "--threads", "0x1"], "--threads"),
                                (["check", MANDEL, "--trial", "nan"], "--trial"),
                                (["study", MANDEL, "--jobs", "1.0"], "--jobs"),
                                (["watch", ".", "--port", "0x1"], "--port"),
                                (["run", MANDEL, "--until", "soon"], "--until"),
                                (["run", MANDEL, "--until", "0 s"], "--until"),
                                (["run", MANDEL, "--until", "-1 s"], "--until"),
                                (["run", MANDEL, "--until", "2 m"], "--until"),
                                (["run", MANDEL, "--until", "nan"], "--until"),
                                (["run", MANDEL, "--set", "pore_flow.porosity"], "key=value"),
                                (["run", MANDEL, "--set", "pore_flow.porosty=1"], "porosity"),
                                (["run", MANDEL, "--set", "pore_flow.porosity=2"], "range"),
                                (["run", MANDEL, "--set", "pore_flow.porosity=[1"], "porosity"),
                                (["run", self.folder], str(self.folder))):
            with self.subTest(arguments):
                done = perifrac(*arguments, cwd=self.folder)
                self.assert_refused(done, word)
                self.assertEqual(list(self.folder.iterdir()), [])

    def test_run_prints_one_document(self):
        done = perifrac("run", MANDEL, *settings(SMALL), "--json", "--output", self.folder / "run")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(json.loads(done.stdout), json.loads((self.folder / "run" / "summary.json").read_text()))

    def test_bytes_that_are_no_text_do_not_spoil_the_summary(self):
        scene = self.folder / "latin.yaml"
        scene.write_bytes((HERE / "solid_only.yaml").read_bytes() + "# 20 °C\n".encode("latin-1"))
        done = perifrac("run", scene, "--no-report", "--output", self.folder / "run")
        # Either is honest; half a run is not.
        self.assertIn(done.returncode, (0, 2), done.stderr)
        if done.returncode == 0:
            json.loads((self.folder / "run" / "summary.json").read_text())
        else:
            self.assertFalse((self.folder / "run").exists())

    def test_check_lists_what_is_on_and_writes_nothing(self):
        done = perifrac("check", MANDEL, "--json", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        said = json.loads(done.stdout)
        self.assertEqual(said["counts"]["points"], 800)
        self.assertEqual(said["effects"], ["pore_flow: darcy", "solid: quasi_static"])
        self.assertEqual(sorted(said["modules"]), ["pore_flow", "solid"])
        sizes = {array["name"]: array["count"] for array in said["arrays"]}
        self.assertEqual(sizes["pore_flow/pore_pressure"], 800)
        self.assertTrue(perifrac("check", MANDEL, cwd=self.folder).stdout)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_check_and_run_say_what_was_read(self):
        scene = CONFIGS / "hf_leakoff_pores.yaml"
        sets = settings({"body.spacing": "5 mm", "pore_flow.initial_pressure": "1 MPa", "damage": "{type: "
                         "energy_release, fracture_toughness: 0.1 MPa*sqrt(m)}"})
        said = json.loads(perifrac("check", scene, *sets, "--trial", "0", "--json").stdout)["read"]
        self.assertIn("crack 'notch' is closed by 1.9 MPa", said, "0.9 MPa of the rock, 1 of the pores")
        self.assertIn("toughness: fracture energy 2.34375 J/m^2, with E' = 4.26667e+09 Pa a K_IC of 0.1 MPa*sqrt(m)",
                      said)
        stress = next(line for line in said if line.startswith("stress at rest"))
        self.assertRegex(stress, r"effective \(0.9, 0.45\) MPa, with 1 of 1 MPa in the pores a total of \(1.9, 1.45\)")
        self.assertIn("permeability 1.02e-14 m^2", next(line for line in said if line.startswith("read pore_flow")))
        run = perifrac("run", scene, *sets, "--until", "1 us", "--no-report", "--output", self.folder / "run")
        self.assertEqual(run.stdout.splitlines()[:len(said)], said)

    def test_check_foretells_what_a_run_takes(self):
        def foretold(*arguments):
            done = perifrac("check", *arguments, "--json", cwd=self.folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return json.loads(done.stdout).get("forecast")

        run = perifrac("run", MANDEL, "--json", "--no-report", "--output", self.folder / "run")
        windows = json.loads(run.stdout)["counts"]["windows"]
        whole, part = foretold(MANDEL, "--trial", "100"), foretold(MANDEL, "--trial", "1e-9")
        self.assertTrue(whole["trial"]["is_whole"])
        self.assertFalse(part["trial"]["is_whole"])
        for said in (whole, part):
            self.assertEqual(said["windows"], windows)
            self.assertAlmostEqual(sum(said["seconds_by_part"].values()), said["seconds"], delta=1e-9)
            self.assertEqual(set(said["seconds_by_part"]), {"building", "coupling", "pore_flow", "solid"})
            self.assertGreaterEqual(min(said["seconds_by_part"].values()), 0.0)
        self.assertIsNone(foretold(MANDEL, "--trial", "0"))
        self.assertNotIn("crack_length", whole)
        # A crack gets as long as on points five times as far apart, or, in a body as good as infinite, as its
        # regime says: 0.1457 m it would be of the first.
        coarse = foretold(CONFIGS / "hf_storage.yaml", "--trial", "1", "--set", "body.spacing=2.5 mm")
        self.assertAlmostEqual(coarse["crack_length"]["value"], 0.113, delta=0.011)
        infinite = foretold(CONFIGS / "kgd_mixed.yaml", "--trial", "0.001", "--set", "body.spacing=10 mm")
        self.assertAlmostEqual(infinite["crack_length"]["value"], 0.1014, delta=1e-4)
        # What stops a run stops the trial.
        wild = foretold(MANDEL, "--trial", "100", "--set", "coupling.split=drained", "--set", "coupling.iterations.max=3",
                        "--set", "coupling.window.retries=0", "--set", "pore_flow.fluid.bulk_modulus=200 GPa")
        self.assertIn("the coupling does not converge", wild["failure"])
        self.assertFalse(wild["trial"]["is_whole"])

    def test_a_trial_ends_in_the_midst_of_a_window(self):
        """The first window takes some 1e11 steps."""
        keys = {"pore_flow.integrator.type": "explicit", "pore_flow.permeability": "1e-6 m^2", "time.end": "1e9 s",
                "output.interval": "1e9 s"}
        done = perifrac("check", HERE / "pore_flow_only.yaml", "--json", "--trial", "0.1", *settings(keys))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        forecast = json.loads(done.stdout)["forecast"]
        self.assertLess(forecast["trial"]["time"], 1.0)
        self.assertFalse(forecast["trial"]["is_whole"])
        self.assertGreater(forecast["seconds"], 1e6)

    def test_check_says_the_regime_of_a_crack_that_fluid_drives(self):
        def check(scene, *keys):
            overrides = [word for key in keys for word in ("--set", key)]
            done = perifrac("check", CONFIGS / scene, "--json", "--trial", "0", *overrides)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return json.loads(done.stdout)

        coarse = "body.spacing=10 mm"
        said = check("kgd_mixed.yaml", coarse)
        self.assertEqual(said["regime"]["corner"], "viscosity and toughness; storage")
        self.assertAlmostEqual(said["regime"]["dimensionless_toughness"], 1.16, delta=1e-3)
        self.assertAlmostEqual(said["regime"]["length"]["value"], 0.1014, delta=1e-4)
        self.assertAlmostEqual(said["regime"]["lag_time"]["value"], 2.478e-4, delta=1e-7)
        self.assertEqual(said["warnings"], [])
        self.assertIn("regime: viscosity", perifrac("check", CONFIGS / "kgd_mixed.yaml", "--trial", "0", "--set", coarse).stdout)
        # The words go by what leaks, and so does the printed number of a crack from a face.
        for scene, words, least, most in (("hf_leakoff", "viscosity; mostly leak-off", 800, 900),
                                          ("hf_leakoff_stiff_water", "viscosity; storage and leak-off", 0.05, 0.06),
                                          ("hf_storage_pores", "viscosity and toughness; mostly storage", 0, 1e-4)):
            regime = check(scene + ".yaml", "body.spacing=5 mm")["regime"]
            self.assertEqual(regime["corner"], words)
            self.assertTrue(least < regime["leak_off_over_toughness"] < most, regime)
        # Twice the time, and next to no stress: the crack grows too long, and its tip stays dry.
        little_stress = "solid.confining_stress=[0.1 MPa, 0.1 MPa]"
        far, dry = check("kgd_mixed.yaml", coarse, "time.end=0.2 s", little_stress)["warnings"]
        self.assertIn("the reference `kgd` are those of an infinite body", far)
        self.assertIn("the reference `kgd` has no fluid lag", dry)
        # A short dry tip that no points resolve is of little account, a long one is.
        unresolved = check("kgd_mixed.yaml", coarse, "time.end=0.04 s", "crack_fluid.viscosity=0.2 Pa s", little_stress)
        self.assertIn("too coarse for a fluid lag", unresolved["warnings"][-1])
        # A rate into one wing is half of that into two; pumping stops when half is in.
        one = check("hf_storage.yaml", "body.spacing=5 mm",
                    "crack_fluid.inlets[0].schedule={times: [50 ms, 50.001 ms], factors: [1, 0]}")
        self.assertAlmostEqual(one["regime"]["dimensionless_toughness"], 1.1598 / 2**0.25, delta=1e-3)
        self.assertAlmostEqual(one["regime"]["time"]["value"], 0.05, delta=1e-6)
        self.assertNotIn("regime", check("mandel.yaml"))

    def test_list(self):
        said = json.loads(perifrac("list", "--json").stdout)
        self.assertIn({"fluid", "crack_fluid", "pore_flow", "solid"}, [{module["section"] for module in said["modules"]}])
        text = perifrac("list").stdout
        for module in said["modules"]:
            self.assertIn(f"{module['section']}: {module['type']}", text)
        for key in said["keys"]:
            self.assertTrue(key["meaning"], key["path"])

    def test_output_that_cannot_be_printed_is_not_called_a_success(self):
        for arguments in (["list"], ["list", "--json"], ["check", MANDEL, "--json"], ["--version"], ["--help"]):
            with self.subTest(arguments), open("/dev/full", "w", encoding="utf-8") as full:
                command = [PERIFRAC, *map(str, arguments)]
                self.assertNotEqual(os.waitstatus_to_exitcode(_run_into(command, full)), 0)


    def test_standard_files_that_are_closed(self):
        """What is printed does not go into a file of the run."""
        for closed in ([1], [2], [0, 1, 2]):
            with self.subTest(closed=closed):
                folder = self.folder / "run"
                command = [PERIFRAC, "run", str(MANDEL), "--no-report", "--output", str(folder), *settings(SMALL)]
                actions = [(os.POSIX_SPAWN_CLOSE, number) for number in closed]
                process = os.posix_spawn(command[0], command, os.environ, file_actions=actions)
                code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
                self.assertEqual(code, 1 if 1 in closed else 0)
                self.assertEqual((folder / ".lock").read_bytes(), b"")
                self.assertTrue((folder / "history.csv").read_text().startswith("time [s],step"))
                json.loads((folder / "summary.json").read_text())


def _run_into(command, file):
    null = os.open(os.devnull, os.O_WRONLY)
    actions = [(os.POSIX_SPAWN_DUP2, file.fileno(), 1), (os.POSIX_SPAWN_DUP2, null, 2)]
    process = os.posix_spawn(command[0], command, os.environ, file_actions=actions)
    os.close(null)
    return os.waitpid(process, 0)[1]


if __name__ == "__main__":
    unittest.main()
