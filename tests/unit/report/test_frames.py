"""How the report chooses what of a run's frames it draws."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "app" / "report"))

import frames  # noqa: E402


class Frames(unittest.TestCase):
    def test_spacing_is_exact_on_lattices(self) -> None:
        axes = [np.arange(n) * 0.25 for n in (7, 4, 3)]
        for dimension in (1, 2, 3):
            points = np.stack(np.meshgrid(*axes[:dimension]), axis=-1).reshape(-1, dimension)
            self.assertAlmostEqual(frames.spacing(points), 0.25, places=12)

    def test_3d_body_is_shown_by_a_layer_across_its_shortest_edge(self) -> None:
        for counts, names, normal, at in (
            ((7, 4, 5), ("x", "z"), 1, 0.25),
            ((3, 7, 5), ("y", "z"), 0, 0.25),
            ((7, 5, 3), ("x", "y"), 2, 0.25),
            ((4, 4, 9), ("x", "z"), 1, 0.25),  # a column is cut along its height
        ):
            axes = [np.arange(n) * 0.25 for n in counts]
            points = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 3)
            cut = frames.middle_cut(points)
            chosen = frames.layer(points, cut)
            self.assertEqual((cut.names, cut.normal, cut.at), (names, normal, at))
            self.assertEqual(len(chosen), len(points) // counts[normal])
            self.assertTrue(np.all(points[chosen, normal] == at))

    def test_plane_body_is_shown_whole(self) -> None:
        points = np.zeros((5, 3))
        points[:, 0] = np.arange(5)
        cut = frames.middle_cut(points)
        chosen = frames.layer(points, cut)
        self.assertEqual((len(chosen), cut.names, cut.at, cut.note()), (5, ("x", "y"), None, ""))

    def test_frames_are_chosen_evenly_and_end_with_the_last(self) -> None:
        self.assertEqual(frames.evenly(9, 3), [0, 4, 8])
        self.assertEqual(frames.evenly(9, 1), [8])
        self.assertEqual(frames.evenly(3, 100), [0, 1, 2])

    def test_plane_crack_in_3d_is_shown_in_its_plane(self) -> None:
        cells = [(x, y) for x in range(4) for y in range(4) if np.hypot(x, y) < 3.7]
        crack = np.array([(x * 1e-3, 0.016, y * 1e-3) for x, y in cells])
        body = np.stack(np.meshgrid(*[np.arange(8) * 1e-3] * 3), axis=-1).reshape(-1, 3)
        common = frames.middle_cut(body)
        cut = frames.own_cut(crack, common)
        self.assertEqual((cut.names, cut.at, len(frames.layer(crack, cut))), (("x", "z"), 0.016, len(cells)))
        np.testing.assert_allclose(frames.square_edges(crack[:, cut.axes], [], cut), 1e-3, rtol=1e-9)
        self.assertEqual(frames.own_cut(body, common), common)

    def test_points_of_another_cut_stand_in_a_map_of_their_own(self) -> None:
        common = frames.Slice((0, 2), 1, 0.0)
        flat = frames.Slice((0, 1), 2, 0.0, flat=True)
        frame = frames.Frame(0.0, np.zeros((1, 2)), np.ones(1), [frames.Field("pore_pressure", "Pa", np.zeros(1))])
        crack, body, fluid = (frames.FrameSeries(n, [frame], 1, c) for n, c in (("c", flat), ("b", common), ("f", common)))
        self.assertIsNone(frames.together([crack, body]))
        self.assertEqual(len(frames.together([crack, body, fluid]).frames[0].points), 2)


if __name__ == "__main__":
    unittest.main()
