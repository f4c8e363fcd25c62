#!/usr/bin/python3
"""What a scene does not name is not there: modules, links, arrays and bytes of one body, to which effects are added
one by one, exactly.

The tables say all that an effect may bring. Each step of a chain is held against the one before it: what was there
stays as it was, and what is new is the effect's. An array that a module makes for an effect that the scene does not
name, such as a pore stress in a solid without pores or the damage of bonds that cannot break, is in no table; nor is
a link, a module, or a field that grows because of a neighbour. Heap per point sees what is no evolving field:
workspace and copies of families."""
import json
import sys
import unittest
from pathlib import Path

from perifrac_runs import PERIFRAC, RunTest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench" / "effects"))
import effects  # noqa: E402

SPACING = {"body.spacing": "5 mm"}
POINTS, FACETS, FLUID = 60 * 30, 20, 60 * 2
HELD = 3  # face values: two of the fixed face, one of the roller
UNKNOWNS = 2 * POINTS + HELD

COUPLING = {f"coupling/{name}": 1 for name in ("time", "step", "window_length", "window_share", "energy_at_start")}
EQUILIBRIUM = {"solid/displacement": UNKNOWNS, "solid/external_force": UNKNOWNS, "solid/external_work": 1, **COUPLING}
MOTION = {"solid/displacement": UNKNOWNS, "solid/acting_force": HELD, "solid/external_work": 1, **COUPLING,
          "solid/velocity": 2 * POINTS, "solid/damped_energy": 1}
TIP = ("x", "y", "direction_x", "direction_y", "facet", "facet_before", "since", "grows", "intensity_ratio", "asked",
       "asked_opening", "intensity_before", "even_opening", "even_sliding", "even_opens", "even_slides", "even_root",
       "even_behind", "even_known", "even_intensity", "scale", "shape_scale", "shape_facets_count", "shape_jumps_count",
       "shape_modes_count", "moved", "took")
CRACKS = {"solid/relief_work": 1, "solid/fracture_energy": 1, "solid/crack_facets": 4 * FACETS,
          "solid/broken_bonds": 3 * 222, **{f"solid/tips/{name}": 2 for name in TIP}}
CRACKS_IN_MOTION = {**CRACKS, "solid/contact_loss": 1, "solid/given_impulse": FACETS,
                    "solid/given_contact_impulse": FACETS}
CRACKS_AT_REST = {**CRACKS, "solid/has_begun": 1, "solid/radiated_energy": 1, "solid/readiness": 1, "solid/last_growth": 1,
                  "solid/crack_opening": FACETS, "solid/face_pressure": FACETS, "solid/closed_faces": FACETS}


# What tells whether one pass a window is stable, of a link that starts on a prediction.
WATCH = ("windows", "mismatch", "growing_mismatch", "exceeds_values", "last_block", "largest_value", "values_before",
         "was_predicted", "growing_blocks", "last_factor", "steady_blocks", "exceeding_blocks", "has_found_growth")


def link(path, count, slope=False, lagged=False):
    arrays = ("output", "output_rate") + (("counter", "counter_rate") if slope else ())
    return {**{f"coupling/{path}/{array}": count for array in arrays},
            **({f"coupling/{path}/stability/{number}": 1 for number in WATCH} if lagged else {})}


PORES = {"pore_flow/fluid_content": POINTS + 1, "pore_flow/pore_pressure": POINTS, "pore_flow/start": 1, "pore_flow/last_jump": 1,
         "pore_flow/accumulated": 2, "coupling/mass_at_start": 1}
PORES_FIRST = {**PORES, "solid/pore_stress": POINTS,
               **link("solid.dilatation.pore_flow", POINTS, slope=True, lagged=True),
               **link("pore_flow.pore_stress.solid", POINTS)}
PORES_LAST = {**PORES, **link("pore_flow.pore_stress.solid", POINTS, slope=True, lagged=True),
              **link("solid.dilatation.pore_flow", POINTS)}
FLUID_POINTS = {f"fluid/{name}": FLUID
                for name in ("position_x", "position_y", "velocity_x", "velocity_y", "density", "mass", "id")}
FLUID_BOOKS = {f"fluid/energy/{name}": 1
               for name in ("centre_x", "centre_y", "at_start", "gained", "gained_lost", "heat", "heat_lost", "steps",
                            "friction", "since_friction", "lag")}
FILM = {**FLUID_POINTS, "fluid/next_id": 1, **FLUID_BOOKS, **link("solid.displacement.fluid", 2 * POINTS, lagged=True),
        **link("fluid.interface_impulse.solid", 2 * POINTS)}


def exchange(fluid):
    return {**link(f"pore_flow.pore_pressure.{fluid}", POINTS, slope=True, lagged=True),
            **link(f"pore_flow.pore_mobility.{fluid}", POINTS, lagged=True), **link(f"{fluid}.exchanged_mass.pore_flow", POINTS)}


