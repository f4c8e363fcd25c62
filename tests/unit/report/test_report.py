"""report.py as its users meet it: run folders in, a picture and a page out."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

import h5py
import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np

import fractured_run
import mandel_run
import puddle_run

REPORT = Path(__file__).resolve().parents[3] / "app" / "report"
sys.path.insert(0, str(REPORT))

import charts  # noqa: E402
import chunks  # noqa: E402
import fracture_panels  # noqa: E402
import page  # noqa: E402
import quantities  # noqa: E402
from crack_paths import crack_paths, neighbours  # noqa: E402
from run import read_run  # noqa: E402


def report(folder: Path) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, REPORT / "report.py", folder], capture_output=True, text=True)


class Page(HTMLParser):
    """Collects what the tests ask for: attributes that fetch, visible text, and the embedded data."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.fetched: list[str] = []
        self.text = ""
        self.code = ""
        self.sections: list[str] = []
        self.data: dict = {}
        self.element = ""
        self.raw_data = ""
        self.feed(path.read_text(encoding="utf-8"))
        self.data = json.loads(self.raw_data)

    def handle_starttag(self, tag: str, attributes: list) -> None:
        known = dict(attributes)
        self.fetched += [f"{tag} {name}={known[name]}" for name in ("src", "href", "srcset", "data") if name in known]
        self.element = "data" if known.get("id") == "run-data" else tag
        if tag == "section" and "hidden" not in known:
            self.sections.append(known["id"])

    def handle_data(self, content: str) -> None:
        if self.element == "data":
            self.raw_data += content
        elif self.element in ("script", "style"):
            self.code += content
        else:
            self.text += content

    def handle_endtag(self, tag: str) -> None:
        self.element = ""

    def chart(self, title: str) -> dict:
        return next(c for c in self.data["charts"] if c["title"] == title)

    @property
    def fields(self) -> dict:
        return self.data["runs"][0]["fields"]

    @property
    def sets(self) -> dict[str, dict]:
        return {one["name"]: one for one in self.fields["sets"]}

    @property
    def views(self) -> dict[str, dict[str, dict]]:
        return {view["name"]: {field["name"]: field for field in view["fields"]} for view in self.fields["views"]}

    def numbers(self, chunk: dict) -> np.ndarray:
        return chunks.unpack(chunk, base64.b64decode(self.data["runs"][0]["chunks"][chunk["key"]]))


def assert_shown(test: unittest.TestCase, page: Page, chunk: dict, values: np.ndarray) -> None:
    """As in the page: within half a step of what a byte or two can tell of the range."""
    shown = page.numbers(chunk)
    test.assertEqual(len(shown), len(values))
    np.testing.assert_allclose(shown, values, rtol=0, atol=0.501 * chunk["step"] + 1e-12 * np.abs(values).max(initial=0))
    if len(values) and np.ptp(values) > 0:
        test.assertLess(chunk["step"], np.ptp(values) / 250)


def check_picture(test: unittest.TestCase, path: Path) -> None:
    content = path.read_bytes()
    test.assertEqual(content[:8], b"\x89PNG\r\n\x1a\n")
    test.assertEqual(struct.unpack(">II", content[16:24]), (2000, 1500))
    pixels = matplotlib.image.imread(path)
    for rows in (slice(0, 750), slice(750, 1500)):
        for columns in (slice(0, 1000), slice(1000, 2000)):
            test.assertGreater(np.std(pixels[rows, columns, :3]), 0.02, "an empty quarter")


