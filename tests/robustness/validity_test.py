#!/usr/bin/python3
"""What makes an answer wrong is warned of, before a run or while it runs, once each, and `check` and `run` say the same."""
import json
import unittest

from perifrac_runs import CONFIGS, FLUIDS, MANDEL, RunTest, SMALL, perifrac, settings

FLUID = CONFIGS / "hf_storage.yaml"
COARSE = {"body.spacing": "5 mm", "time.end": "10 ms"}
WELL = {"body.spacing": "10 mm", "time.end": "0.2 ms", "output.interval": "0.1 ms"}
COARSENESS = ("body.spacing is too coarse", "the energy balance")
SHORT = SMALL | {"time.end": "3 s", "output.times": "[1 s]"}


class Validity(RunTest):
    def warnings(self, scene, keys, folder="run"):
        done = perifrac("run", scene, "--no-report", "--overwrite", "--output", self.folder / folder, *settings(keys))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        warned = [line.split(" warning: ")[1] for line in done.stderr.splitlines() if " warning: " in line]
        self.summary = json.loads((self.folder / folder / "summary.json").read_text())
        self.assertEqual(self.summary["warnings"], warned)
        return warned

    def foreknown(self, scene, keys=()):
        """What `check` warns of."""
        said = perifrac("check", scene, "--json", "--trial", "0", *settings(dict(keys)))
        return json.loads(said.stdout)["warnings"]

    def assert_warns(self, scene, keys, *words):
        """One warning for each of the words, and no other; what the points are too coarse for is another matter."""
        warned = [warning for warning in self.warnings(scene, keys) if not any(word in warning for word in COARSENESS)]
        self.assertEqual(len(warned), len(words), warned)
        for word, warning in zip(words, warned):
            self.assertIn(word, warning)
        return warned

    def without_reference(self, name):
        lines = (CONFIGS / name).read_text().splitlines(keepends=True)
        scene = self.folder / name
        inside = [line.startswith("reference:") for line in lines]
        for n in range(1, len(lines)):
            inside[n] = inside[n] or (inside[n - 1] and lines[n].startswith(" "))
        scene.write_text("".join(line for line, without in zip(lines, inside) if not without))
        return scene

    def test_a_run_says_what_check_knows(self):
        dry = WELL | {"solid.confining_stress": "[0.1 MPa, 0.1 MPa]"}
        self.assert_warns(CONFIGS / "kgd_mixed.yaml", dry, "no fluid lag", "fluid fills")
        known = self.foreknown(CONFIGS / "kgd_mixed.yaml", dry)
        self.assertEqual(known, self.summary["warnings"][:1])  # the other is of the end

    def test_a_table_of_another_fluid_is_not_compared(self):
        for key, value in (("crack_fluid.viscosity", "10 cP"), ("crack_fluid.inlets[0].rate", "2e-4 m^2/s"),
                           ("solid.confining_stress", "[0.3 MPa, 0.105 MPa]"),
                           ("crack_fluid.inlets[0].schedule", "{times: [1 ms, 2 ms], factors: [1, 0.5]}")):
            with self.subTest(key=key):
                self.assert_warns(FLUID, COARSE | {key: value}, f"is for {key}")
                self.assertNotIn("reference", self.summary)
        self.assert_warns(FLUID, COARSE)
        self.assertIn("reference", self.summary)

    def test_a_solution_is_not_compared_with_rock_that_scatters(self):
        scatter = {"solid.material.scatter": "{coefficient_of_variation: 0.1, correlation_length: 20 mm}"}
        self.assert_warns(FLUID, COARSE | scatter, "is for rock that is the same everywhere")
        self.assertNotIn("reference", self.summary)
        said = perifrac("check", MANDEL, "--trial", "0", *settings({"pore_flow.permeability_scatter":
                        "{coefficient_of_variation: 0.1, correlation_length: 20 m}"}))
        self.assertEqual(said.returncode, 2)
        self.assertIn("the exact solution is for a rock that is the same everywhere", said.stderr)

    def test_rock_may_scatter_under_stress_around_cracks(self):
        scatter = "{coefficient_of_variation: 0.1, correlation_length: 20 m}"
        for key in ("solid.material.scatter", "damage.scatter"):
            self.assertEqual(self.foreknown(CONFIGS / "two_fractures.yaml", {key: scatter}), [])

    def test_a_table_is_not_compared_beyond_its_end(self):
        table = "time [s],crack_length [m]\n0.001,0.014\n0.006,0.02\n"
        (self.folder / "table.csv").write_text(table)
        scene = self.folder / "scene.yaml"
        scene.write_text(FLUID.read_text().replace("hf_storage_reference.csv", "table.csv"))
        self.assert_warns(scene, COARSE, "ends at t = 0.006 s, before the run does")
        errors = {row["time"]: row["crack_length_error"] for row in self.summary["reference"]["table"]}
        self.assertLess(errors[0.005], 1.0)
        self.assertIsNone(errors[0.01])

    def test_a_table_whose_conditions_cannot_be_read(self):
        scene = self.folder / "scene.yaml"
        scene.write_text(FLUID.read_text().replace("hf_storage_reference.csv", "table.csv"))
        for line, word in (("# viscosity", ":1: no condition"), ("# crack_fluid.viscosty = 1", "no scene has a key"),
                           ("# crack_fluid.viscosity = 1 cP", ":1: 'cP'; expected a finite number")):
            with self.subTest(line=line):
                (self.folder / "table.csv").write_text(f"{line}\ntime [s],crack_length [m]\n0.001,0.014\n")
                self.assert_refused(perifrac("check", scene, "--trial", "0", *settings(COARSE)), "table.csv", word)

    def test_grains_softer_than_the_rock(self):
        soft = SHORT | {"pore_flow.grain_bulk_modulus": "0.6 GPa"}
        self.assert_warns(MANDEL, soft, "above that of its grains")

    def test_strains(self):
        self.assert_warns(MANDEL, SHORT | {"solid.boundary.top.force": "15 GN/m"}, "strains reach")

    def test_rotations(self):
        soft = {"solid.material.youngs_modulus": "200 MPa", "body.spacing": "0.25 m", "time.end": "0.6 s"}
        beam = self.without_reference("cantilever_dynamic.yaml")
        self.assert_warns(beam, soft, "rotations reach")
        self.assert_warns(beam, soft | {"solid.kinematics": "corotational"})

    def test_rubble(self):
        """Struck five times as fast, the plate flies to pieces."""
        coarse = {"body.spacing": "5 mm", "time.end": "100 us"}
        for speed, warns in (("-16.5 m/s", False), ("-80 m/s", True)):
            warned = self.warnings(CONFIGS / "kalthoff.yaml", coarse | {"solid.boundary.left.normal_velocity": speed})
            self.assertEqual(any("fracture_energy falls" in warning for warning in warned), warns, warned)

    def test_suction(self):
        self.assert_warns(MANDEL, SHORT | {"pore_flow.fluid.cavitation_pressure": "1 kPa"},
                          "below pore_flow.fluid.cavitation_pressure")
        self.assert_warns(MANDEL, SHORT | {"pore_flow.fluid.cavitation_pressure": "-1 kPa"})

    def test_soft_fluid_in_cracks(self):
        soft = {"body.spacing": "5 mm", "time.end": "20 ms", "output.interval": "20 ms"}
        for modulus, warns in (("3 MPa", True), ("6 MPa", False)):  # pressed to 0.26 and 0.13 of them
            warned = self.warnings(self.without_reference("hf_storage.yaml"), soft | {"crack_fluid.bulk_modulus": modulus})
            self.assertEqual(any("of the fluid's bulk modulus" in warning for warning in warned), warns, warned)

    def test_sudden_drainage(self):
        tight = SHORT | {"pore_flow.permeability": "3e-12 m^2"}
        swinging = tight | {"pore_flow.undrained_stabilisation": "0"}
        seen = {"output.times": "[0.1 s]"}
        self.assert_warns(MANDEL, swinging | seen, "of first order only", "pore_pressure swings from point to point")
        self.assert_warns(MANDEL, tight | seen)
        # Died away before anything is written: told, and no more.
        self.assert_warns(MANDEL, swinging, "of first order only")
        self.assertIn("info: pore_pressure swings from point to point", self.said)

    def test_sudden_drainage_where_storage_cannot_be_stabilised(self):
        layers = SHORT | {"pore_flow.undrained_stabilisation": "0"}
        layers["output.times"] = "[20 ms]"
        warned, _ = self.assert_warns(CONFIGS / "mandel_layers.yaml", layers, "pore_pressure swings from point to point",
                                      "through face 'right'")
        self.assertIn("by a schedule", warned)

    def test_a_slit_in_rigid_rock_may_begin_at_any_pressure(self):
        self.assert_warns(CONFIGS / "slit_flow.yaml", {"body.spacing": "2 mm", "time.end": "10 ms",
                                                       "crack_fluid.filled[0].pressure": "1 MPa"})

    def test_free_fluid_narrower_than_its_horizon(self):
        for scene, warns in (("hf_storage_points.yaml", True), ("notch_points.yaml", False)):
            warned = self.foreknown(CONFIGS / scene)
            self.assertEqual(any("2.0 points: it takes more" in warning for warning in warned), warns, warned)

    def test_leak_off_within_a_spacing(self):
        short = {"body.spacing": "5 mm", "time.end": "1 ms", "output.interval": "1 ms"}
        stiff = {"crack_fluid.bulk_modulus": "2.2 GPa", "pore_flow.fluid.bulk_modulus": "2.2 GPa"}
        # Depths of 1.5 mm, soft water, and of 6.3.
        for scene, keys, warns in (("hf_storage_pores.yaml", {}, True), ("hf_leakoff_pores.yaml", {}, True),
                                   ("hf_leakoff_pores.yaml", stiff, False)):
            warned = self.warnings(CONFIGS / scene, short | keys)
            self.assertEqual(any("through the faces of cracks" in warning for warning in warned), warns, warned)

    def test_leak_off_that_has_just_begun(self):
        """A crack grows out of what is sealed at 4 ms, and out of none at once."""
        keys = {"body.spacing": "2.5 mm", "time.end": "5.5 ms", "output.interval": "5.5 ms"}
        open_ = keys | {"crack_fluid.sealed": "[]"}
        for notch, warns in ((keys, True), (open_, False)):
            warned = self.warnings(CONFIGS / "hf_leakoff_pores.yaml", notch)
            self.assertEqual(any("through the faces of cracks" in warning for warning in warned), warns, warned)

    def test_seepage_within_a_spacing(self):
        soon = {"time.end": "1 ms", "output.times": "[]", "output.probes": "[]"}
        self.assert_warns(CONFIGS / "aquifer.yaml", soon, "through face 'left' depends on the spacing")
        self.assert_warns(CONFIGS / "aquifer.yaml", soon | {"time.end": "1 s"})
        wide = {"time.end": "0.1 s", "output.times": "[]", "output.probes": "[]"}  # a depth of 1.3 spacings
        for ratio, warns in (("2.5", False), ("6", True)):
            warned = self.warnings(MANDEL, wide | {"body.horizon_ratio": ratio, "body.spacing": "0.5 m"})
            self.assertEqual(any("depends on the spacing" in warning for warning in warned), warns, warned)
        # A depth of 1.9 spacings, and 2.7.
        for end, warns in (("5 s", True), ("10 s", False)):
            keys = {"time.end": end, "output.times": "[]", "output.interval": end}
            warned = self.warnings(self.without_reference("constant_head.yaml"), keys)
            self.assertEqual(any("through what free fluid touches" in warning for warning in warned), warns, warned)
        # A layer drains as if its face lay a spacing behind itself: depths of 1.2 spacings, and 35.
        layers = {"output.times": "[]", "output.interval": "28.9053 s"}
        tight = layers | {"pore_flow.permeability": "1.2e-14 m^2"}
        for keys, warns in ((tight, True), (tight | {"body.boundary": "{}"}, False), (layers, False)):
            warned = self.warnings(self.without_reference("terzaghi_layers.yaml"), keys)
            self.assertEqual(any("less than 5 body.spacing" in warning for warning in warned), warns, warned)
        # From the flow that comes to be nothing enters that was not there.
        warm = {"time.end": "5 s", "output.interval": "5 s"}
        self.assert_warns(CONFIGS / "constant_head_warm.yaml", warm)
        # Far from a crack that does not leak a face holds what was there.
        tight = {"body.spacing": "5 mm", "time.end": "1 ms", "output.interval": "1 ms", "crack_fluid.leak_off": "none"}
        for pressure, warns in (("0 Pa", False), ("10 kPa", True)):
            held = tight | {"pore_flow.boundary": f"{{left: {{type: pressure, pressure: {pressure}}}}}"}
            warned = self.warnings(CONFIGS / "hf_storage_pores.yaml", held)
            self.assertEqual(any("through face 'left'" in warning for warning in warned), warns, warned)

    def test_fluid_a_facet_ahead_in_closed_cracks(self):
        # Cracks of six facets, open in the middle: 16 m of 48 that are wet are closed; later all are open.
        coarse = {"body.spacing": "4 m", "output.interval": "60 s", "coupling.window.largest": "1 s"}
        for end, warns in (("18 s", True), ("60 s", False)):
            warned = self.warnings(CONFIGS / "two_fractures.yaml", coarse | {"time.end": end})
            self.assertEqual(any("33 % of what fluid wets" in warning for warning in warned), warns, warned)

        # Two facets of a slit of six are closed: the others are a quarter less wide where points are twice as fine.
        soon = {"time.end": "1.1 ms", "output.interval": "1.1 ms"}
        for permeability, warns in (("3.6e-13 m^2", True), ("1e-15 m^2", False)):
            warned = self.warnings(self.without_reference("hf_storage_pores.yaml"),
                                   soon | {"pore_flow.permeability": permeability})
            self.assertEqual(any("of what fluid wets" in warning for warning in warned), warns, warned)

    def test_leak_off_that_takes_all(self):
        # A crack that is closed by 19 MPa loses more at the first facet than is pumped.
        lossy = {"solid.confining_stress": "[19 MPa, 1 MPa]", "body.spacing": "4 mm"}
        for coefficient, warns in (("1.4e-3 m/s*sqrt(s)", True), ("1e-4 m/s*sqrt(s)", False)):
            warned = self.warnings(CONFIGS / "shut_in.yaml", lossy | {"crack_fluid.leak_off_coefficient": coefficient})
            self.assertEqual(any("leaked off where it came in" in warning for warning in warned), warns, warned)

    def test_free_fluid_that_a_blow_has_spread(self):
        # 98 kPa of pressure throws off what presses with 1 kPa; the column is a tenth too high for good.
        scene = self.without_reference("infiltration.yaml")
        heavy = {"fluid.walls[0].mass": "10 t/m", "time.end": "20 s", "output.times": "[]", "output.interval": "20 s"}
        for force, warns in (("-6 kN/m", True), ("-588.6 kN/m", False)):
            warned = self.warnings(scene, heavy | {"fluid.walls[0].force": f"[0 N/m, {force}]"})
            self.assertEqual(any("takes up" in warning and "more room" in warning for warning in warned), warns, warned)

    def test_waves_that_have_hardly_begun(self):
        scene = CONFIGS / "kalthoff.yaml"
        short = {"time.end": "0.5 us", "output.interval": "0.5 us"}
        self.assert_warns(scene, short, "waves go 0.0027 m into the rock by t = 5e-07 s, 2.7 body.spacing")
        self.assertIn("waves go", "".join(self.foreknown(scene, short)))
        self.assertNotIn("waves go", "".join(self.foreknown(scene)))

    def test_a_crack_that_fluid_has_hardly_entered(self):
        soon = {"body.spacing": "2.5 mm", "cracks[1]": "null", "time.end": "0.05 ms", "output.interval": "0.05 ms"}
        del soon["cracks[1]"]
        self.assert_warns(FLUID, soon, "fluid fills")
        self.assert_warns(FLUID, soon | {"time.end": "3 ms"})
        # Nor does one say so that has closed on what leaked off.
        warned = self.warnings(CONFIGS / "shut_in.yaml", {"body.spacing": "4 mm"})
        self.assertFalse(any("fluid fills" in warning for warning in warned), warned)
        # One that flows back without having got far does.
        little = {"body.spacing": "4 mm", "crack_fluid.inlets[0].rate": "3.4e-6 m^2/s"}
        warned = self.warnings(CONFIGS / "shut_in.yaml", little)
        self.assertTrue(any("fluid fills" in warning and "by t = " in warning for warning in warned), warned)

    def test_each_of_several_wings_is_to_be_filled(self):
        """Fluid that fills enough for one of four."""
        for end, warns in (("2 s", True), ("20 s", False)):
            keys = {"time.end": end, "output.interval": end, "coupling.window.largest": "1 s"}
            warned = self.warnings(CONFIGS / "two_fractures.yaml", keys)
            self.assertEqual(any("for each wing" in warning for warning in warned), warns, warned)

    def test_a_crack_across_the_larger_stress(self):
        for across, warns in (("3.8 MPa", True), ("3.6 MPa", False)):
            keys = {"body.spacing": "10 mm", "solid.confining_stress": f"[3 MPa, {across}]"}
            warned = self.foreknown(CONFIGS / "kgd_toughness.yaml", keys)
            self.assertEqual(any("cracks[0] lies across the larger stress" in warning for warning in warned), warns, warned)

    def test_a_crack_aslant_to_the_stress(self):
        """Sheared by 1.7 and 3.3 times what it grows at."""
        for other, warns in (("5 MPa", True), ("4 MPa", False), ("3 MPa", False)):
            keys = {"body.spacing": "10 mm", "solid.confining_stress": f"[3 MPa, {other}]"}
            warned = self.foreknown(CONFIGS / "kgd_oblique.yaml", keys)
            self.assertEqual(any("lies aslant to the stress" in warning for warning in warned), warns, warned)

    def test_a_fault_beyond_what_friction_holds_at_rest(self):
        """10 MPa of shear under 35 MPa, less the 15 MPa of the water in it; and a crack that is dry, under 15 and 5."""
        for scene, keys, warns in (("fault_slip", {"solid.crack_friction": "0.49"}, True), ("fault_slip", {}, False),
                                   ("sliding_crack", {"solid.confining_stress": "[20 MPa, 10 MPa]"}, True),
                                   ("sliding_crack", {"solid.confining_stress": "[12 MPa, 8 MPa]"}, False)):
            warned = self.foreknown(CONFIGS / f"{scene}.yaml", keys)
            self.assertEqual(any("of shear at rest" in warning for warning in warned), warns, warned)

    def test_a_crack_that_slides_before_fluid_is_there(self):
        both = ("[{name: hf, path: [0.5 m, 0.48 m, 0.5 m, 0.52 m]}, "
                "{name: natural, path: [0.25 m, 0.25 m, 0.29 m, 0.27 m]}]")
        even = {"body.spacing": "10 mm", "cracks": both}
        uneven = even | {"solid.confining_stress": "[3 MPa, 6 MPa]"}
        for keys, warns in ((uneven, True), (uneven | {"solid.crack_friction": "0.6"}, False), (even, False)):
            warned = self.foreknown(CONFIGS / "kgd_oblique.yaml", keys)
            self.assertEqual(any("before any fluid reaches it" in warning for warning in warned), warns, warned)

    def test_a_beam_that_swings_out_of_step(self):
        beam = self.without_reference("cantilever_dynamic.yaml")
        late = {"time.end": "2 s"}
        upright = late | {"solid.boundary": "{bottom: {type: fixed}}"}  # no cantilever any more
        for keys, warns in (({}, False), (late, True), (late | {"body.spacing": "50 mm"}, False),
                            (late | {"solid.body_force": "[-25 kN/m^3, 0 N/m^3]"}, False), (upright, False)):
            warned = self.foreknown(beam, keys)
            self.assertEqual(any("the body swings" in warning for warning in warned), warns, warned)

    def test_a_body_thinner_than_its_horizon(self):
        beam = self.without_reference("cantilever_dynamic.yaml")
        wide = {"body.horizon_ratio": "7", "time.end": "1 ms", "output.interval": "1 ms"}
        thin = wide | {"body.size": "[10 m, 0.4 m]"}  # half its energy of bending
        for keys, warns in ((thin, True), (thin | {"body.horizon_ratio": "4"}, False), (wide, False)):
            warned = self.foreknown(beam, keys)
            self.assertEqual(any("bend too stiffly" in warning for warning in warned), warns, warned)

    def test_a_plate_that_is_light_beside_the_water_on_it(self):
        for density, warns in (("150 kg/m^3", True), ("200 kg/m^3", False)):
            warned = self.foreknown(CONFIGS / "water_on_plate.yaml", {"solid.density": density})
            self.assertEqual(any("answer each other too late" in warning for warning in warned), warns, warned)

    def test_a_crack_that_opens_at_a_face_beside_its_inlet(self):
        notch = {"body.spacing": "2.5 mm", "cracks[0].path": "[75 mm, 197.5 mm, 75 mm, 178.5 mm]", "crack_fluid.inlets[0].at": "[75 mm, 197.5 mm]",
                 "time.end": "2 ms", "output.interval": "1 ms"}
        scene = self.without_reference("hf_leakoff_stiff_water.yaml")
        self.assertTrue(any("inlet 'notch' lies 1 spacings from there" in warning for warning in self.warnings(scene, notch)))

    def test_stress_at_rest_that_no_small_strain_goes_with(self):
        for stress, warns in (("80 MPa", True), ("70 MPa", False)):  # of 747 MPa
            keys = {"body.spacing": "10 mm", "solid.confining_stress": f"[{stress}, 3 MPa]"}
            warned = self.foreknown(CONFIGS / "kgd_toughness.yaml", keys)
            self.assertEqual(any("of its plane-strain modulus of 746.7 MPa" in warning for warning in warned), warns, warned)

    def test_a_crack_aslant_on_a_mirror(self):
        for to, warns in (("10 mm, 445 mm", True), ("18 mm, 443 mm", False)):
            keys = {"body.spacing": "5 mm", "cracks[0].path": f"[0 mm, 425 mm, {to}]"}
            warned = self.foreknown(CONFIGS / "kgd_leakoff.yaml", keys)
            self.assertEqual(any("to the left face, which solid.boundary mirrors" in warning for warning in warned), warns, warned)

    def test_cracks_that_begin_as_long_as_the_body(self):
        for strength, warns in (("0.5 MPa", True), ("0.65 MPa", False)):
            warned = self.foreknown(CONFIGS / "three_point_bending.yaml", {"damage.tensile_strength": strength})
            self.assertEqual(any("when and where they begin is not known" in warning for warning in warned), warns, warned)

    def test_a_round_crack_that_fluid_has_hardly_entered(self):
        soon = {"body.size": "[12 mm, 12 mm, 16 mm]", "cracks[0].centre": "[0 mm, 0 mm, 8 mm]",
                "crack_fluid.inlets[0].at": "[0 mm, 0 mm, 8 mm]", "crack_fluid.residual_aperture": "0.3 um",
                "time.end": "0.03 ms", "output.interval": "0.03 ms"}
        self.assert_warns(self.without_reference("radial.yaml"), soon, "fluid fills")

    def test_a_crack_along_a_face(self):
        """Rock of three points between a crack and a free face, not beside a mirror, and not of six."""
        block = self.without_reference("rubin_1983.yaml")
        narrow = {"body.spacing": "2 mm", "solid.pins[0].at": "[144 mm, 48 mm]"}
        for height, warns in (("0.054 m", True), ("0.060 m", False)):
            warned = self.foreknown(block, narrow | {"body.size": f"[0.144 m, {height}]"})
            self.assertEqual(any("runs along the top face" in warning for warning in warned), warns, warned)
        mirrored = {"body.spacing": "2 mm", "solid.pins": "[]", "body.size": "[0.144 m, 0.054 m]",
                    "solid.boundary.top": "{type: roller}"}
        self.assertFalse(any("runs along" in warning for warning in self.foreknown(block, mirrored)))

    def test_a_disc_of_few_spacings(self):
        scene = self.without_reference("radial.yaml")
        for radius, warns in (("2.5 mm", True), ("4 mm", False)):
            disc = {"body.size": "[10 mm, 10 mm, 16 mm]", "cracks[0].centre": "[0 mm, 0 mm, 8 mm]", "cracks[0].radius": radius,
                    "crack_fluid.inlets[0].at": "[0 mm, 0 mm, 8 mm]", "time.end": "3 ms", "output.interval": "3 ms"}
            warned = self.warnings(scene, disc)
            self.assertEqual(any("fluid fills" in warning for warning in warned), warns, warned)

    def test_a_residual_aperture_as_wide_as_what_is_opened(self):
        wing = {"body.spacing": "5 mm", "body.size": "[100 mm, 200 mm]", "cracks[0].path": "[0 mm, 100 mm, 10 mm, 100 mm]",
                "crack_fluid.inlets[0].at": "[0 mm, 100 mm]", "time.end": "20 ms"}
        for residual, warns in (("2 um", False), ("30 um", True), ("80 um", True)):
            keys = wing | {"crack_fluid.residual_aperture": residual}
            warned = self.warnings(self.without_reference("kgd_leakoff.yaml"), keys)
            self.assertEqual(any("crack_fluid.residual_aperture" in warning for warning in warned), warns, warned)

    def test_a_probe_beside_a_border_of_rocks(self):
        cap = "{cap: {material: {bulk_modulus: 2.5 GPa, shear_modulus: %s}}}"
        probe = {"time.end": "0.1 s", "output.times": "[]"}
        column = self.without_reference("layered_column.yaml")
        for modulus, at, warns in (("24 GPa", 29, True), ("24 GPa", 15, False), ("3 GPa", 29, False)):
            with self.subTest(modulus=modulus, at=at):
                keys = probe | {"solid.regions": cap % modulus, "output.probes": f"[{{name: p, at: [2 m, {at} m]}}]"}
                warned = self.warnings(column, keys)
                self.assertEqual(any("the border of region 'cap'" in warning for warning in warned), warns, warned)

    def test_a_probe_at_the_end_of_a_crack(self):
        """No mouth at a face ends a crack; what flows in it is read along it."""
        for x, y, field, warns in ((20, 97, "effective_stress", True), (24, 103, "effective_stress", False),
                                   (20, 105, "displacement", False), (1, 101, "displacement", False)):
            probe = {"output.probes": f"[{{name: p, at: [{x} mm, {y} mm], field: {field}}}]"}
            known = self.foreknown(CONFIGS / "griffith.yaml", probe)
            self.assertEqual(any("from the end of cracks[0]" in warning for warning in known), warns, known)
        inside = {"output.probes": "[{name: p, at: [75 mm, 187 mm], field: crack_opening}]"}
        self.assertFalse(any("from the end of" in warning for warning in self.foreknown(FLUID, inside)))
        for r, z, warns in ((4, 17, True), (1, 17, False), (4, 20, False)):
            probe = {"output.probes": f"[{{name: p, at: [{r} mm, 0 mm, {z} mm], field: displacement}}]"}
            known = self.foreknown(CONFIGS / "radial.yaml", probe)
            self.assertEqual(any("from the end of cracks[0]" in warning for warning in known), warns, known)

    def test_stress_behind_a_blow(self):
        for field, warns in (("", True), (", field: effective_stress", True), (", field: velocity", False)):
            probe = {"output.probes": f"[{{name: p, at: [60 mm, 60 mm]{field}}}]"}
            known = self.foreknown(CONFIGS / "kalthoff.yaml", probe)
            self.assertEqual(any("the stress at probe 'p'" in warning for warning in known), warns, known)
        self.assertEqual(self.foreknown(CONFIGS / "kalthoff.yaml"), [])

    def test_density(self):
        pressed = {"pore_flow.fluid.bulk_modulus": "100 kPa", "pore_flow.initial_pressure": "50 kPa"}
        self.assert_warns(MANDEL, SHORT | pressed, "pore_pressure is 0.5 of the fluid's bulk modulus", "through face 'right'")
        soft = {"fluid.bulk_modulus": "20 kPa"}
        water = self.without_reference("hydrostatic.yaml")
        self.assert_warns(water, soft | {"time.end": "20 ms", "output.times": "[]"}, "far from fluid.density")

    def test_an_inlet_beside_walls(self):
        """Of the other one, in the air, no wall is near."""
        known = self.foreknown(FLUIDS["tank"])
        self.assertEqual(len(known), 1, known)
        self.assertIn("'pump' lies so near walls", known[0])
        higher = {"fluid.inlets[0].from": "[0.2 m, 0.15 m]", "fluid.inlets[0].to": "[0.4 m, 0.25 m]"}
        self.assertEqual(self.foreknown(FLUIDS["tank"], higher), [])

    def test_artificial_viscosity(self):
        """As large as the fluid's own, it adds nothing."""
        channel = self.without_reference("poiseuille.yaml")
        steadied = {"fluid.artificial_viscosity": "0.1", "time.end": "1 s"}
        self.assert_warns(channel, steadied)
        self.assert_warns(channel, steadied | {"fluid.viscosity": "20 cP"}, "artificial viscosity takes up")
        # The dam break soon after its gate opened, and of water as stiff as to be treacle between points so far apart.
        dam = self.without_reference("dam_break.yaml")
        soon = {"fluid.spacing": "5.715 mm", "time.end": "60 ms", "output.interval": "60 ms"}
        self.assert_warns(dam, soon)
        self.assert_warns(dam, soon | {"fluid.bulk_modulus": "20 MPa"}, "artificial viscosity takes up")


if __name__ == "__main__":
    unittest.main()
