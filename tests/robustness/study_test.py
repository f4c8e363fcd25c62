"""A study some of whose variants fail in every way that there is, stopped and taken up again.

Usage: study_test.py PERIFRAC
"""
import csv
import fcntl
import json
import signal
import subprocess
import time
import unittest

from perifrac_runs import MANDEL, PATIENCE, PERIFRAC, RunTest, perifrac

# Mandel's problem, small enough for a blink; what differs makes it fail.
STUDY = f"""
scene: {MANDEL}
set: {{body.spacing: 2 m, time.end: 2 s, output.times: [1 s]}}
axes:
  - name: way
    values:
      fine: {{}}
      coarse: {{coupling.window.largest: 2 s, coupling.window.first: 1 s}}
      divergent:
        coupling.split: drained
        coupling.acceleration: none
        coupling.iterations.max: 30
        coupling.window.first: 100 ms
      killed: {{}}
      invalid: {{body.spacing: 0.3 m}}
      out of range: {{pore_flow.porosity: 3}}
      endless: {{time.end: 1e7 s, output.times: []}}
error: {{against: reference, quantity: pressure_error}}
accuracies: [0.5, 1e-9]
repetitions: 2
budget: {{each: 4 s}}
"""
LAUNCHER = """#!/bin/sh
case "$*" in */killed*) kill -9 $$ ;; esac
exec "$@"
"""
STATUSES = {"fine": "done", "coarse": "done", "divergent": "diverged", "killed": "killed", "invalid": "invalid",
            "outofrange": "invalid", "endless": "over budget"}


