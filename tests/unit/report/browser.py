"""A page in headless Chromium, as tests ask it; without Chromium they are skipped, and say so."""

from __future__ import annotations

import time
import unittest
from pathlib import Path
from typing import Any, Callable

BROWSER, DRIVER = Path("/usr/bin/chromium"), Path("/usr/bin/chromedriver")
PATIENCE = 60.0  # [s] until something shows on a machine that is busy

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ModuleNotFoundError:
    webdriver = None


def missing() -> str:
    """What the tests lack; empty: nothing."""
    packages = [name for name, there in (("chromium", BROWSER.exists()), ("chromium-driver", DRIVER.exists()),
                                         ("python3-selenium", webdriver is not None)) if not there]  # fmt: skip
    return f"not installed: {', '.join(packages)}; tools/install test installs them" if packages else ""


class BrowserTest(unittest.TestCase):
    """One browser for all tests of a class; each must leave no error on its console."""

    @classmethod
    def setUpClass(cls) -> None:
        if missing():
            raise unittest.SkipTest(missing())
        options = webdriver.ChromeOptions()
        options.binary_location = str(BROWSER)
        # Shaders by the processor; a sandbox is not to be had where tests run as root.
        for word in ("headless=new", "no-sandbox", "use-angle=swiftshader", "enable-unsafe-swiftshader", "disable-dev-shm-usage"):
            options.add_argument(f"--{word}")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        cls.browser = webdriver.Chrome(service=Service(str(DRIVER)), options=options)
        cls.addClassCleanup(cls.browser.quit)
        cls.browser.set_page_load_timeout(PATIENCE)
        cls.browser.set_script_timeout(PATIENCE)

    def tearDown(self) -> None:
        errors = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        self.assertEqual(errors, [])

    def open(self, url: str, width: int = 1400, height: int = 1000, dark: bool = False) -> None:
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})  # fmt: skip
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})
        self.browser.get(url)

    def ask(self, expression: str, *arguments: Any) -> Any:
        return self.browser.execute_script(f"return {expression}", *arguments)

    def until(self, expression: str, *arguments: Any) -> Any:
        return self.wait(lambda: self.ask(expression, *arguments), expression)

    def wait(self, found: Callable[[], Any], what: str) -> Any:
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            if value := found():
                return value
            time.sleep(0.1)
        raise AssertionError(f"not within {PATIENCE} s: {what}")

    def part(self, name: str) -> str:
        return f"document.querySelector('[data-part=\"{name}\"]')"

    def text(self, name: str) -> str:
        return self.ask(f"{self.part(name)}.textContent")

    def put(self, name: str, value: Any, event: str = "input") -> None:
        """Moves a slider, picks from a list, or sets a switch; waits until it shows."""
        before = self.ask("document.querySelector('[data-fields]').dataset.shown")
        key = "checked" if isinstance(value, bool) else "value"
        self.browser.execute_script(f"const part = {self.part(name)}; part[arguments[1]] = arguments[0];"
                                    "part.dispatchEvent(new Event(arguments[2], {bubbles: true}))", value, key, event)  # fmt: skip
        self.until("document.querySelector('[data-fields]').dataset.shown !== arguments[0]", before)

    def pixels(self, canvas: str) -> list[int]:
        """Every seventh pixel of a canvas, as RGBA."""
        return self.ask(f"""(() => {{
            const canvas = {self.part(canvas)}, copy = document.createElement("canvas");
            [copy.width, copy.height] = [canvas.width, canvas.height];
            copy.getContext("2d").drawImage(canvas, 0, 0);
            const data = copy.getContext("2d").getImageData(0, 0, copy.width, copy.height).data;
            return Array.from({{length: data.length / 28}}, (_, i) => data.slice(28 * i, 28 * i + 4).join());
        }})()""")

    def colours(self, canvas: str) -> int:
        return len(set(self.pixels(canvas)))

    def hover(self, canvas: str, across: float, down: float) -> None:
        self.browser.execute_script(
            f"const c = {self.part(canvas)}, box = c.getBoundingClientRect();"
            "c.dispatchEvent(new PointerEvent('pointermove', {bubbles: true, clientX: box.left + arguments[0] * box.width,"
            "clientY: box.top + arguments[1] * box.height}))", across, down)  # fmt: skip

    def press(self, canvas: str, *keys: str) -> None:
        for key in keys:
            self.browser.execute_script(f"{self.part(canvas)}.dispatchEvent(new KeyboardEvent('keydown', {{key: arguments[0], bubbles: true}}))", key)

    def too_wide(self) -> int:
        """Pixels by which the page is wider than its window."""
        return self.ask("document.documentElement.scrollWidth - document.documentElement.clientWidth")
