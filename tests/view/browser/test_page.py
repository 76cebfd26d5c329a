"""What the page shows of a scene, changes, saves and keeps."""

import json

import pytest

pytest.importorskip("selenium", reason="python3-selenium is missing; scripts/setup --browser installs it")
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from page import Page
from page_socket import PATIENCE


def test_orbit_palette_range_and_save_are_found_by_their_names(page):
    for name in ("Picture", "Orbit left", "Orbit right", "Orbit up", "Orbit down", "Pan left",
                 "Move closer", "Move away", "Field of view", "Palette of gas", "Range minimum of gas",
                 "Range maximum of gas", "Range minimum slider of gas", "Brightness of gas",
                 "Show gas", "Exposure", "Tone", "Undo", "Redo", "Save scene", "Save picture", "Help"):
        page.find(name)


def test_every_control_has_a_name(page):
    page.unfold()
    controls = page.browser.find_elements(By.CSS_SELECTOR, "button, input, select, [tabindex]")
    assert len(controls) > 30
    assert [c.get_attribute("outerHTML") for c in controls
            if c.is_displayed() and not c.accessible_name] == []


def test_palette_and_range_change_the_picture(page):
    pictures = [page.picture()]
    page.choose("Palette of gas", "viridis", wait=True)
    pictures.append(page.picture())
    middle = (page.setting("component.0.color.min") * page.setting("component.0.color.max")) ** 0.5
    page.type_number("Range minimum of gas", middle, wait=True)
    pictures.append(page.picture())
    assert page.setting("component.0.color.min") == pytest.approx(middle, rel=1e-4)
    assert len(set(pictures)) == 3
    page.press("Adapt range of gas to the data")
    assert page.setting("component.0.color.min") < middle


def test_all_palettes_are_shown_to_choose_from(page):
    page.browser.find_element(By.TAG_NAME, "summary").click()
    # They are asked for when the list is opened.
    choices = WebDriverWait(page.browser, PATIENCE).until(
        lambda browser: browser.find_elements(By.CSS_SELECTOR, "[role=radiogroup] input"))
    assert len(choices) > 30
    page.find("cividis for gas").click()
    assert page.setting("component.0.palette") == "cividis"
    page.keep_screenshot("palettes")


def test_a_kind_of_particles_is_added_and_removed_again(page):
    before = page.picture()
    page.choose_value("Add a component", "gas")
    page.wait_for("app.components.length === 3")
    page.wait_for_exact()
    assert page.picture() != before
    page.choose("Palette of gas 2", "viridis")
    page.press("Remove the component gas 2")
    assert page.picture() == before


def test_what_no_scene_can_have_is_said_beside_the_field(page):
    field = page.find("Field of view")
    page.type_number("Field of view", "many")
    assert "expected a number" in problem_of(page, field)
    page.type_number("Field of view", 400)
    assert "found 400, expected a number from 0.001 to 360" in problem_of(page, field)
    page.unfold()
    where = page.find("Only gas where")
    where.send_keys("nonsense > 1", Keys.ENTER)
    WebDriverWait(page.browser, PATIENCE).until(lambda _: where.get_attribute("aria-invalid"))
    assert "nonsense" in problem_of(page, where)
    where.clear()
    where.send_keys("density > 0", Keys.ENTER)
    page.wait_for_exact()
    assert where.get_attribute("aria-invalid") is None


def problem_of(page, field):
    return page.browser.find_element(By.ID, field.get_attribute("aria-describedby")).text


def test_numbers_are_dragged_and_have_exponents(page):
    before = page.setting("component.0.brightness")
    page.drag(page.find("Brightness of gas"), 40, 0, wait=True)
    assert page.setting("component.0.brightness") == pytest.approx(before * 1.01**40, rel=0.05)
    assert page.find("Undo").get_attribute("title") == "Undo: gas brightness"
    page.find("Undo").click()
    assert page.setting("component.0.brightness") == before
    page.type_number("Range maximum of gas", "2.5e7", wait=True)
    assert page.setting("component.0.color.max") == 2.5e7
    assert page.find("Range maximum of gas").get_attribute("value") == "2.5e7"


def test_glasses_of_red_and_cyan_and_words_change_the_picture(page):
    pictures = {page.picture()}
    page.choose_value("Stereo", "anaglyph", wait=True)
    pictures.add(page.picture())
    page.find("Title").send_keys("Title", Keys.ENTER)
    page.wait_for_exact()
    pictures.add(page.picture())
    assert len(pictures) == 3
    page.choose_value("Stereo", "none")
    page.find("Title").clear()
    page.press("Caption")
    assert page.picture() in pictures


def test_a_sphere_that_clips_is_dragged_by_its_handles(page):
    page.unfold()
    before = page.picture()
    page.press("Clip gas to a sphere")
    assert page.picture() != before
    center, radius = (page.setting(f"component.0.select.sphere.{key}") for key in ("center", "radius"))
    middle, rim = page.browser.find_elements(By.CSS_SELECTOR, "#clips .grip")
    page.drag(rim, 30, 0, wait=True)
    assert page.setting("component.0.select.sphere.radius") < radius
    page.drag(middle, 20, 10, wait=True)
    assert page.setting("component.0.select.sphere.center") != center
    page.press("Clip gas to a sphere")
    assert page.picture() == before


def test_a_box_that_clips_has_two_corners(page):
    page.unfold()
    before = page.picture()
    page.press("Clip gas to a box")
    assert page.picture() != before
    low, high = (page.setting(f"component.0.select.box.{end}") for end in ("min", "max"))
    page.type_number("Highest x of the box of gas", (low[0] + high[0]) / 2, wait=True)
    assert page.setting("component.0.select.box.max") == [(low[0] + high[0]) / 2, *high[1:]]
    page.press("Clip gas to a box")
    assert page.picture() == before


