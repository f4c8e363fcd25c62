"""Report and comparison as a reader meets them: in a browser, with mouse and keyboard."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import fractured_run
import puddle_run
from browser import BrowserTest

REPORT = Path(__file__).resolve().parents[3] / "app" / "report" / "report.py"


def page_of(*folders: Path) -> str:
    done = subprocess.run([sys.executable, REPORT, *folders], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return Path(done.stdout.splitlines()[-1]).as_uri()


class Pages(BrowserTest):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.scratch = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.scratch)
        cls.plate, cls.block, cls.pool = (cls.scratch / name for name in ("plate", "block", "pool"))
        fractured_run.write_run(cls.plate)
        fractured_run.write_run(cls.block, dimension=3, count=12)
        puddle_run.write_run(cls.pool)
        cls.urls = {folder: page_of(folder) for folder in (cls.plate, cls.block, cls.pool)}

    def show(self, url: str, **how: object) -> None:
        self.open(url, **how)
        self.until("document.querySelector('[data-fields]').dataset.shown")

    def test_slider_shows_each_frame(self) -> None:
        self.show(self.urls[self.plate])
        self.assertEqual(self.text("now"), "t = 1 s")
        last = self.pixels("map")
        self.put("time", 0)
        self.assertEqual(self.text("now"), "t = 0 s")
        self.assertNotEqual(self.pixels("map"), last)
        self.assertGreater(self.colours("map"), 20)

    def test_hover_tells_place_and_value(self) -> None:
        self.show(self.urls[self.plate])
        self.put("field", self.ask(f"[...{self.part('field')}.options].find((o) => o.text === 'largest principal effective stress').value"), "change")
        self.hover("map", 0.2, 0.15)  # far from the peak: the larger one is the smaller compression
        self.assertRegex(self.text("readout"), r"x = [\d.]+ mm, y = [\d.]+ mm: largest principal effective stress -(0\.99\d*|1(\.0\d*)?) MPa")
        self.hover("map", 0.001, 0.001)
        self.assertIn("from", self.text("readout"))

    def test_fields_displacement_and_switches(self) -> None:
        self.show(self.urls[self.plate])
        names = self.ask(f"[...{self.part('field')}.options].map((o) => o.text)")
        for name in ("largest principal effective stress", "smallest principal effective stress", "displacement (magnitude)", "damage"):
            self.assertIn(name, names)
        for name, value, event in (("magnify", 20, "input"), ("crosses", False, "change"), ("cracks", False, "change"),
                                   ("field", str(names.index("damage")), "change")):  # fmt: skip
            before = self.pixels("map")
            self.put(name, value, event)
            self.assertNotEqual(self.pixels("map"), before, name)
        self.assertIn("×", self.text("magnified"))

    def test_opening_along_the_crack(self) -> None:
        self.show(self.urls[self.plate])
        titles = "[...document.querySelectorAll('[data-part=\"along\"] h3')].map((h) => h.textContent)"
        self.assertEqual(self.ask(titles), ["Crack opening along the crack", "Crack pressure along the crack"])
        longest = "Math.max(...document.querySelector('[data-fields]').view.along.charts.values().next().value.plot.data[0])"
        self.assertAlmostEqual(self.ask(longest), 13 * 0.5, delta=0.01)  # [mm], from the first of 14 facets
        self.put("time", 0)
        self.assertAlmostEqual(self.ask(longest), 5 * 0.5, delta=0.01)

    def test_what_stands_beside_the_fields_and_in_which_order(self) -> None:
        self.show(self.urls[self.plate])
        self.assertEqual(self.ask("[...document.querySelectorAll('main > section')].map((s) => s.id)"),
                         ["fields", "comparison", "histories", "warnings", "errors", "setup", "ledger", "reproduce"])  # fmt: skip
        beside = self.ask("[...document.querySelectorAll('.beside h3')].map((h) => h.textContent)")
        self.assertEqual(beside, ["Inlet well pressure", "Crack length: computed and table"])
        text = self.ask("document.body.innerText")
        self.assertIn("Errors against the table elsewhere.csv", text)
        self.assertNotIn("exact", text)
        self.assertIn("solid.material.youngs_modulus\t25 GPa", text)
        self.assertIn("perifrac run crack.yaml --set 'solid.material.youngs_modulus=25 GPa'", text)

    def test_block_turns_by_keys_and_mouse(self) -> None:
        self.show(self.urls[self.block])
        self.assertGreater(self.colours("solid"), 20)
        first = self.pixels("solid")
        self.press("solid", "ArrowLeft", "ArrowUp")
        turned = self.pixels("solid")
        self.assertNotEqual(turned, first)
        self.press("solid", "Home")
        self.assertEqual(self.pixels("solid"), first)
        self.press("solid", "+")
        self.assertNotEqual(self.pixels("solid"), first)

    def test_slice_of_a_block(self) -> None:
        self.show(self.urls[self.block])
        first, cut_open = self.pixels("map"), self.pixels("solid")
        self.put("cut", 90)
        self.assertNotEqual(self.pixels("map"), first)
        self.assertNotEqual(self.pixels("solid"), cut_open)
        self.put("normal", "2", "change")
        self.assertIn("z = ", self.text("cut-now"))
        self.assertIn("crack", self.ask(f"[...{self.part('view')}.options].map((o) => o.text)"))
        self.put("view", "1", "change")
        self.until(f"{self.part('readout')}.textContent.includes('crack pressure at')")

    def test_moving_points(self) -> None:
        self.show(self.urls[self.pool])
        self.assertEqual(self.ask(f"[...{self.part('view')}.options].map((o) => o.text)"), ["all", "body", "fluid"])
        self.assertIn("Longest arrow", self.text("key"))
        before = self.pixels("map")
        self.put("arrows", False, "change")
        self.assertNotEqual(self.pixels("map"), before)

    def test_dark_light_and_phones(self) -> None:
        grounds = []
        for dark in (False, True):
            for width in (1400, 390):
                for url in self.urls.values():
                    self.show(url, width=width, dark=dark)
                    self.assertLessEqual(self.too_wide(), 0, (url, width))
                    self.assertGreater(self.ask(f"{self.part('map')}.clientWidth"), 300 if width == 390 else 350)
            grounds.append(self.ask("getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(grounds, ["rgb(255, 255, 255)", "rgb(18, 24, 31)"])

    def test_keyboard_reads_a_chart(self) -> None:
        self.show(self.urls[self.plate])
        self.browser.execute_script("const area = document.querySelector('.beside [tabindex]'); area.focus();"
                                    "area.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', bubbles: true}))")  # fmt: skip
        self.until("document.querySelector('.beside .u-legend .u-value').textContent !== ''")

    def test_two_runs_side_by_side(self) -> None:
        other = self.scratch / "other"
        fractured_run.write_run(other, count=24, times=[0.0, 0.25, 0.5, 0.75, 1.0])
        self.show(page_of(self.plate, other))
        nows = "[...document.querySelectorAll('[data-part=\"now\"]')].map((o) => o.textContent)"
        self.until(f"{nows}.every((now) => now === 't = 1 s')")
        self.put("time", 1)
        self.until(f"{nows}.every((now) => now === 't = 500 ms')")
        ends = [self.ask(f"[...document.querySelectorAll('[data-part=\"{end}\"]')].map((o) => parseFloat(o.textContent.replace(/[≤≥ ]/g, '')))")
                for end in ("low", "high")]  # fmt: skip
        self.assertEqual([one[0] for one in ends], [one[1] for one in ends], "one scale")
        self.assertIn("B: inlet well pressure", self.ask("document.body.textContent"))
        self.open(page_of(self.plate, other), width=390)
        self.assertLessEqual(self.too_wide(), 0)


if __name__ == "__main__":
    import unittest

    unittest.main()
