#!/usr/bin/python3
"""`run --profile` says where time and memory went, and changes nothing else."""
import json
import re
import subprocess
import unittest

from perifrac_runs import HERE, MANDEL, PATIENCE, RunTest, SMALL, run_command


class Profile(RunTest):
    def run_profiled(self, scene, keys, folder):
        done = subprocess.run(run_command(scene, keys, self.folder / folder, "--profile"), capture_output=True,
                              text=True, timeout=PATIENCE, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr, json.loads((self.folder / folder / "summary.json").read_text())["profile"]

    def test_results_are_the_same_and_only_it_says_so(self):
        plain = self.run_scene(SMALL, "plain")
        table, profile = self.run_profiled(MANDEL, SMALL, "profiled")
        self.assert_same_frames(plain, self.folder / "profiled")
        self.assert_same_history(plain, self.folder / "profiled")
        self.assertNotIn("profile", json.loads((plain / "summary.json").read_text()))
        for name in ("pore_flow", "solid", "exchange", "families", "factorisation", "in none of them"):
            self.assertRegex(table, rf"(?m)^ *{re.escape(name)} ")

    def test_parts_lie_within_each_other(self):
        _, profile = self.run_profiled(MANDEL, SMALL, "run")
        rounding = 1e-9 * profile["seconds"]

        def check(parts, whole):
            self.assertLessEqual(sum(part["seconds"] for part in parts), whole + rounding)
            for part in parts:
                self.assertGreaterEqual(part["seconds"], 0.0)
                self.assertGreater(part["calls"], 0)
                check(part.get("parts", []), part["seconds"])

        check(profile["parts"], profile["seconds"])
        named = sum(part["seconds"] for part in profile["parts"])
        self.assertAlmostEqual(named + profile["unaccounted"]["seconds"], profile["seconds"], delta=rounding)

    def test_memory_is_measured_and_counted(self):
        _, coarse = self.run_profiled(MANDEL, {**SMALL, "body.spacing": "2 m"}, "coarse")
        _, fine = self.run_profiled(MANDEL, {**SMALL, "body.spacing": "1 m"}, "fine")
        if "-fsanitize" in json.loads((self.folder / "fine" / "summary.json").read_text())["build"]["flags"]:
            self.skipTest("a sanitizer keeps the heap to itself")

        def set_up(profile):
            return {part["name"]: part for part in
                    next(part for part in profile["parts"] if part["name"] == "set-up")["parts"]}

        for name in ("solid", "pore_flow"):
            for profile in (coarse, fine):
                # What it holds are its fields, and more.
                self.assertGreater(set_up(profile)[name]["heap_bytes"], set_up(profile)[name]["field_bytes"])
            ratio = set_up(fine)[name]["field_bytes"] / set_up(coarse)[name]["field_bytes"]
            self.assertGreater(ratio, 3.5)  # four times the points
            self.assertLess(ratio, 4.5)

    def test_names_what_the_scene_calls_for_alone(self):
        _, profile = self.run_profiled(HERE / "solid_only.yaml", {}, "run")
        names = json.dumps(profile)
        for absent in ("pore_flow", "fluid", "damage", "leak-off"):
            self.assertNotIn(f'"{absent}"', names)


if __name__ == "__main__":
    unittest.main()