def test_a_look_sets_light_and_palettes(page):
    before = page.picture()
    page.choose("Look", "paper")
    page.wait_for("app.store.past.length === 1")
    page.wait_for_exact()
    assert page.setting("image.background") == [1, 1, 1]
    assert page.picture() != before
    page.press("Undo")
    assert page.picture() == before


def test_states_are_kept_compared_and_linked_to(page):
    start = page.picture()
    page.find("Keep this view").click()
    page.find("Compare with another state").click()
    page.choose("Palette of gas", "viridis", wait=True)
    changed = page.picture()
    page.press("Compare with another state")
    assert page.picture() == start
    page.press("Compare with another state")
    assert page.picture() == changed
    page.find("Link to this state").click()
    address = page.script("location.href")
    page.press("Open kept view 1")
    assert page.picture() == start
    page.browser.get("about:blank")
    page.browser.get(address)
    page.wait_for_exact()
    assert page.picture() == changed


def test_the_probe_tells_what_is_under_the_pointer(page):
    page.find("Probe what is under the pointer").click()
    told = WebDriverWait(page.browser, PATIENCE).until(
        lambda browser: browser.find_element(By.ID, "probed").text)
    assert "away" in told and "gas: mean internal_energy" in told


def test_another_field_gets_a_range_of_its_own(page):
    page.choose("Color field of gas", "density", wait=True)
    assert page.setting("component.0.color.min") < page.setting("component.0.color.max")
    assert page.find("Range minimum of gas").get_attribute("value") != ""


def test_the_saved_scene_renders_to_the_bits_on_the_page(page, run, tmp_path):
    page.find("Orbit up").click()
    page.choose("Palette of gas", "magma", wait=True)
    (tmp_path / "page.png").write_bytes(page.picture())
    page.find("Save scene").click()
    WebDriverWait(page.browser, PATIENCE).until(
        lambda _: "magma" in page.find("Changes of the scene").text)
    page.keep_screenshot("save")
    page.find("Save file").click()
    saved = tmp_path / page.script("app.store.opened.scene_file")
    WebDriverWait(page.browser, PATIENCE).until(lambda _: saved.exists())
    page.find("Close").click()
    run("render", saved, "-o", tmp_path / "rendered.png")
    told = run("compare", tmp_path / "page.png", tmp_path / "rendered.png", "--limit", 0, "--json")
    assert json.loads(told)["pixels_beyond"] == 0


def test_a_reload_keeps_what_was_set(page):
    page.press("Orbit left")
    kept, picture = page.setting("camera.position"), page.picture()
    page.browser.refresh()
    page.wait_for_exact()
    assert page.setting("camera.position") == kept
    assert page.picture() == picture


def test_a_lost_connection_comes_back(page):
    page.browser.execute_script("app.link.socket.close()")
    page.find("Orbit left").click()
    page.wait_for("app.link.isOpen")
    page.wait_for_exact()


def test_scene_and_picture_can_be_downloaded(page, run, snapshot, tmp_path):
    page.browser.execute_cdp_cmd("Browser.setDownloadBehavior",
                                 {"behavior": "allow", "downloadPath": str(tmp_path)})
    page.press("Orbit left")
    for button in ("Save scene", "Save picture"):
        page.find(button).click()
        page.find("Download").click()
        WebDriverWait(page.browser, PATIENCE).until(
            lambda _: "Downloading" in page.browser.find_element(By.ID, "save-answer").text)
        page.find("Close").click()
    scene, picture = tmp_path / "universe_view.toml", tmp_path / "universe_view.png"
    WebDriverWait(page.browser, PATIENCE).until(lambda _: scene.exists() and picture.exists())
    run("render", scene, "-o", tmp_path / "drawn.png", "--set", f'snapshot="{snapshot}"')
    run("compare", picture, tmp_path / "drawn.png", "--limit", 0)


def test_help_opens_with_a_question_mark(page):
    page.find("Picture").send_keys("?")
    assert page.find("Keys and pointer").is_displayed()
    page.find("Close help").click()


def test_it_is_dark_until_one_wants_it_light(page):
    def brightness():
        color = page.script("getComputedStyle(document.querySelector('header')).backgroundColor")
        return int(color.split("(")[1].split(",")[0])

    assert brightness() < 128
    page.keep_screenshot("dark")
    page.find("Light or dark page").click()
    assert brightness() > 128
    page.keep_screenshot("light")
    page.browser.refresh()
    page.wait_for_exact()
    assert brightness() > 128
    page.find("Light or dark page").click()


def test_controls_fold_away_and_come_back(page):
    page.find("Hide controls").click()
    assert not page.browser.find_element(By.ID, "side").is_displayed()
    page.find("Show controls").click()
    page.find("Field of view")
    page.find("Camera").click()
    assert "Field of view" not in [c.accessible_name for c in page.browser.find_elements(By.TAG_NAME, "input")
                                   if c.is_displayed()]


def test_a_page_without_the_token_shows_nothing(browser, view):
    opened = view()
    browser.get(f"http://127.0.0.1:{opened.port}/")
    assert "no token" in browser.find_element(By.TAG_NAME, "body").text


def test_ctrl_c_ends_the_program_with_the_page_open(browser, view):
    opened = view()
    Page(browser, opened)
    assert opened.end() == (0, "")
    browser.get("about:blank")