SEEPAGE = {"pore_flow/pore_pressure_slope": POINTS, **exchange("fluid")}
TOTALS = ("injected_crack_fluid_mass", "leaked_crack_fluid_mass", "crack_fluid_work", "crack_flow_dissipation")
NETWORK = {**{f"crack_fluid/{name}": FACETS
              for name in ("crack_fluid_mass", "crack_pressure", "crack_pressure_settled", "crack_aperture")},
           "crack_fluid/crack_has_begun": 1, **{f"crack_fluid/{name}": 1 for name in TOTALS},
           **{f"crack_fluid/{name}_lost": 1 for name in TOTALS},
           **link("solid.free_crack_opening.crack_fluid", FACETS, slope=True, lagged=True),
           **link("crack_fluid.crack_pressure.solid", FACETS), **link("crack_fluid.crack_viscosity.solid", FACETS),
           **link("crack_fluid.crack_fluid_weight.solid", FACETS)}  # both chains have gravity
# When the next facet is due beside pores, where tips do not move within facets.
FORESEEN = {"solid/growth_interval": 1, "solid/readiness_rate": 1}
LEAK_OFF = {"crack_fluid/leak_off_rate": 1, **exchange("crack_fluid")}

# Arrays that each effect of a chain of bench/effects brings, and those it takes away; modules and links in all.
EXPECTED = {
    "dynamic": [
        (MOTION, {}), (CRACKS_IN_MOTION, {}), (PORES_LAST, {}), ({"solid/acting_force": POINTS + HELD}, {}),
        ({**FILM, "solid/acting_force": UNKNOWNS}, {}), (SEEPAGE, {}), (NETWORK, {}),
        (LEAK_OFF, exchange("fluid"))],
    "dynamic, bonds that break by stretch": [(MOTION, {}), ({"solid/fracture_energy": 1}, {}), (PORES_LAST, {})],
    "quasi_static": [
        (EQUILIBRIUM, {}), (CRACKS_AT_REST, {}), (PORES_FIRST, {}), ({}, {}),
        ({**NETWORK, **FORESEEN, "solid/crack_pressure": FACETS,
          **link("solid.crack_part.crack_fluid", FACETS, lagged=True)}, {}),
        ({**LEAK_OFF, "pore_flow/pore_pressure_slope": POINTS}, {})],
}
MODULE_OF = {"+ pore flow": "pore_flow", "+ fluid": "fluid", "+ crack network": "crack_fluid"}

# What a solid with inertia holds [bytes a point], measured.
HEAP_OF_MOTION = 448.0


class AbsentEffects(RunTest):

    def test_what_is_there_is_what_was_called_for(self):
        self.assertEqual(EXPECTED.keys(), effects.CHAINS.keys())
        for name, chain in effects.CHAINS.items():
            self.assertEqual(len(chain), len(EXPECTED[name]))
            keys, there, modules = dict(SPACING), {}, {"solid"}
            for (effect, added), (brings, takes) in zip(chain, EXPECTED[name]):
                keys = {**keys, **added}
                there = {array: count for array, count in {**there, **brings}.items() if array not in takes}
                modules |= {MODULE_OF[effect]} if effect in MODULE_OF else set()
                with self.subTest(chain=name, effect=effect):
                    said = effects.check(PERIFRAC, effects.BODY, keys)
                    self.assertEqual({array["name"]: array["count"] for array in said["arrays"]}, there)
                    self.assertEqual(sum(array["bytes"] for array in said["arrays"]), 8 * sum(there.values()))
                    self.assertEqual(set(said["modules"]), modules)
                    links = {array.split("/")[1] for array in there if array.endswith("/output")}
                    self.assertEqual(sorted(said["links"]), sorted(link.split(".")[1] for link in links))

    def heap_per_point(self, keys):
        """Of the solid [bytes]: between two bodies, so that what does not grow with them cancels."""
        held = []
        for spacing in ("5 mm", "2.5 mm"):
            summary = effects.run(PERIFRAC, effects.BODY, {**keys, "body.spacing": spacing}, self.folder / "run",
                                  "--until", "1 us")
            if "-fsanitize" in summary["build"]["flags"]:
                self.skipTest("a sanitizer keeps the heap to itself")
            set_up = next(part for part in summary["profile"]["parts"] if part["name"] == "set-up")
            solid = next(part for part in set_up["parts"] if part["name"] == "solid")
            held.append((summary["counts"]["points"], solid["heap_bytes"]))
        return (held[1][1] - held[0][1]) / (held[1][0] - held[0][0])

    def test_a_solid_alone_holds_no_more_than_it_did(self):
        # One more number a point, kept for what is not there, is 8 bytes.
        self.assertLess(self.heap_per_point({}), HEAP_OF_MOTION + 4.0)
        # The figure can tell: bonds that may break have copies of their own.
        self.assertGreater(self.heap_per_point(effects.STRETCH), HEAP_OF_MOTION + 8.0)


if __name__ == "__main__":
    unittest.main()
