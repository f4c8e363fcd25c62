#!/usr/bin/python3
"""Folders that are in use or cannot be written to, and disks that fill up."""
import json
import os
import resource
import shutil
import signal
import subprocess
import unittest

from long_runs import LONG
from perifrac_runs import CONFIGS, MANDEL, PATIENCE, RunTest, SMALL, checkpoints, listed_frames, perifrac, run_command, settings


def limit_files_to(size):
    """Options of subprocess: files may not grow beyond a size, which a write meets as it does a full disk."""
    # The signal that comes with it is ignored by Python, and so by what it starts, unless restored.
    return {"restore_signals": False,
            "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))}


def files(folder):
    return {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}


class OutputFolder(RunTest):
    def run_into(self, folder, *options, **subprocess_options):
        return perifrac("run", MANDEL, "--no-report", "--output", folder, *settings(SMALL), *options,
                        cwd=self.folder, **subprocess_options)

    def test_one_run_at_a_time(self):
        folder = self.folder / "run"
        first = subprocess.Popen(run_command(MANDEL, LONG, folder), stdout=subprocess.DEVNULL)
        try:
            while not checkpoints(folder):
                self.assertIsNone(first.poll())
            self.assert_refused(self.run_into(folder), str(folder), "another run")
            first.send_signal(signal.SIGTERM)
            self.assertEqual(first.wait(timeout=PATIENCE), 143)
        finally:
            first.kill()
        self.assertEqual(self.run_into(folder).returncode, 0)

    def test_places_that_cannot_hold_it(self):
        file = self.folder / "file"
        file.touch()
        for place in (file, file / "run", "/proc/run", "/dev/null/run"):
            with self.subTest(place=place):
                self.assert_refused(self.run_into(place), str(place))
        self.assertEqual(list(self.folder.iterdir()), [file])

    def test_a_new_run_takes_the_place_of_the_old_one(self):
        folder = self.folder / "run"
        self.run_scene(SMALL | {"output.interval": "1 s"}, folder)
        (folder / "notes.txt").write_text("mine")
        (folder / "report.png").write_text("of the old run")
        self.assertEqual(self.run_into(folder).returncode, 0)
        self.assert_same_results(folder, self.run_scene(SMALL, "new"))
        self.assertEqual((folder / "notes.txt").read_text(), "mine")
        self.assertFalse((folder / "report.png").exists())

    def test_says_in_one_line_what_it_replaces(self):
        folder = self.folder / "run"
        self.assertEqual(self.run_into(folder).stderr, "")
        self.assertRegex(self.run_into(folder).stderr,
                         r"^\d\d:\d\d:\d\d info: .*run: \d+ files of an earlier run are replaced\n$")

    def test_files_of_others_stay(self):
        """Nothing that only has the name of a result is touched, unless --overwrite says so."""
        for name in ("history.csv", "summary.json", "report.html", "report.png", "checkpoint_000012.h5",
                     "frames/solid_000000.hdf", "frames/body.hdf.series", "history.csv.tmp", "table.md", "study.csv"):
            with self.subTest(name=name):
                folder = self.folder / name.replace("/", "_")
                (folder / name).parent.mkdir(parents=True)
                (folder / name).write_text("mine")
                of_study = name in ("table.md", "study.csv")
                words = ["study", CONFIGS / "studies" / "coupling_scheme.yaml"] if of_study else ["run", MANDEL, *settings(SMALL)]
                for _ in range(2):  # a refusal leaves nothing that would let the next one pass
                    done = perifrac(*words, "--no-report", "--output", folder, cwd=self.folder)
                    self.assert_refused(done, str(folder / name), "--overwrite")
                    self.assertEqual(files(folder), {folder / name: b"mine"})
                if of_study:
                    continue
                done = perifrac(*words, "--no-report", "--output", folder, "--overwrite", cwd=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotEqual(files(folder).get(folder / name), b"mine")

    def test_results_that_vanish_meanwhile(self):
        for number, victim in enumerate(("frames/body_000000.hdf", "frames", "history.csv")):
            with self.subTest(victim=victim):
                folder = self.folder / str(number)
                command = run_command(MANDEL, LONG, folder, "--until", "4000 s")
                run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                try:
                    while len(checkpoints(folder)) < 2:
                        self.assertIsNone(run.poll())
                    os.rename(folder / victim, self.folder / "elsewhere")
                    if victim == "history.csv":
                        (folder / victim).write_text("")
                    run.send_signal(signal.SIGTERM)  # it need not go on to its end to notice
                    _, complaints = run.communicate(timeout=PATIENCE)
                finally:
                    run.kill()
                shutil.rmtree(self.folder / "elsewhere", ignore_errors=True)
                (self.folder / "elsewhere").unlink(missing_ok=True)
                self.assertEqual(run.returncode, 1, complaints)
                self.assertRegex(complaints, r"^perifrac: .*cannot be written: .*\n$")

    def test_a_folder_that_is_removed_meanwhile(self):
        folder = self.folder / "run"
        run = subprocess.Popen(run_command(MANDEL, LONG, folder), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               text=True)
        try:
            while not checkpoints(folder):
                self.assertIsNone(run.poll())
            os.rename(folder, self.folder / "elsewhere")
            _, complaints = run.communicate(timeout=PATIENCE)
        finally:
            run.kill()
        self.assertEqual(run.returncode, 1)
        self.assertRegex(complaints, r"^perifrac: .*cannot be written: No such file or directory\n$")

    def test_a_full_disk(self):
        """Whatever does not fit, nothing that was there is lost."""
        whole = self.run_scene(SMALL, "whole")
        start = self.run_scene(SMALL, "start", "--until", "2 s")
        first = checkpoints(start)[-1].stat().st_size
        last = checkpoints(whole)[-1].stat().st_size
        self.assertGreater(last, first)
        failures = set()
        for size in (100, 5000, first - 1, *(first + (last - first) * n // 5 for n in range(5))):
            with self.subTest(size=size):
                folder = self.folder / str(size)
                shutil.copytree(start, folder)
                old = checkpoints(folder)[-1]
                done = self.run_into(folder, "--restart", old, **limit_files_to(size))
                failures.add(self.assert_fails_to_write(done))
                self.assert_no_half_files(folder)
                self.assertTrue(checkpoints(folder))
                self.run_scene(SMALL, folder, "--restart", checkpoints(folder)[-1])
                self.assert_same_results(whole, folder)
        self.assertGreater(len(failures), 1, f"only one file was tried: {failures}")

    def test_a_full_disk_in_the_midst_of_a_row(self):
        probes = "[" + ", ".join(f"{{name: {n}, at: [1 m, {n} m]}}" for n in range(1, 20)) + "]"
        keys = SMALL | {"output.probes": probes}
        whole = self.run_scene(keys, "whole")
        size = (whole / "history.csv").stat().st_size
        self.assertEqual(size, max(len(content) for content in files(whole).values()))
        again = self.folder / "again"
        done = perifrac("run", MANDEL, "--no-report", "--output", again, *settings(keys), **limit_files_to(size - 1))
        self.assertEqual(self.assert_fails_to_write(done), "history.csv")
        self.assertTrue((again / "history.csv").read_text().endswith("\n"), "a torn row")
        self.run_scene(keys, again, "--restart", checkpoints(again)[-1])
        self.assert_same_results(whole, again)

    def test_a_disk_that_is_full_from_the_start(self):
        for size in (0, 300, 3000):
            with self.subTest(size=size):
                self.assert_fails_to_write(self.run_into(self.folder / str(size), **limit_files_to(size)))

    def assert_fails_to_write(self, done):
        """Gives the name of the file."""
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"^perifrac: .*: cannot be written: File too large\n$")
        self.assertRegex(done.stdout, r"^(read .*\n)*$")
        return os.path.basename(done.stderr.removeprefix("perifrac: ").split(": cannot")[0])

    def assert_no_half_files(self, folder):
        self.assertEqual(list(folder.rglob("*.tmp")), [])
        self.assertGreater(len(listed_frames(folder)), 0)
        for _, frame in listed_frames(folder):
            self.assertTrue(frame.read_bytes().startswith(b"\x89HDF"))

    def test_a_restart_leaves_no_summary_of_what_came_before(self):
        folder = self.run_scene(SMALL, "run", "--until", "2 s")
        self.assertEqual(json.loads((folder / "summary.json").read_text())["time"]["value"], 2.0)
        start = checkpoints(folder)[-1]
        done = self.run_into(folder, "--restart", start, **limit_files_to(start.stat().st_size))
        self.assert_fails_to_write(done)
        self.assertFalse((folder / "summary.json").exists())


if __name__ == "__main__":
    unittest.main()
