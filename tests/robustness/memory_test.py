#!/usr/bin/python3
"""Too little memory, or too small a stack: the program says so; it neither hangs nor dies without a word."""
import json
import os
import resource
import unittest

from perifrac_runs import CONFIGS, MANDEL, RunTest, perifrac, settings

BLOCKS = CONFIGS.parent / "bench" / "benchmarks"
MEGABYTE = 1 << 20
SHORT = {"body.spacing": "4 m", "time.end": "1 s", "output.times": "[]"}
FINE = {"body.spacing": "0.2 mm", "solid.linear_solver.type": "direct"}  # 750,000 points: more than 10 GB


def limited(which, size):
    return {"preexec_fn": lambda: resource.setrlimit(which, (size, size))}


class Memory(RunTest):
    def test_any_address_space(self):
        """OpenBLAS takes 128 MB at a time, some when it is first used, and tries for ever where there is none."""
        ended_well = 0
        for threads in ("1", "2"):
            for size in range(100, 621, 20):
                with self.subTest(size=size, threads=threads):
                    done = perifrac("run", MANDEL, "--no-report", "--output", self.folder / "run", *settings(SHORT),
                                    env=os.environ | {"OMP_NUM_THREADS": threads},
                                    **limited(resource.RLIMIT_AS, size * MEGABYTE))
                    if done.returncode == 127:  # the loader's own words: the program did not begin
                        continue
                    self.assertIn(done.returncode, (0, 1), done.stderr)
                    self.assertTrue(done.returncode == 0 or "memory" in done.stderr, done.stderr)
                    ended_well += done.returncode == 0
        self.assertGreater(ended_well, 0)

    def test_no_room_for_the_second_buffer_of_one_thread(self):
        """A larger scene has taken what is there when a factor is first made."""
        keys = {"body.spacing": "2.5 mm", "time.end": "1 ms"}
        for size in (380, 420):
            with self.subTest(size=size):
                done = perifrac("run", CONFIGS / "hf_storage.yaml", "--no-report", "--output", self.folder / "run",
                                *settings(keys), env=os.environ | {"OMP_NUM_THREADS": "1"},
                                **limited(resource.RLIMIT_AS, size * MEGABYTE))
                self.assertIn(done.returncode, (0, 1, 2), done.stderr)
                self.assertTrue(done.returncode == 0 or "memory" in done.stderr, done.stderr)

    def test_any_stack(self):
        """METIS calls itself."""
        crack = CONFIGS / "hf_storage.yaml"
        keys = {"body.spacing": "5 mm", "time.end": "10 ms"}
        for size in (32, 64, 256, 1024):
            with self.subTest(size=size):
                done = perifrac("run", crack, "--no-report", "--output", self.folder / "run", *settings(keys),
                                **limited(resource.RLIMIT_STACK, size << 10))
                self.assertEqual(done.returncode, 0 if size == 1024 else 1, done.stderr)
                self.assertTrue(done.returncode == 0 or done.stderr.startswith("perifrac: the stack is too small"))
        # One that may grow does.
        done = perifrac("check", crack, *settings(keys), "--trial", "0", preexec_fn=lambda: resource.setrlimit(
            resource.RLIMIT_STACK, (64 << 10, 8 * MEGABYTE)))
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_check_says_what_does_not_fit(self):
        limit = limited(resource.RLIMIT_AS, 2048 * MEGABYTE)
        done = perifrac("check", CONFIGS / "hf_storage.yaml", "--json", *settings(FINE), **limit)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        said = json.loads(done.stdout)
        self.assertEqual(said["counts"]["points"], 750000)
        self.assertIn("too large to be tried here", said["warnings"][-1])
        self.assertGreater(said["memory"]["estimate"], 10e9)
        self.assertLess(said["memory"]["available"], 2048 * MEGABYTE)
        self.assertIn("warning: too large", perifrac("check", CONFIGS / "hf_storage.yaml", *settings(FINE), **limit).stdout)

    def test_a_trial_that_takes_more_than_was_thought(self):
        """The estimate knows nothing of the horizon's influence on a factor, for one."""
        done = perifrac("check", CONFIGS / "cryer.yaml", "--json", "--trial", "0.1", "--set", "body.horizon_ratio=3.5",
                        "--set", "solid.linear_solver.type=direct",
                        **limited(resource.RLIMIT_AS, 2300 * MEGABYTE))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        said = json.loads(done.stdout)["warnings"][-1]
        self.assertRegex(said, "ran out of memory|too large to be tried")

    def test_a_run_that_cannot_fit_is_refused(self):
        done = perifrac("run", CONFIGS / "hf_storage.yaml", "--output", self.folder / "run", *settings(FINE),
                        **limited(resource.RLIMIT_AS, 2048 * MEGABYTE))
        self.assert_refused(done, "body.spacing", "GB for 750000 points")
        self.assertFalse((self.folder / "run").exists())

    def test_the_estimate(self):
        """Good to a factor of 1.5 or so, of what a run takes beyond the program itself."""
        own = json.loads(perifrac("check", MANDEL, "--json", *settings(SHORT)).stdout)["forecast"]["peak_memory"]
        for scene, keys in ((MANDEL, {"body.spacing": "0.5 m"}), (CONFIGS / "plate_3d.yaml", {}),
                            (CONFIGS / "mandel_dynamic.yaml", {"body.spacing": "0.1 m"}),
                            (CONFIGS / "drained_plate.yaml", {"body.spacing": "0.04 m"}),
                            *((BLOCKS / name, {"body.size": "[40 m, 40 m, 40 m]", "body.horizon_ratio": ratio})
                              for name in ("explicit.yaml", "equilibrium.yaml") for ratio in (2, 3))):
            with self.subTest(scene=scene.name, keys=keys):
                said = json.loads(perifrac("check", scene, "--json", "--trial", "0.01", *settings(keys)).stdout)
                taken = said["forecast"]["peak_memory"] - own
                self.assertLess(said["memory"]["estimate"], 1.6 * taken)
                self.assertGreater(said["memory"]["estimate"], taken / 1.6)


if __name__ == "__main__":
    unittest.main()
