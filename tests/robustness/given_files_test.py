#!/usr/bin/python3
"""Files that are given: none hangs the program, or costs more than its size; what cannot be read is one line."""
import os
import resource
import socket
import unittest

from perifrac_runs import CONFIGS, MANDEL, RunTest, perifrac

EXPECTED = {"scene": "a scene file", "checkpoint": "a checkpoint_"}


def seconds_of(*arguments):
    """Processor time, and how it ended."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = perifrac(*arguments)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, done


class GivenFiles(RunTest):
    def special_files(self):
        """(path, why it cannot be read)"""
        os.mkfifo(self.folder / "pipe")
        with socket.socket(socket.AF_UNIX) as opened:
            opened.bind(str(self.folder / "socket"))
        os.symlink(self.folder / "there", self.folder / "here")
        os.symlink(self.folder / "here", self.folder / "there")
        (self.folder / "loop.yaml").symlink_to("loop.yaml")
        return [("/dev/zero", "device"), ("/dev/urandom", "device"), ("/dev/null", "device"),
                (self.folder / "pipe", "pipe"), (self.folder / "socket", "socket"), (self.folder, "Is a directory"),
                (self.folder / "here", "symbolic links"), (self.folder / "loop.yaml", "symbolic links"),
                (self.folder / "missing", "No such file"), ("/dev/null/below", "Not a directory"),
                ("n" * 300, "name too long"), ("n/" * 5000, "name too long")]

    def test_only_plain_files_are_read(self):
        for path, why in self.special_files():
            for arguments, expected in ((["check", path], "scene"), (["run", path, "--output", "new"], "scene"),
                                        (["study", path, "--output", "new"], "scene"),
                                        (["run", MANDEL, "--output", "new", "--restart", path], "checkpoint")):
                with self.subTest(arguments=arguments):
                    done = perifrac(*arguments, cwd=self.folder)
                    self.assert_refused(done, str(path)[:50], why, EXPECTED[expected])
                    self.assertFalse((self.folder / "new").exists())

    def test_files_that_a_scene_names(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "loop").symlink_to("loop")
        notch = CONFIGS.joinpath("hf_storage.yaml").read_text().replace("hf_storage_reference.csv", "NAME")
        for name in ("pipe", "loop", ".", "/dev/zero", "n" * 300):
            scene = self.folder / "scene.yaml"
            scene.write_text(notch.replace("NAME", name))
            with self.subTest(name=name):
                self.assert_refused(perifrac("check", scene, "--trial", "0", "--set", "body.spacing=5 mm"), name[:20])

    def test_a_checkpoint_of_another_size_is_not_read_whole(self):
        huge = self.folder / "checkpoint_000001.h5"
        huge.write_text("perifrac checkpoint, format 2\n100 bytes, FNV-1a 0000000000000000\n")
        os.truncate(huge, 1 << 42)  # takes no room on the disk
        self.assert_refused(perifrac("run", MANDEL, "--output", self.folder / "new", "--restart", huge), "cut short")

    def test_a_scene_of_any_size_does_not_take_the_memory(self):
        huge = self.folder / "huge.yaml"
        huge.touch()
        os.truncate(huge, 1 << 42)
        self.assert_refused(perifrac("check", huge), "larger than 64 MB")

    def assert_grows_with_size(self, text_of, count):
        """Eight times as many items take some eight times as long, not 64 times."""
        scene = self.folder / "scene.yaml"
        taken = []
        for n in (count, 8 * count):
            scene.write_text(text_of(n))
            seconds, self.done = seconds_of("check", scene, "--trial", "0")
            taken.append(seconds)
        self.assertLess(taken[1], 24.0 * max(taken[0], 0.02))

    def test_many_keys(self):
        text = MANDEL.read_text()
        self.assert_grows_with_size(lambda n: text + "".join(f"key{k}: {k}\n" for k in range(n)), 15000)
        self.assertEqual(self.done.returncode, 2)
        self.assertIn("unknown key 'key0'", self.done.stderr)

    def test_many_items(self):
        first, second = MANDEL.read_text().replace("spacing: 1 m", "spacing: 4 m").split("  boundary:\n    right: {type: p")
        items = "    - {at: [1 m, 1 m], rate: 1e-9}\n"
        self.assert_grows_with_size(lambda n: f"{first}  sources:\n{items * n}  boundary:\n    right: {{type: p{second}",
                                    4000)
        self.assertEqual(self.done.returncode, 0, self.done.stderr)

    def test_a_crack_of_very_many_corners(self):
        corners = ", ".join(f"75 mm, {150 + k % 2 * 50} mm" for k in range(20000))
        scene = self.folder / "scene.yaml"
        notch = CONFIGS.joinpath("hf_storage.yaml").read_text()
        scene.write_text(notch.replace("path: [75 mm, 200 mm, 75 mm, 186 mm]", f"path: [{corners}]"))
        self.assert_refused(perifrac("check", scene, "--trial", "0"), "cracks[0].path", "more than 20000 spacings")

    def test_brackets_without_end(self):
        scene = self.folder / "scene.yaml"
        scene.write_text("title: " + "[" * 1000000)
        self.assert_refused(perifrac("check", scene), "scene.yaml:1:")


if __name__ == "__main__":
    unittest.main()
