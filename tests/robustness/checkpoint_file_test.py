#!/usr/bin/python3
"""A checkpoint that cannot be used is refused in one line, and nothing is written."""
import random
import unittest

from perifrac_runs import MANDEL, RunTest, SMALL, checkpoints, perifrac, settings

SHORT = SMALL | {"time.end": "5 s", "output.times": "[2 s]"}


class CheckpointFile(RunTest):
    def setUp(self):
        super().setUp()
        run = self.run_scene(SHORT, "run", "--until", "2 s")
        self.good = checkpoints(run)[-1]
        self.bytes = self.good.read_bytes()
        self.spoilt = self.folder / "checkpoint_000001.h5"

    def assert_restart_refused(self, file, *words, keys=None, options=()):
        done = perifrac("run", MANDEL, "--no-report", "--output", self.folder / "new", *settings(keys or SHORT),
                        "--restart", file, *options)
        self.assert_refused(done, str(file), *words)
        self.assertFalse((self.folder / "new").exists())

    def test_missing(self):
        self.assert_restart_refused(self.folder / "checkpoint_000007.h5", "No such file")

    def test_a_folder(self):
        self.assert_restart_refused(self.folder)

    def test_another_file(self):
        self.assert_restart_refused(MANDEL, "not a checkpoint")
        self.assert_restart_refused(next((self.folder / "run" / "frames").glob("*.hdf")), "not a checkpoint")

    def test_of_another_scene(self):
        self.assert_restart_refused(self.good, "another scene", keys=SHORT | {"pore_flow.porosity": "0.31"})

    def test_beyond_the_end(self):
        self.assert_restart_refused(self.good, "lies at 2 s", options=("--until", "1 s"))

    def test_cut_short(self):
        for size in (0, 1, 30, 511, 512, 513, len(self.bytes) // 2, len(self.bytes) - 1):
            with self.subTest(size=size):
                self.spoilt.write_bytes(self.bytes[:size])
                self.assert_restart_refused(self.spoilt)

    def test_one_bit_flipped(self):
        places = random.Random(5)
        used = self.bytes.index(b"\0")  # of the seal; what pads it says nothing
        for n in range(20):
            place = places.randrange(used) if n < 10 else places.randrange(512, len(self.bytes))
            with self.subTest(place=place):
                spoilt = bytearray(self.bytes)
                spoilt[place] ^= 1 << places.randrange(8)
                self.spoilt.write_bytes(spoilt)
                self.assert_restart_refused(self.spoilt)

    def test_into_results_of_another_run(self):
        other = self.run_scene(SHORT, "other")
        before = {file: file.read_bytes() for file in other.rglob("*") if file.is_file()}
        done = perifrac("run", MANDEL, "--no-report", "--output", other, *settings(SHORT), "--restart", self.good)
        self.assert_refused(done, str(other), str(self.good))
        self.assertTrue(before == {file: file.read_bytes() for file in other.rglob("*") if file.is_file()})


if __name__ == "__main__":
    unittest.main()