class ReportTest(unittest.TestCase):
    def setUp(self) -> None:
        self.scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch)
        self.folder = self.scratch / "run"

    def reported(self) -> Page:
        done = report(self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return Page(self.folder / "report.html")

    def refused(self, folder: Path) -> str:
        done = report(folder)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr


class WithReference(unittest.TestCase):
    """One run, reported once, asked many things."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.scratch = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.scratch)
        cls.folder = cls.scratch / "run"
        cls.summary = mandel_run.write_run(cls.folder)
        done = report(cls.folder)
        assert (done.returncode, done.stderr) == (0, ""), done.stderr
        cls.page = Page(cls.folder / "report.html")

    def test_picture_has_its_size_and_four_panels(self) -> None:
        check_picture(self, self.folder / "report.png")

    def test_page_fetches_nothing(self) -> None:
        page = self.page
        self.assertEqual(page.fetched, [])
        code = re.sub(r"/\*.*?\*/", "", page.code, flags=re.S)
        for forbidden in (r"https?://", r"url\(", r"@import", r"\bfetch\(", r"XMLHttpRequest", r"import\("):
            self.assertIsNone(re.search(forbidden, code), forbidden)

    def test_page_holds_the_histories_and_profiles(self) -> None:
        page, summary = self.page, self.summary
        drawn = {s["label"]: s for s in page.chart("Pore pressure: computed and exact")["series"]}
        for history in summary["reference"]["histories"]:
            place = history["name"].split(" at ")[1]
            for kind in ("computed", "exact"):
                np.testing.assert_allclose(drawn[f"{place}, {kind}"]["y"], history[kind], rtol=5e-6)
                np.testing.assert_allclose(drawn[f"{place}, {kind}"]["x"], history["time"], rtol=5e-6)
        profile = summary["reference"]["profiles"][0]
        drawn_rows = page.chart("Pore pressure along x")["series"]
        for marked, kind in ((True, "computed"), (False, "exact")):
            np.testing.assert_allclose([s["y"] for s in drawn_rows if s["markers"] == marked], profile[kind], rtol=5e-6)
        errors = page.chart("Error against the exact solution")["series"]
        np.testing.assert_allclose(errors[0]["y"], [row["max_error"] for row in summary["reference"]["table"]], rtol=5e-6)

    def test_page_holds_every_frame(self) -> None:
        page = self.page
        frames = page.sets["rock"]["frames"]
        self.assertEqual([t["time"] for t in page.fields["times"]], mandel_run.FRAME_TIMES)
        for number, frame in enumerate(frames):
            with h5py.File(self.folder / "frames" / f"rock_{number:06d}.hdf") as file:
                group = file["VTKHDF"]
                pressure = group["PointData/pore_pressure"][()]
                moved = group["PointData/displacement"][()]
                points = group["Points"][()]
            assert_shown(self, page, frame["values"]["pore_pressure"], pressure)
            assert_shown(self, page, frame["values"]["displacement y"], moved[:, 1])
            self.assertEqual("points" in frame, number == 0, "points are written once while they rest")
            if number == 0:
                assert_shown(self, page, frame["points"]["x"], points[:, 0])
        np.testing.assert_allclose(page.numbers(frames[0]["points"]["edge"]), 1.0, rtol=1e-6)
        self.assertEqual(page.sets["rock"]["velocity"], [], "points at rest have no arrows")
        fields = page.views["rock"]
        self.assertEqual((fields["pore_pressure"]["unit"], fields["pore_pressure"]["factor"]), ("Pa", 1.0))
        self.assertEqual(fields["displacement x"]["unit"], "µm")
        self.assertEqual(fields["displacement (magnitude)"]["of"], {"rock": ["displacement x", "displacement y"]})

    def test_tables_tell_outcome_errors_ledger_and_cost(self) -> None:
        page = self.page
        for expected in ("Mandel's problem", "done", "solid: quasi static", "1.27 × 10⁻³", "time = 1.653 s, x = 39.5 m",
                         "0.0712 kg/m", "−0.0519 kg/m", "387 ms", "59 %", "41.3 MB"):  # fmt: skip
            self.assertIn(expected, page.text)
        self.assertEqual(page.sections, ["fields", "comparison", "histories", "errors", "setup", "ledger", "cost", "reproduce"])

    def test_inputs_and_the_command_that_runs_it_again(self) -> None:
        for expected in ("set-up", "dimension2", "perifrac run configs/mandel.yaml"):
            self.assertIn(expected.lower(), self.page.text.lower())


    def test_scene_text_cannot_break_out_of_the_page(self) -> None:
        page, summary = self.page, self.summary
        self.assertIn("</script>", summary["scene"]["text"])
        self.assertIn(summary["scene"]["text"], page.text)


class WithoutReference(ReportTest):
    def test_run_without_reference_shows_probes_and_fields(self) -> None:
        mandel_run.write_run(self.folder, with_reference=False)
        page = self.reported()
        check_picture(self, self.folder / "report.png")
        self.assertEqual([c["title"] for c in page.data["charts"]], ["Pore pressure", "Fluid mass"])
        self.assertEqual([s["label"] for s in page.data["charts"][0]["series"]], list(mandel_run.PROBES))
        self.assertNotIn("errors", page.sections)


class MovingPoints(ReportTest):
    """A body and a fluid whose points move and vanish, in one picture."""

    def pool(self) -> Page:
        puddle_run.write_run(self.folder)
        return self.reported()

    def test_all_points_stand_in_one_map_on_one_scale(self) -> None:
        page = self.pool()
        self.assertEqual(list(page.views), ["all", "body", "fluid"])
        fields = page.views["all"]
        self.assertEqual(fields["pressure"]["of"], {"body": ["pore_pressure"], "fluid": ["fluid_pressure"]})
        self.assertEqual(fields["velocity x"]["of"], {"fluid": ["fluid_velocity x"]})
        self.assertNotIn("displacement x", fields, "the body's alone, and it does not move")
        for step in range(len(puddle_run.TIMES)):
            self.assertEqual(page.fields["times"][step]["time"], puddle_run.TIMES[step])
            body, fluid = (page.sets[name]["frames"][step] for name in ("body", "fluid"))
            for place, axis in enumerate("xy"):
                assert_shown(self, page, fluid["points"][axis], puddle_run.water(step)[:, place])
            assert_shown(self, page, body["values"]["pore_pressure"], puddle_run.pore_pressure(step))
            assert_shown(self, page, fluid["values"]["fluid_pressure"], puddle_run.fluid_pressure(step))
            assert_shown(self, page, fluid["values"]["fluid_velocity x"], puddle_run.velocity(step)[:, 0])
        pressures = [puddle_run.pore_pressure(3).max(), *(puddle_run.fluid_pressure(s).max() for s in range(4))]
        self.assertEqual(fields["pressure"]["high"], max(pressures))

    def test_fluid_points_are_as_large_as_their_volume(self) -> None:
        page = self.pool()
        for step, frame in enumerate(page.sets["fluid"]["frames"]):
            edge = puddle_run.SPACING * np.sqrt(1.0 - 0.2 * step)
            self.assertEqual(len(page.numbers(frame["points"]["x"])), len(puddle_run.water(step)))
            np.testing.assert_allclose(page.numbers(frame["points"]["edge"]), edge, rtol=1e-6)

    def test_arrows_are_of_what_moves(self) -> None:
        page = self.pool()
        self.assertEqual(page.sets["body"]["velocity"], [])
        self.assertEqual(page.sets["fluid"]["velocity"], ["fluid_velocity x", "fluid_velocity y"])

    def test_picture_and_history_show_them(self) -> None:
        puddle_run.write_run(self.folder)
        page = self.reported()
        check_picture(self, self.folder / "report.png")
        drawn = page.chart("Free fluid mass, fluid mass stored, fluid mass gained")["series"]
        self.assertEqual(drawn[0]["y"][0], puddle_run.mass(0) * 24)
        self.assertIn("points48fluid points24", page.text)

    def test_fluid_that_has_drained_away(self) -> None:
        puddle_run.write_run(self.folder)
        nothing = {name: (unit, values[:0]) for name, (unit, values) in puddle_run.fluid_frame(3)[1].items()}
        puddle_run.write_frame(self.folder / "frames" / "fluid_000003.hdf", np.empty((0, 3)), nothing)
        page = self.reported()
        self.assertEqual(page.sets["fluid"]["frames"][-1]["points"]["x"]["count"], 0)
        self.assertEqual(page.sets["body"]["frames"][-1]["values"]["pore_pressure"]["count"], len(puddle_run.ground()))


class BrokenRuns(ReportTest):
    def test_numbers_that_are_not_finite(self) -> None:
        summary = mandel_run.write_run(self.folder)
        reference = summary["reference"]
        reference["histories"][0]["computed"][5] = None
        reference["histories"][1]["computed"] = [None] * len(reference["histories"][1]["computed"])
        reference["table"][0]["plate_error"] = None
        reference["quantities"][0]["max_error"] = None
        (self.folder / "summary.json").write_text(json.dumps(summary))
        page = self.reported()
        drawn = {s["label"]: s["y"] for s in page.chart("Pore pressure: computed and exact")["series"]}
        self.assertIsNone(drawn["x = 0, computed"][5])
        self.assertNotIn("x = a/4, computed", drawn)
        self.assertEqual(len(page.chart("Error against the exact solution")["series"][1]["y"]), 6)
        self.assertIn("not finite", page.text)

    def test_killed_run_without_summary_and_with_broken_ends(self) -> None:
        mandel_run.write_run(self.folder)
        (self.folder / "summary.json").unlink()
        with (self.folder / "history.csv").open("a") as stream:
            stream.write("120.0,60,1")
        (self.folder / "frames" / "rock_000008.hdf").write_bytes(b"cut short")
        page = self.reported()
        self.assertIn("unfinished", page.text)
        self.assertEqual(len(page.fields["times"]), 8)
        self.assertEqual(page.data["charts"][0]["series"][0]["x"][-1], 100.0)

    def test_summary_alone_is_enough(self) -> None:
        mandel_run.write_run(self.folder)
        shutil.rmtree(self.folder / "frames")
        (self.folder / "history.csv").unlink()
        (self.folder / "summary.json").write_text('{"scene": {"title": "Short"}, "outcome": "failed"}')
        page = self.reported()
        self.assertIn("failed", page.text)
        self.assertEqual(page.sections, [])

    def test_why_a_run_failed(self) -> None:
        self.folder.mkdir()
        failure = {"error": "a & b in pressure at point 3, t = 2 s", "field": "pressure", "place": "point 3",
                   "time": {"value": 2.0, "unit": "s"}, "advice": "shorter windows"}
        summary = {"outcome": "failed", "failure": failure, "warnings": ["one pass <may> not hold"]}
        (self.folder / "summary.json").write_text(json.dumps(summary))
        page = self.reported()
        for words in ("Why it failed", "a & b in pressure at point 3", "shorter windows", "one pass <may> not hold"):
            self.assertIn(words, page.text)
        self.assertEqual(page.sections, ["failure", "warnings"])


class Sizes(ReportTest):
    """However much a run leaves, its page opens at once."""

    def size(self, dimension: int, count: int, frames: int) -> tuple[int, Page]:
        times = list(np.linspace(0.0, 1.0, frames))
        fractured_run.write_run(self.folder, dimension, count, 1e-2 / count, times)
        page.write_page(read_run(self.folder), self.folder / "report.html")
        return (self.folder / "report.html").stat().st_size, Page(self.folder / "report.html")

    def test_a_specimen_of_thirty_thousand_points(self) -> None:
        size, shown = self.size(2, 173, 21)
        self.assertLessEqual(size, page.LARGEST_PAGE)
        self.assertEqual(len(shown.fields["times"]), 21)
        self.assertEqual(shown.sets["body"]["note"], "", "every point is shown")

    def test_a_block_that_must_be_coarsened(self) -> None:
        size, shown = self.size(3, 40, 12)
        self.assertLessEqual(size, page.LARGEST_PAGE)
        self.assertIn("means of up to 8 points", shown.sets["body"]["note"])
        damage = shown.numbers(shown.sets["body"]["frames"][-1]["values"]["damage"])
        self.assertTrue(((damage > 0.05) & (damage < 0.95)).any(), "means")
        self.assertEqual(damage.size, 20**3)


class Fractures(ReportTest):
    """Axes suit a specimen and a field alike."""

    def labels(self, spacing: float) -> tuple[list[str], float]:
        folder = self.folder / f"{spacing}"
        fractured_run.write_run(folder, spacing=spacing)
        figure, drawn = plt.subplots(1, 2)
        for axes, panel in zip(drawn, fracture_panels.fracture_panels(read_run(folder))):
            panel(axes)
        found = [axes.get_xlabel() for axes in drawn], drawn[0].get_xlim()[1]
        plt.close(figure)
        return found

    def test_lengths_are_in_the_unit_that_suits(self) -> None:
        names, right = self.labels(5e-4)
        self.assertEqual(names, ["x [mm]", "from its mouth [mm]"])
        self.assertTrue(1 < right <= 10, right)
        names, right = self.labels(4.0)
        self.assertEqual(names, ["x [m]", "from its mouth [m]"])
        self.assertTrue(10 < right <= 80, right)

    def test_openings_have_a_chart_of_their_own(self) -> None:
        folder = self.folder / "history"
        fractured_run.write_run(folder, spacing=5e-4)
        (folder / "history.csv").write_text(
            "time [s],crack_length [m],inlet_notch_opening [m],fluid_lag [m]\n0,0.01,1e-6,0\n1,0.02,2e-6,0.001\n", encoding="utf-8")
        titles = [chart.title for chart in charts.history_charts(read_run(folder))]
        self.assertEqual(titles, ["Crack length, fluid lag", "Inlet notch opening"])

    def test_what_goes_on_comes_before_what_stays(self) -> None:
        folder = self.folder / "history"
        fractured_run.write_run(folder, spacing=5e-4)
        (folder / "history.csv").write_text(
            "time [s],crack_length [m],crack_slip_area [m^2]\n0,0.01,0\n1,0.01,2e-6\n", encoding="utf-8")
        titles = [chart.title for chart in charts.history_charts(read_run(folder))]
        self.assertEqual(titles, ["Crack slip area", "Crack length"])

    def test_pore_pressure_is_coloured_from_the_least_to_the_most(self) -> None:
        """From 0 where it is the same everywhere; no scale of what is in cracks that are closed."""
        points = np.array([[x, y] for x in range(4) for y in range(4)], float)
        for pores, least in ((np.linspace(15e6, 16e6, 16), 15.0), (np.full(16, 15e6), 0.0)):
            rock = fracture_panels.PointSet(points, {"pore_pressure": pores})
            crack = fracture_panels.PointSet(points[:2], {"crack_opening": np.zeros(2), "crack_pressure": np.ones(2)})
            figure, axes = plt.subplots()
            fracture_panels.pore_panel(fracture_panels.Fracture(1.0, rock, crack, None, neighbours(points[:2])))(axes)
            self.assertAlmostEqual(axes.collections[0].get_clim()[0], least, delta=0.02)
            self.assertEqual(len(axes.child_axes), 1)
            plt.close(figure)

    def test_slip_is_drawn_along_cracks_that_are_closed(self) -> None:
        """Of all facets, and the pressure of those that hold fluid."""
        points = np.array([[x, 0.0] for x in range(5)])
        fields = {"crack_opening": np.zeros(5), "crack_slip": -1e-3 * np.arange(5.0), "crack_pressure": 2e6 + np.arange(5.0),
                  "crack_wetted_fraction": np.array([1.0, 1.0, 0.5, 0.0, 0.0])}  # fmt: skip
        crack = fracture_panels.PointSet(points, fields)
        fracture = fracture_panels.Fracture(1.0, crack, crack, None, neighbours(points))
        figure, axes = plt.subplots()
        fracture_panels.along_panel(fracture, crack_paths(points))(axes)
        self.assertEqual(axes.get_ylabel(), "slip [mm]")
        np.testing.assert_allclose(axes.get_lines()[0].get_ydata(), [0, 1, 2, 3, 4])
        self.assertEqual(len(figure.axes[1].get_lines()[0].get_ydata()), 3)
        plt.close(figure)

    def test_two_cracks_with_two_wings_each_are_two_lines(self) -> None:
        """Their facets grow by turns, one wing longer than the other."""
        points = np.array([[x, y] for x in (0.5, -0.5, 1.5, -1.5, 2.5) for y in (0.0, 9.0)])
        opening = np.array([0.4, 0.5, 0.4, 0.5, 0.3, 0.2, 0.3, 0.2, 0.1, 0.1])
        crack = fracture_panels.PointSet(points, {"crack_opening": opening, "crack_pressure": 1e6 + opening})
        fracture = fracture_panels.Fracture(1.0, crack, crack, None, neighbours(points))
        figure, axes = plt.subplots()
        fracture_panels.along_panel(fracture, crack_paths(points))(axes)
        lines = [line.get_xydata() for line in axes.get_lines()]
        self.assertEqual(axes.get_xlabel(), "from where it began [m]")
        plt.close(figure)
        np.testing.assert_allclose(lines[0], np.c_[[-2, -1, 0, 1, 2], [300, 400, 400, 300, 100]])
        np.testing.assert_allclose(lines[1], np.c_[[-2, -1, 0, 1, 2], [200, 500, 500, 200, 100]])


class Packed(unittest.TestCase):
    def test_what_is_packed_comes_back(self) -> None:
        random = np.random.default_rng(1)
        for values in (random.normal(size=5000), np.array([]), np.full(9, 3.5), np.array([np.nan, 1.0, np.inf, 2.0]),
                       np.concatenate([random.normal(size=9000), [1e6, -1e6]])):  # fmt: skip
            told, packed = chunks.pack(values)
            known = np.isfinite(values)
            back = chunks.unpack(told, packed)
            self.assertTrue(np.all(np.isnan(back[~known])))
            np.testing.assert_allclose(back[known], values[known], rtol=0, atol=0.501 * told["step"])

    def test_a_peak_does_not_take_all_steps(self) -> None:
        values = np.concatenate([np.linspace(0.0, 1.0, 9000), [100.0]])
        self.assertLess(chunks.pack(values)[0]["step"], 1.0 / 100)


class Paths(unittest.TestCase):
    def test_a_crack_with_two_wings_and_a_branch(self) -> None:
        wings = [[x, 0.0] for x in (0, 1, -1, 2, -2, 3)] + [[2.0, y] for y in (1.0, 2.0, 3.0)]
        paths = crack_paths(np.array(wings))
        np.testing.assert_array_equal(paths.along[:5], [0, 1, -1, 2, -2])
        self.assertEqual(len(set(paths.branch)), 2)
        self.assertEqual(len(paths.joined), 1)

    def test_a_crack_counts_towards_larger_x_whichever_wing_is_longer(self) -> None:
        for points, along in (((0, 1, -1, 2, -2, 3), [0, 1, -1, 2, -2, 3]), ((0, 1, -1, -2, -3), [0, 1, -1, -2, -3])):
            paths = crack_paths(np.array([[x, 0.0] for x in points]))
            np.testing.assert_array_equal(paths.along, along)

    def test_two_cracks(self) -> None:
        points = np.array([[x, y] for y in (0.0, 50.0) for x in range(5)], dtype=float)
        paths = crack_paths(points)
        np.testing.assert_array_equal(paths.branch, [0] * 5 + [1] * 5)
        np.testing.assert_array_equal(paths.along, [0, 1, 2, 3, 4] * 2)


class Refused(ReportTest):
    def test_folder_without_a_run(self) -> None:
        self.folder.mkdir()
        self.assertIn(f"{self.folder}: holds no run; expected summary.json", self.refused(self.folder))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_no_folder(self) -> None:
        self.assertIn(f"{self.folder}: no such folder", self.refused(self.folder))

    def test_summary_that_is_no_json(self) -> None:
        self.folder.mkdir()
        (self.folder / "summary.json").write_text('{"outcome":\n  done}')
        self.assertIn("summary.json:2:3: not JSON", self.refused(self.folder))

    def test_results_that_are_no_files(self) -> None:
        self.folder.mkdir()
        os.mkfifo(self.folder / "history.csv")
        self.assertIn("history.csv: not a file", self.refused(self.folder))
        os.mkfifo(self.folder / "summary.json")
        self.assertIn("summary.json: not a file", self.refused(self.folder))

    def test_history_without_time(self) -> None:
        self.folder.mkdir()
        (self.folder / "history.csv").write_text("step,mass [kg]\n1,2.0\n")
        self.assertIn("history.csv: no column 'time'", self.refused(self.folder))


class Parts(unittest.TestCase):
    def test_synthetic_pressure_is_the_known_solution(self) -> None:
        """p/p0 at a/4, a/2, 3a/4 after 10 s, from an independent evaluation of the series."""
        found = mandel_run.pressure(np.array([10.0, 20.0, 30.0]), 10.0) / mandel_run.PRESSURE_SCALE
        np.testing.assert_allclose(found, [1.05127, 0.92629, 0.58284], atol=6e-6)

    def test_prefixes(self) -> None:
        cases = {
            (106.3e6, "Pa"): "106.3 MPa",
            (1000.0, "Pa"): "1 kPa",
            (1.6e-4, "m"): "160 µm",
            (0.001, "s"): "1 ms",
            (7200.0, "s"): "7200 s",
            (2.5e4, "N/m"): "25 kN/m",
            (1e-12, "m^2"): "1 × 10⁻¹² m²",
            (0.07, "kg/m"): "0.07 kg/m",
            (-3.0e-5, ""): "−3 × 10⁻⁵",
            (0.0, "Pa"): "0 Pa",
        }
        for (value, unit), expected in cases.items():
            self.assertEqual(quantities.quantity(value, unit), expected)

    def test_embedded_names_cannot_end_the_script(self) -> None:
        data = {"label": "</script><!--"}
        self.assertNotIn("<", page.embedded(data))
        self.assertEqual(json.loads(page.embedded(data)), data)

    def test_time_is_logarithmic_where_steps_grow(self) -> None:
        self.assertTrue(charts.spans_decades(np.cumsum(1e-3 * 1.1 ** np.arange(100))))
        self.assertFalse(charts.spans_decades(np.linspace(0.0, 1.0, 1001)))  # even steps, three decades
        self.assertFalse(charts.spans_decades(np.array([0.0, 1.0, 10.0, 100.0])))
        self.assertFalse(charts.spans_decades(np.array([0.0, 1.0])))


if __name__ == "__main__":
    unittest.main()
