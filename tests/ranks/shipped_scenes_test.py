#!/usr/bin/python3
"""Every shipped scene, a short way: four processes leave what one leaves."""
import subprocess
import unittest

import yaml

from ranks_test import CONFIGS, ENVIRONMENT, RanksTest, run_command

# Of a scene's time, as much as one process gets through in so many seconds.
PARTS, SECONDS = (0.02, 0.002, 0.0002), 20


class ShippedScenes(RanksTest):
    def runs_alone(self, scene, until, folder):
        try:
            subprocess.run(run_command(scene, {}, folder, "--overwrite", "--until", until), check=True,
                           capture_output=True, timeout=SECONDS, env=ENVIRONMENT)
            return True
        except subprocess.TimeoutExpired:
            return False

    def test_each(self):
        scenes = sorted([*CONFIGS.glob("*.yaml"), *(CONFIGS / "paper").glob("*.yaml")])
        self.assertGreater(len(scenes), 40)
        for scene in scenes:
            number, unit = str(yaml.safe_load(scene.read_text())["time"]["end"]).split()
            name = scene.relative_to(CONFIGS).with_suffix("")
            one = self.folder / f"{name}/1"
            for part in PARTS:
                until = f"{float(number) * part:.9g} {unit}"
                if ran := self.runs_alone(scene, until, one):
                    break
            with self.subTest(str(name), until=until):
                if not ran:
                    self.skipTest("one process gets nowhere soon")
                four = self.divide(4, {}, f"{name}/4", "--until", until, scene=scene)
                self.assert_same_frames(one, four)
                self.assertEqual((one / "history.csv").read_text(), (four / "history.csv").read_text())


if __name__ == "__main__":
    unittest.main()