class StudyTest(RunTest):
    def setUp(self):
        super().setUp()
        self.study = self.folder / "study.yaml"
        self.study.write_text(STUDY)
        launcher = self.folder / "launcher.sh"
        launcher.write_text(LAUNCHER)
        launcher.chmod(0o755)
        self.options = ["study", str(self.study), "--output", str(self.folder / "out"), "--launcher", str(launcher)]

    def record(self, name):
        return self.folder / "out" / "variants" / name / "record.json"

    def wait_for(self, condition, process):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertIsNone(process.poll(), "the study ended early")
            self.assertLess(time.monotonic(), end, "nothing happened")
            time.sleep(0.02)

    def stop(self, number):
        """Starts the study and stops it while its endless variant runs; gives the exit code."""
        begun = self.folder / "out/variants/endless/history.csv"
        begun.unlink(missing_ok=True)
        process = subprocess.Popen([PERIFRAC, *self.options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(process.stderr.close)
        self.wait_for(begun.exists, process)
        process.send_signal(number)
        said = process.communicate(timeout=PATIENCE)[1].decode()
        self.assertIn("6 of 7 variants on record", said)
        return process.returncode

    def finish(self, *more):
        done = perifrac(*self.options, *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_every_failure_is_a_marked_point_and_the_study_goes_on_where_it_was_stopped(self):
        self.assertEqual(self.stop(signal.SIGINT), 130)
        self.assertFalse(self.record("endless").exists())
        names = [name for name in STATUSES if self.record(name).exists()]
        self.assertEqual(len(names), 5)  # what the scene's keys refuse needs no run
        before = {name: self.record(name).stat().st_mtime_ns for name in names}
        self.assertEqual(self.stop(signal.SIGTERM), 143)

        done = self.finish()
        self.assertEqual({name: self.record(name).stat().st_mtime_ns for name in names}, before)
        result = json.loads((self.folder / "out/study.json").read_text())
        self.assertEqual({v["name"]: v["status"] for v in result["variants"]}, STATUSES)
        messages = {v["name"]: v["message"] for v in result["variants"]}
        self.assertIn("coupling strength", messages["divergent"])
        self.assertIn("signal 9", messages["killed"])
        self.assertIn("whole number of spacings", messages["invalid"])
        self.assertRegex(messages["outofrange"], r"study\.yaml:\d+:\d+: pore_flow\.porosity: '3' is out of range")
        self.assertIn("4 s", messages["endless"])
        errors = {v["name"]: v["error"] for v in result["variants"]}
        self.assertEqual([name for name, error in errors.items() if error is not None], ["fine", "coarse"])
        for sentence in ("To reach 0.5 the cheapest is", "No variant reaches 1e-09; the best, fine,", "1 diverged: divergent",
                         "1 killed: killed", "1 invalid: invalid", "1 over budget: endless"):
            self.assertIn(sentence, done.stdout)

        again = self.finish()
        self.assertIn("6 kept from before", again.stderr)
        self.assertEqual({name: self.record(name).stat().st_mtime_ns for name in names}, before)

    def test_killed_outright_it_takes_its_runs_along_and_goes_on(self):
        begun = self.folder / "out/variants/endless/history.csv"
        process = subprocess.Popen([PERIFRAC, *self.options], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for(begun.exists, process)
        process.kill()
        process.wait()
        with open(begun.parent / ".lock", encoding="utf-8") as lock:
            end = time.monotonic() + 20
            while True:
                try:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    break
                except BlockingIOError:
                    self.assertLess(time.monotonic(), end, "the run goes on")
                    time.sleep(0.05)
        self.assertEqual(self.stop(signal.SIGINT), 130)

    def test_leaves_tables_and_pictures(self):
        self.finish("--jobs", "2")
        folder = self.folder / "out"
        with open(folder / "study.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["variant"] for row in rows], list(STATUSES))
        self.assertEqual([row["status"] for row in rows], list(STATUSES.values()))
        fine = rows[0]
        self.assertEqual(fine["runs"], "2")
        self.assertGreater(float(fine["pore_flow rhs_evaluations"]), 0)
        self.assertGreater(float(fine["solid cpu_time [s]"]), 0)
        self.assertAlmostEqual(float(fine["cost [s]"]),
                               float(fine["wall_time [s]"]) - float(fine["output_time [s]"]), places=9)
        self.assertEqual((folder / "table.md").read_text().count("\n"), 2 + len(STATUSES))
        self.assertIn("\\end{tabular}", (folder / "table.tex").read_text())
        self.assertTrue((folder / "study.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("<svg", (folder / "study.svg").read_text())
        page = (folder / "study.html").read_text()
        for name in STATUSES:
            self.assertIn(name, page)
        self.assertNotRegex(page, r'(src|href)="http')

    def test_a_larger_budget_and_retry_take_up_what_failed(self):
        self.finish("--no-report")
        fine, killed = (self.record(name).stat().st_mtime_ns for name in ("fine", "killed"))
        self.study.write_text(STUDY.replace("{each: 4 s}", "{each: 5 s}"))
        self.finish("--no-report")
        self.assertEqual(json.loads(self.record("endless").read_text())["budget"], 5)
        self.assertEqual(self.record("killed").stat().st_mtime_ns, killed)
        self.study.write_text(STUDY.replace("endless:", "# endless:"))
        self.options[-1] = "env"
        result = json.loads(self.finish("--no-report", "--retry", "--json").stdout)
        self.assertEqual([v["status"] for v in result["variants"] if v["name"] == "killed"], ["done"])
        self.assertEqual(self.record("fine").stat().st_mtime_ns, fine)

    def test_what_the_study_has_no_time_for_is_said(self):
        self.study.write_text(STUDY.replace("{each: 4 s}", "{each: 4 s, total: 1 ms}"))
        done = self.finish("--no-report")
        self.assertIn("not run", done.stdout)
        self.assertIn("the study's 0.001 s were used up", done.stdout)

    def test_one_study_a_folder(self):
        process = subprocess.Popen([PERIFRAC, *self.options], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.wait_for((self.folder / "out/variants").exists, process)
        other = perifrac(*self.options)
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=PATIENCE)
        self.assertEqual(other.returncode, 2)
        self.assertIn("another run is writing into it", other.stderr)

    def test_mistakes_are_one_line_and_nothing_is_written(self):
        cases = [
            ("quantity: pressure_error", "quantity: pressure_eror", [], "did you mean 'pressure_error'?"),
            ("way", "way", ["--launcher", "no_such_program"], "no_such_program: could not be run"),
            ("  - name: way", "  - nme: way", [], f"{self.study}:5:5: axes[0]: unknown key 'nme'; expected one of: name"),
            ("largest: 2 s", "lagest: 2 s", [], "unknown key 'lagest' of the scene"),
        ]
        for old, new, options, expected in cases:
            with self.subTest(new + str(options)):
                self.study.write_text(STUDY.replace(old, new, 1))
                done = perifrac("study", self.study, "--output", self.folder / f"wrong {new}{options}", *options)
                self.assertEqual(done.returncode, 2)
                self.assertIn(expected, done.stderr.splitlines()[-1])
                self.assertEqual(done.stdout, "")
        done = perifrac("study", self.folder / "none.yaml")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()
