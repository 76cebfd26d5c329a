"""axe-core finds nothing against the live view and published pages."""

import subprocess
import sys
import zipfile

import pytest

Select = pytest.importorskip("selenium.webdriver.support.ui", reason="python3-selenium is missing").Select

from page import Page


@pytest.fixture(scope="module")
def axe(tmp_path_factory) -> str:
    """axe-core, as a package index has it."""
    folder = tmp_path_factory.mktemp("axe")
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--timeout", "20", "--retries", "1",
               "--dest", str(folder), "axe-core-python"]
    if subprocess.run(command, capture_output=True, check=False).returncode != 0:
        pytest.skip("no package index can be reached that has axe-core-python")
    with zipfile.ZipFile(next(folder.glob("*.whl"))) as wheel:
        return wheel.read("axe_core_python/axe.min.js").decode()


def violations(browser, axe):
    browser.execute_script(axe)
    found = browser.execute_async_script(
        "const done = arguments[arguments.length - 1]; axe.run().then((found) => done(found.violations))")
    return [(rule["id"], [node["html"] for node in rule["nodes"]]) for rule in found]


def test_the_live_view_is_accessible(browser, view, axe):
    page = Page(browser, view())
    assert violations(browser, axe) == []
    Select(page.find("Suggested films")).select_by_visible_text("Turn once")
    page.find("Keyframe 1 at 0.0 s").click()
    page.find("Show the plan of the way").click()
    page.find("Keep this view").click()
    page.type_number("Field of view", "none")
    page.find("Light or dark page").click()
    assert violations(browser, axe) == []
    page.find("Light or dark page").click()
    browser.execute_script("for (const part of document.querySelectorAll('details')) part.open = true;")
    assert violations(browser, axe) == []
    page.find("Draw the film").click()
    assert violations(browser, axe) == []
    page.find("Close film").click()
    page.find("Help").click()
    assert violations(browser, axe) == []
    browser.get("about:blank")


def test_a_published_page_is_accessible(browser, run, snapshot, tmp_path, axe):
    run("publish", snapshot, "-o", tmp_path / "page.html", "--size", "64x64", "--splats", 100)
    browser.get(f"file://{tmp_path}/page.html")
    assert violations(browser, axe) == []
    browser.find_element("id", "open-about").click()
    assert violations(browser, axe) == []
