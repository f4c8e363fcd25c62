#!/usr/bin/python3
"""`perifrac check`: what a person wants to know, arrays when asked for, and a picture of the set-up and nothing else."""
import re
import unittest

from perifrac_runs import CONFIGS, HERE, MANDEL, RunTest, perifrac, settings


class Check(RunTest):
    def picture(self, scene, *arguments, name="setup.svg"):
        """The words of the drawing, and its file."""
        done = perifrac("check", scene, "--trial", "0", "--picture", name, *arguments, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual([path.name for path in self.folder.iterdir()], [name])
        text = (self.folder / name).read_text()
        (self.folder / name).unlink()
        return re.findall(r"<text[^>]*>([^<]*)</text>", text), text

    def test_says_what_is_simulated_and_arrays_when_asked(self):
        scene, *keys = CONFIGS / "hf_storage.yaml", *settings({"body.spacing": "5 mm"})
        said = perifrac("check", scene, "--trial", "0", *keys, cwd=self.folder).stdout
        for words in ("crack_fluid: network, solid: quasi_static", "1200 points, 3 crack points",
                      "closed by 0.21 MPa", "regime: viscosity and toughness", "memory: about"):
            self.assertIn(words, said)
        for words in ("link ", "bytes", "instructions"):
            self.assertNotIn(words, said)
        said = perifrac("check", scene, "--trial", "0", "--arrays", *keys, cwd=self.folder).stdout
        self.assertRegex(said, r"solid/crack_pressure +3 values +24 bytes")
        self.assertIn("link crack_pressure", said)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_says_how_steps_of_pore_flow_are_solved_for(self):
        for integrator, words in (("{type: explicit}", "packets of [0-9]+ points: .*neighbours\n"),
                                  ("{type: cvode}", "packets .*; CVODE's systems by a factor\n"),
                                  ("{type: cvode, linear_solver: krylov}", "packets .*; CVODE's systems by krylov\n")):
            said = perifrac("check", CONFIGS / "terzaghi.yaml", "--trial", "0", "--arrays", "--set",
                            f"pore_flow.integrator={integrator}", cwd=self.folder).stdout
            self.assertRegex(said, "bonds of pore_flow: " + words)

    def test_plane_with_all_there_is(self):
        words, _ = self.picture(CONFIGS / "hf_complete.yaml", "--set",
                                "output={interval: 5 ms, probes: [{name: far, at: [10 mm, 10 mm]}]}",
                                "--set", "pore_flow.boundary={left: {type: pressure, pressure: 2 kPa}}", "--set",
                                "pore_flow.sources=[{at: [20 mm, 30 mm], rate: 1e-6 m^2/s}]")
        for word in ("A hydraulic fracture, whole", "starter", "natural", "water", "pump: 0.16 kg/(m s)",
                     "mouth: of free fluid", "210 kPa", "far", "2 kPa", "crack", "roller", "pin", "free fluid", "probe",
                     "well in the pores", "pressure of pores held", "effective stress at rest"):
            self.assertIn(word, words)

    def test_what_a_scene_has_not_is_not_drawn(self):
        words, text = self.picture(MANDEL)
        self.assertEqual({"roller", "rigid plate", "pressure of pores held", "probe"} & set(words),
                         {"roller", "rigid plate", "pressure of pores held", "probe"})
        self.assertIn("10 kN/m", words)
        for word in ("crack", "pin", "free fluid", "effective stress at rest"):
            self.assertNotIn(word, words)

    def test_regions_and_loads_of_a_part_of_a_face(self):
        words, _ = self.picture(CONFIGS / "hf_barriers.yaml", *settings({"body.spacing": "10 mm"}))
        self.assertIn("barrier: effective stress 3 MPa and 3.15 MPa", words)
        words, _ = self.picture(CONFIGS / "three_point_bending.yaml")
        self.assertTrue([word for word in words if word.startswith("400 µm")], words)

    def test_solids_balls_clouds_and_fluid_alone(self):
        words, _ = self.picture(CONFIGS / "radial.yaml", "--set", "body.spacing=2 mm", "--set",
                                "cracks=[{name: notch, centre: [0 mm, 0 mm, 16 mm], normal: [0, 0, 1], radius: 8 mm}]")
        for word in ("notch", "10 MPa", "inlet of a crack", "roller", "x [mm]", "z [mm]"):
            self.assertIn(word, [w.strip() for w in words])
        for scene, word in (("cryer", "pressure of pores held"), ("dam_break", "column"), ("tank_3d", "free fluid"),
                            ("notch_points", "crack"), ("borehole", "well: 20 MPa × schedule")):
            with self.subTest(scene):
                self.assertIn(word, [w.strip() for w in self.picture(CONFIGS / f"{scene}.yaml")[0]])

    def test_named_by_the_scene_and_by_its_ending(self):
        done = perifrac("check", HERE / "solid_only.yaml", "--trial", "0", "--picture", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        written = self.folder / "solid_only.png"
        self.assertEqual(list(self.folder.iterdir()), [written])
        self.assertEqual(written.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        written.unlink()
        done = perifrac("check", MANDEL, "--picture", "setup.jpg", cwd=self.folder)
        self.assert_refused(done, "--picture", "setup.jpg", ".png or .svg")
        done = perifrac("check", MANDEL, "--trial", "0", "--picture", "none/setup.png", cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("none/setup.png", done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
