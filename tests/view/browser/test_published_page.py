"""Pages of `splotchcl publish`: they show what the program draws, and follow the hand."""

import base64

import pytest

from page_socket import PATIENCE

WIDTH, HEIGHT = 480, 360


@pytest.fixture(scope="module")
def page(run, snapshot, tmp_path_factory):
    """A page of the snapshot, and its picture as the program draws it with the page's footprint."""
    folder = tmp_path_factory.mktemp("page")
    size = ["--size", f"{WIDTH}x{HEIGHT}"]
    run("publish", snapshot, "-o", folder / "page.html", "--title", "A <universe>", *size)
    # Half a pixel, of which the pixel's own area is a twelfth of its square.
    footprint = (0.25 - 1 / 12) ** 0.5
    run("render", snapshot, "-o", folder / "drawn.png", *size, "--set", f"kernel.footprint={footprint}")
    return folder


@pytest.fixture
def opened(browser, page):
    browser.get_log("browser")  # of other pages
    browser.get(f"file://{page}/page.html")
    browser.execute_script(
        "const s = document.getElementById('picture').style;"
        f"s.width = '{WIDTH}px'; s.height = '{HEIGHT}px'; window.dispatchEvent(new Event('resize'));"
    )
    wait_for_picture(browser, WIDTH)
    return browser


def wait_until(browser, holds):
    from selenium.webdriver.support.ui import WebDriverWait

    WebDriverWait(browser, PATIENCE).until(lambda _: holds())


def wait_for_picture(browser, width):
    drawn = f"return document.documentElement.dataset.drawn && document.getElementById('picture').width == {width}"
    wait_until(browser, lambda: browser.execute_script(drawn))


def picture(browser):
    text = browser.execute_script("return document.getElementById('picture').toDataURL('image/png')")
    return base64.b64decode(text.split(",")[1])


def test_shows_what_the_program_draws(opened, page, run):
    (page / "shown.png").write_bytes(picture(opened))
    # Light as halves, splats that end, and eight bits of either.
    run("compare", page / "shown.png", page / "drawn.png", "--limit", 0.02)
    assert opened.title == "A <universe>"
    errors = [entry for entry in opened.get_log("browser") if entry["level"] == "SEVERE"]
    assert errors == []
    assert opened.execute_script("return performance.getEntriesByType('resource').length") == 0


def test_turns_and_begins_anew(opened):
    from selenium.webdriver.common.action_chains import ActionChains

    first = picture(opened)
    canvas = opened.find_element("id", "picture")
    ActionChains(opened).drag_and_drop_by_offset(canvas, 60, 20).perform()
    wait_until(opened, lambda: picture(opened) != first)
    ActionChains(opened).double_click(canvas).perform()
    # While the hand moves pictures may be coarse.
    wait_until(opened, lambda: picture(opened) == first)


def test_says_how_far_it_is_from_the_particles(opened):
    opened.find_element("id", "open-about").click()
    facts = opened.find_element("id", "facts").text
    assert "particles" in facts and "of white (root mean square)" in facts
