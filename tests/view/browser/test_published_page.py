"""Pages of `splotchcl publish`: they show what the program draws, and follow the hand."""

import base64
import math

import pytest

from page_socket import PATIENCE

WIDTH, HEIGHT = 480, 360
# Half a pixel, of which the pixel's own area is a twelfth of its square.
FOOTPRINT = f"kernel.footprint={(0.25 - 1 / 12) ** 0.5}"


def make_page(run, snapshot, folder, *settings):
    """A page of the snapshot, and its picture as the program draws it with the page's footprint."""
    words = ["--size", f"{WIDTH}x{HEIGHT}"]
    for setting in settings:
        words += ["--set", setting]
    run("publish", snapshot, "-o", folder / "page.html", "--title", "A <universe>", *words)
    run("render", snapshot, "-o", folder / "drawn.png", *words, "--set", FOOTPRINT)
    return folder


@pytest.fixture(scope="module")
def page(run, snapshot, tmp_path_factory):
    return make_page(run, snapshot, tmp_path_factory.mktemp("page"))


@pytest.fixture
def opened(browser, page):
    return open_page(browser, page)


def open_page(browser, page):
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


def gas_that_hides(folder, is_gray):
    settings = ["component.gas.absorption=4"]
    if is_gray:
        (folder / "white.txt").write_text("1 1 1\n1 1 1\n")
        settings.append(f"component.gas.absorption_palette={folder / 'white.txt'}")
    return settings


@pytest.mark.parametrize("is_gray", [True, False])
def test_shows_what_hides_what(browser, run, snapshot, tmp_path, is_gray):
    make_page(run, snapshot, tmp_path, *gas_that_hides(tmp_path, is_gray))
    opened = open_page(browser, tmp_path)
    (tmp_path / "shown.png").write_bytes(picture(opened))
    # Beside the brightest clouds places of 16 bits are seen.
    run("compare", tmp_path / "shown.png", tmp_path / "drawn.png", "--limit", 0.05)
    assert [entry for entry in opened.get_log("browser") if entry["level"] == "SEVERE"] == []
    opened.find_element("id", "open-about").click()
    assert "Clouds absorb" in opened.find_element("id", "facts").text


def test_sorts_what_hides_what_anew_when_one_looks_from_behind(browser, run, snapshot, tmp_path):
    settings = gas_that_hides(tmp_path, is_gray=True)
    # What would otherwise depend on what is in view.
    settings += ["component.gas.reference_column=2e-6", "component.stars.reference_column=2e-4",
                 "camera.look_at=[25000, 25000, 25000]"]
    make_page(run, snapshot, tmp_path, *settings, "camera.position=[75000, 25000, 25000]")
    opened = open_page(browser, tmp_path)
    before = picture(opened)
    turns = 31
    finish = opened.execute_script(f"""
        const key = () => new KeyboardEvent('keydown', {{key: 'ArrowRight', bubbles: true}});
        for (let i = 0; i < {turns}; ++i) document.getElementById('picture').dispatchEvent(key());
        return JSON.parse(document.getElementById('settings').textContent).finish;
    """)
    wait_until(opened, lambda: picture(opened) != before)
    (tmp_path / "shown.png").write_bytes(picture(opened))
    # Turned about the downward axis, where the program looks from as well.
    angle = 0.1 * turns
    place = [25000 + 50000 * math.cos(angle), 25000 - 50000 * math.sin(angle), 25000]
    settings += [f"camera.position={place}", f"finish.exposure={math.log2(finish['gain'])}",
                 f"finish.white={finish['white']}", FOOTPRINT]
    words = [word for setting in settings for word in ("--set", setting)]
    run("render", snapshot, "-o", tmp_path / "behind.png", "--size", f"{WIDTH}x{HEIGHT}", *words)
    run("compare", tmp_path / "shown.png", tmp_path / "behind.png", "--limit", 0.02)
    with pytest.raises(AssertionError):  # as it would be unsorted, or unturned
        run("compare", tmp_path / "shown.png", tmp_path / "drawn.png", "--limit", 0.3)


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
