#!/usr/bin/python3
"""Verbs, options, exit codes; one JSON document where JSON is asked for."""
import json
import os
import unittest

from perifrac_runs import HERE, MANDEL, PERIFRAC, RunTest, SMALL, perifrac, settings


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


def _run_into(command, file):
    null = os.open(os.devnull, os.O_WRONLY)
    actions = [(os.POSIX_SPAWN_DUP2, file.fileno(), 1), (os.POSIX_SPAWN_DUP2, null, 2)]
    process = os.posix_spawn(command[0], command, os.environ, file_actions=actions)
    os.close(null)
    return os.waitpid(process, 0)[1]


if __name__ == "__main__":
    unittest.main()
