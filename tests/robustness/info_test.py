#!/usr/bin/python3
"""`perifrac info` of every file that a run leaves, scenes by name, the manual page and completion."""
import json
import re
import subprocess
import unittest

from perifrac_runs import CONFIGS, MANDEL, RunTest, SMALL, perifrac, settings


class Info(RunTest):
    def info(self, file):
        done = perifrac("info", file, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""), file)
        text = perifrac("info", file)
        said = json.loads(done.stdout)
        self.assertTrue(text.stdout.startswith(f"{said['file']}: {said['what']}, {said['bytes']} bytes\n"))
        return said

    def test_of_all_files_of_a_run(self):
        run = self.folder / "run"
        done = perifrac("run", MANDEL, *settings(SMALL), "--json", "--output", run)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout)
        rows = (run / "history.csv").read_text().splitlines()
        kinds = {}
        for file in sorted(run.rglob("*")):
            if file.is_dir() or file.name == ".lock":
                continue
            said = self.info(file)
            kinds.setdefault(said["what"], said)
            self.assertEqual(said["bytes"], file.stat().st_size)
            self.assertEqual((said["title"], said["version"]), (summary["scene"]["title"], summary["version"]), file)
        self.assertEqual(set(kinds), {"checkpoint", "frame", "list of frames", "history of a run", "summary of a run",
                                      "picture of a run", "page about a run"})
        points = summary["counts"]["points"]
        self.assertEqual(kinds["frame"]["points"], points)
        self.assertEqual(kinds["frame"]["fields"]["pore_pressure"], {"components": 1, "unit": "Pa"})
        self.assertEqual(kinds["checkpoint"]["fields"]["pore_flow/pore_pressure"]["value"], points)
        history = kinds["history of a run"]
        self.assertEqual(history["rows"], len(rows) - 1)
        self.assertEqual(len(history["columns"]), len(rows[0].split(",")))
        self.assertEqual(history["times"]["to"]["value"], summary["time"]["value"])
        self.assertEqual(kinds["list of frames"]["missing"], 0)
        self.assertEqual(kinds["summary of a run"]["instructions"], summary["build"]["instructions"])
        self.assertEqual(self.info(run)["what"], "summary of a run")
        self.assertEqual(perifrac("export", run, "--frame", "first").returncode, 0)
        self.assertEqual(perifrac("export", run, "--frame", "first", "--to", "csv").returncode, 0)
        for name, what in (("body.pvd", "list of exported frames"), ("body_000000.vtu", "frame as cells"),
                           ("body_000000.csv", "frame as a table")):
            self.assertEqual(self.info(run / "export" / name)["what"], what)
        cells, table = (self.info(run / "export" / f"body_000000.{kind}") for kind in ("vtu", "csv"))
        self.assertEqual((cells["cells"], table["points"]), (points, points))
        self.assertEqual(cells["fields"]["pore_pressure"], {"unit": "Pa"})
        self.assertEqual(table["columns"]["effective_stress xy"], {"unit": "Pa"})
        self.assertEqual(cells["title"], summary["scene"]["title"])
        self.assertEqual(perifrac("report", run, run).returncode, 0)
        self.assertEqual(self.info(run / "compared_with_run.html")["what"], "page about a run")
        next((run / "frames").glob("*_000000.hdf")).unlink()
        self.assertEqual(self.info(run / "frames" / "body.hdf.series")["missing"], 1)

    def test_of_scenes(self):
        self.assertEqual(self.info(MANDEL)["what"], "scene")
        self.assertEqual(self.info(CONFIGS / "studies" / "notch.yaml")["what"], "study to be run")

    def test_refuses_what_it_does_not_know(self):
        strange = self.folder / "strange.csv"
        for content in (b"", b"a,b\n1,2\n", b"{}", b"{", b"\x89HDF\r\n\x1a\nnot", b"perifrac checkpoint, format 9\n"):
            strange.write_bytes(content)
            self.assert_refused(perifrac("info", strange), "strange.csv")
        self.assert_refused(perifrac("info", self.folder), "holds no run")
        self.assert_refused(perifrac("info", self.folder / "none"), "none")


class Example(RunTest):
    def test_runs_a_shipped_scene_by_name(self):
        done = perifrac("run", "--example", "mandel", *settings(SMALL), "--no-report", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue((self.folder / "runs" / "mandel" / "summary.json").exists())
        for name in ("hf_storage", "paper/mandel"):
            self.assertEqual(perifrac("check", "--example", name, "--trial", "0", cwd=self.folder).returncode, 0)

    def test_lists_names(self):
        done = perifrac("run", "--example", "mandal", cwd=self.folder)
        self.assert_refused(done, "did you mean 'mandel'?")
        for scene in CONFIGS.glob("*.yaml"):
            self.assertIn(f" {scene.stem}", done.stderr)
        self.assert_refused(perifrac("run", MANDEL, "--example", "mandel"), "--example")


class Pages(unittest.TestCase):
    def setUp(self):
        self.verbs = re.findall(r"^  ([a-z]+)  ", perifrac("--help").stdout.split("Subcommands:")[1], re.M)
        self.assertIn("info", self.verbs)

    def test_manual_has_all_verbs_and_options(self):
        page = perifrac("man").stdout.replace("\\-", "-")
        for verb in self.verbs:
            self.assertIn(f".SS perifrac {verb}", page)
            for option in re.findall(r"--[a-z-]+", perifrac(verb, "--help").stdout):
                self.assertIn(option, page + "--help")
        self.assertIn("\\fIN\\fR\n", perifrac("man").stdout, "no range in the word for a value")
        formatted = subprocess.run(["groff", "-man", "-Tascii", "-ww", "-z"], input=perifrac("man").stdout,
                                   capture_output=True, text=True, check=False)  # fmt: skip
        self.assertEqual((formatted.returncode, formatted.stderr), (0, ""))

    def completed(self, *words):
        script = perifrac("completion", "bash").stdout + (
            'compopt() { :; }\nCOMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _perifrac; printf "%s\\n" "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-c", script, "bash", "perifrac", *words], capture_output=True, text=True,
                              check=False)  # fmt: skip
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.split()

    def test_bash_completes(self):
        self.assertEqual(sorted(self.completed("")), sorted([*self.verbs, "--help", "--version"]))
        self.assertEqual(self.completed("run", "--exa"), ["--example"])
        self.assertEqual(self.completed("run", "--set", "pore_flow.poros"), ["pore_flow.porosity="])
        self.assertIn("crack_fluid.inlets[0].rate=", self.completed("run", "x.yaml", "--set", "crack_fluid.inlets"))
        self.assertIn("mandel_dynamic", self.completed("check", "--example", "mandel"))
        self.assertEqual(self.completed("new", "kg"), ["kgd"])
        self.assertEqual(self.completed("explain", "pore_flow.poros"), ["pore_flow.porosity"])
        self.assertEqual(self.completed("run", "mand"), [], "files are the shell's own")

    def test_other_shells_name_all_verbs(self):
        for shell in ("zsh", "fish"):
            script = perifrac("completion", shell).stdout
            for word in (*self.verbs, "pore_flow.porosity=", "kgd", "mandel"):
                self.assertIn(word, script)
        self.assertEqual(perifrac("completion", "csh").returncode, 2)


if __name__ == "__main__":
    unittest.main()
