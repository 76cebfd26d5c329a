"""The page in a real browser. Controls are found by the names that a screen reader says."""

import base64
import os
from pathlib import Path

import pytest

pytest.importorskip("selenium", reason="python3-selenium is missing; scripts/setup --browser installs it")
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

from page_socket import PATIENCE


class Page:
    """The page of a view, by its accessible names alone."""

    def __init__(self, browser, view):
        self.browser = browser
        self.view = view
        browser.get(view.address)
        self.wait_for_exact()

    def find(self, name):
        """The one control that a screen reader calls so."""
        # Those that may be called so: to ask the browser for each control's name takes long.
        controls = self.browser.execute_script("""
            const name = arguments[0], called = (element) => element?.textContent.includes(name);
            const selector = "a, button, input, select, [role=application], [role=status], dialog, pre";
            return [...document.querySelectorAll(selector)].filter((control) =>
                control.getAttribute("aria-label") === name || called(control) ||
                [...(control.labels ?? [])].some(called) ||
                called(document.getElementById(control.getAttribute("aria-labelledby"))));""", name)
        found = [c for c in controls if c.accessible_name == name and c.is_displayed()]
        assert len(found) == 1, f"{len(found)} controls are called {name}"
        return found[0]

    def script(self, text):
        return self.browser.execute_script("return " + text)

    def setting(self, key):
        return self.script(f"app.store.settings['{key}']")

    @property
    def last_state(self):
        return self.script("app.link.lastState")

    def wait_for_exact(self):
        """Until what the page shows is the exact picture of its newest state."""
        newest = ("app.store !== null && app.link.pendingState === null && "
                  "document.body.dataset.stage === 'exact' && "
                  "Number(document.body.dataset.state) === app.link.lastState")
        self.wait_for(newest)

    def picture(self):
        """The pixels on the canvas, as a PNG file."""
        url = self.script("document.getElementById('picture').toDataURL('image/png')")
        return base64.b64decode(url.split(",")[1])

    def wait_for(self, condition):
        WebDriverWait(self.browser, PATIENCE, 0.05).until(lambda _: self.script(condition))

    def press(self, name):
        """Until the exact picture of what this did is shown."""
        self.find(name).click()
        self.wait_for_exact()

    def type_number(self, name, value, wait=False):
        control = self.find(name)
        control.send_keys(Keys.CONTROL, "a")
        control.send_keys(str(value), Keys.ENTER)
        self._wait(wait)

    def choose(self, name, text, wait=False):
        Select(self.find(name)).select_by_visible_text(text)
        self._wait(wait)

    def choose_value(self, name, value, wait=False):
        Select(self.find(name)).select_by_value(value)
        self._wait(wait)

    def drag(self, control, right, down, wait=False):
        ActionChains(self.browser).drag_and_drop_by_offset(control, right, down).perform()
        self._wait(wait)

    def unfold(self):
        """Opens all that is folded away."""
        self.browser.execute_script("for (const part of document.querySelectorAll('details')) part.open = true;")

    def _wait(self, wait):
        if wait:
            self.wait_for_exact()

    def keep_screenshot(self, name):
        folder = os.environ.get("SPLOTCHCL_SCREENSHOTS")
        if folder:
            Path(folder).mkdir(parents=True, exist_ok=True)
            self.browser.save_screenshot(str(Path(folder) / f"{name}.png"))

    def errors(self):
        return [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
