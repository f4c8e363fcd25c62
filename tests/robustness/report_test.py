#!/usr/bin/python3
"""A run ends with a picture and a page; where they cannot be made, the run is still a good one."""
import unittest

from perifrac_runs import MANDEL, RunTest, SMALL, perifrac, settings


class Report(RunTest):
    def run_with_report(self):
        return perifrac("run", MANDEL, "--output", self.folder / "run", *settings(SMALL))

    def test_run_says_where_they_are(self):
        done = self.run_with_report()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name, start in (("report.png", b"\x89PNG"), ("report.html", b"<!")):
            file = self.folder / "run" / name
            self.assertTrue(file.read_bytes().startswith(start))
            self.assertIn(str(file), done.stdout)

    def test_a_report_that_fails_is_only_a_warning(self):
        (self.folder / "run" / "report.png").mkdir(parents=True)  # in the way of the picture
        done = self.run_with_report()
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr.splitlines()[-1], "warning: .*report")
        self.assertTrue((self.folder / "run" / "summary.json").exists())
        (self.folder / "run" / "report.png").rmdir()
        self.assertEqual(perifrac("report", self.folder / "run").returncode, 0)
        self.assertTrue((self.folder / "run" / "report.png").is_file())


if __name__ == "__main__":
    unittest.main()
