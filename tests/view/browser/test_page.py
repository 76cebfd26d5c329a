"""The page in a real browser. Controls are found by the names that a screen reader says."""

import base64
import json
import math
import os
import subprocess
import time
from pathlib import Path

import pytest

np = pytest.importorskip("numpy")
pytest.importorskip("selenium", reason="python3-selenium is missing; scripts/setup --browser installs it")
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
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
        WebDriverWait(self.browser, PATIENCE, 0.05).until(lambda _: self.script(newest))

    def picture(self):
        """The pixels on the canvas, as a PNG file."""
        url = self.script("document.getElementById('picture').toDataURL('image/png')")
        return base64.b64decode(url.split(",")[1])

    def type_number(self, name, value):
        control = self.find(name)
        control.send_keys(Keys.CONTROL, "a")
        control.send_keys(str(value), Keys.ENTER)

    def keep_screenshot(self, name):
        folder = os.environ.get("SPLOTCHCL_SCREENSHOTS")
        if folder:
            Path(folder).mkdir(parents=True, exist_ok=True)
            self.browser.save_screenshot(str(Path(folder) / f"{name}.png"))

    def errors(self):
        return [entry for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]


@pytest.fixture
def page(browser, view):
    made = Page(browser, view())
    made.errors()
    yield made
    assert made.errors() == []
    browser.get("about:blank")


def test_orbit_palette_range_and_save_are_found_by_their_names(page):
    for name in ("Picture", "Orbit left", "Orbit right", "Orbit up", "Orbit down", "Pan left",
                 "Move closer", "Move away", "Field of view", "Palette of gas", "Range minimum of gas",
                 "Range maximum of gas", "Range minimum slider of gas", "Brightness of gas",
                 "Show gas", "Exposure", "Tone", "Undo", "Redo", "Save scene", "Save picture", "Help"):
        page.find(name)


def test_every_control_has_a_name(page):
    page.browser.execute_script("for (const part of document.querySelectorAll('details')) part.open = true;")
    controls = page.browser.find_elements(By.CSS_SELECTOR, "button, input, select, [tabindex]")
    assert len(controls) > 30
    assert [c.get_attribute("outerHTML") for c in controls
            if c.is_displayed() and not c.accessible_name] == []


def test_orbiting_turns_the_camera_at_the_same_distance(page):
    before, target = page.setting("camera.position"), page.setting("camera.look_at")
    picture = page.picture()
    page.find("Orbit left").click()
    page.wait_for_exact()
    after = page.setting("camera.position")
    assert after != before and page.setting("camera.look_at") == target

    def distance(place):
        return sum((a - b) ** 2 for a, b in zip(place, target)) ** 0.5

    assert distance(after) == pytest.approx(distance(before))
    assert page.picture() != picture


def test_the_field_of_view_is_that_of_the_projection_until_the_first_comes_back(page):
    def shown_after(projection):
        Select(page.find("Projection")).select_by_value(projection)
        page.wait_for_exact()
        return float(page.find("Field of view").get_attribute("value"))

    suggested = page.setting("camera.field_of_view")
    assert shown_after("fisheye") == 180
    assert shown_after("perspective") == suggested


def test_a_drag_orbits_and_is_one_step_of_undo(page):
    before = page.setting("camera.position")
    ActionChains(page.browser).drag_and_drop_by_offset(page.find("Picture"), 80, 30).perform()
    page.wait_for_exact()
    assert page.setting("camera.position") != before
    page.find("Undo").click()
    assert page.setting("camera.position") == before
    page.find("Redo").click()
    assert page.setting("camera.position") != before


def test_keys_orbit_pan_and_move(page):
    view = page.find("Picture")
    before = page.setting("camera.position")
    view.send_keys(Keys.ARROW_RIGHT)
    orbited = page.setting("camera.position")
    assert orbited != before
    look_at = page.setting("camera.look_at")
    view.send_keys(Keys.SHIFT, Keys.ARROW_RIGHT)
    assert page.setting("camera.look_at") != look_at
    view.send_keys("h")
    assert page.setting("camera.position") == before
    view.send_keys("+")
    assert page.setting("camera.position") != before


def test_flying_moves_on_until_escape(page):
    before = page.setting("camera.look_at")
    page.find("Fly through the data").click()
    ActionChains(page.browser).key_down("w").perform()
    WebDriverWait(page.browser, PATIENCE, 0.05).until(
        lambda _: page.setting("camera.look_at") != before)
    ActionChains(page.browser).key_up("w").perform()
    page.find("Picture").send_keys(Keys.ESCAPE)
    page.wait_for_exact()


def test_a_double_click_takes_what_is_there_as_the_center(page):
    before = page.setting("camera.look_at")
    ActionChains(page.browser).double_click(page.find("Picture")).perform()
    WebDriverWait(page.browser, PATIENCE).until(lambda _: page.setting("camera.look_at") != before)
    page.wait_for_exact()


def test_palette_and_range_change_the_picture(page):
    pictures = [page.picture()]
    Select(page.find("Palette of gas")).select_by_visible_text("viridis")
    page.wait_for_exact()
    pictures.append(page.picture())
    middle = (page.setting("component.0.color.min") * page.setting("component.0.color.max")) ** 0.5
    page.type_number("Range minimum of gas", middle)
    page.wait_for_exact()
    pictures.append(page.picture())
    assert page.setting("component.0.color.min") == pytest.approx(middle, rel=1e-4)
    assert len(set(pictures)) == 3
    page.find("Adapt range of gas to the data").click()
    page.wait_for_exact()
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


def test_keyframes_are_added_played_and_saved(page, tmp_path):
    page.find("Add keyframe").click()
    page.find("Orbit left").click()
    page.wait_for_exact()
    here = page.picture()
    page.find("Picture").send_keys("k")
    frame = page.find("Frame of keyframe 2")
    assert frame.get_attribute("value") == "50"
    page.find("Play the keyframes").click()
    WebDriverWait(page.browser, PATIENCE).until(
        lambda _: page.script("app.film.timer === null && app.film.frame === 50"))
    page.wait_for_exact()
    assert page.picture() == here
    page.keep_screenshot("keyframes")
    page.find("Keyframe 1 at 0.0 s").click()
    page.find("Remove keyframe 1").click()
    page.find("Undo").click()
    page.find("Save scene").click()
    page.find("Save file").click()
    saved = tmp_path / page.script("app.store.opened.scene_file")
    WebDriverWait(page.browser, PATIENCE).until(lambda _: saved.exists())
    assert "keyframes" in saved.read_text()
    page.find("Close").click()


def test_a_minute_of_film_made_in_the_page_is_what_movie_draws(browser, view, run, tmp_path):
    run("generate", "universe", "--particles", 2000, "-o", tmp_path / "universe")
    page = Page(browser, view(tmp_path / "universe", "--size", "160x120"))
    browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path / "got")})
    Select(page.find("Suggested films")).select_by_visible_text("Turn once")
    page.type_number("Frames per second", 2)
    page.type_number("Length of the film in seconds", 60)
    fourth = page.script("app.store.state.keyframes[3].frame")
    page.find(f"Keyframe 4 at {fourth / 2} s").click()
    page.find("Slow down at keyframe 4").click()
    ActionChains(browser).drag_and_drop_by_offset(page.find(f"Keyframe 4 at {fourth / 2} s"), 20, 0).perform()
    assert page.script("app.store.state.keyframes[3].frame") > fourth
    page.type_number("Brightness of gas", 2)
    page.find("Add keyframe").click()
    page.script("app.film.goTo(60)")
    page.wait_for_exact()
    (tmp_path / "page.png").write_bytes(page.picture())
    page.keep_screenshot("film")
    page.find("Draw the film").click()
    page.find("Draw film").click()
    WebDriverWait(browser, 5 * PATIENCE).until(
        lambda _: page.script("document.body.dataset.film") in ("complete", "failed"))
    assert "Drawn" in page.browser.find_element(By.ID, "film-answer").text
    film, scene = tmp_path / "universe_view.mp4", tmp_path / "universe_view.toml"
    run("movie", scene, "-o", tmp_path / "again.mp4")
    assert film.read_bytes() == (tmp_path / "again.mp4").read_bytes()
    run("movie", scene, "-o", tmp_path / "frame_%04d.png", "--frames", "60:61")
    run("compare", tmp_path / "page.png", tmp_path / "frame_0060.png", "--limit", 0)
    assert seconds_of(film) == pytest.approx(page.script("app.film.frames") / 2)
    page.find("Download film").click()
    page.find("Download scene").click()
    got = [tmp_path / "got" / path.name for path in (film, scene)]
    WebDriverWait(browser, PATIENCE).until(lambda _: all(path.exists() for path in got))
    assert got[0].read_bytes() == film.read_bytes()
    page.find("Close film").click()
    assert page.errors() == []
    browser.get("about:blank")


def seconds_of(film):
    words = ["ffprobe", "-v", "error", "-show_entries", "format=duration", "-of", "csv=p=0", str(film)]
    return float(subprocess.run(words, capture_output=True, text=True, check=True).stdout)


def test_a_film_that_is_cancelled_leaves_nothing(page, tmp_path):
    Select(page.find("Suggested films")).select_by_visible_text("Turn once")
    page.type_number("Length of the film in seconds", 600)
    page.find("Draw the film").click()
    page.find("Draw film").click()
    WebDriverWait(page.browser, PATIENCE).until(lambda _: page.script("document.body.dataset.film === 'drawing'"))
    page.find("Cancel drawing").click()
    WebDriverWait(page.browser, PATIENCE).until(lambda _: page.script("document.body.dataset.film === 'cancelled'"))
    assert [path.name for path in tmp_path.iterdir()] == ["universe_view.toml"]
    page.find("Close film").click()


def test_what_changes_between_keyframes_moves_and_the_controls_tell_it(page):
    before = page.setting("component.0.brightness")
    page.find("Add keyframe").click()
    page.type_number("Brightness of gas", 4 * before)
    page.find("Add keyframe").click()
    assert page.script("app.store.state.keyframes.map(({settings}) => settings['component.0.brightness'])") == [
        before, 4 * before]
    page.script("app.film.goTo(25)")
    page.wait_for_exact()
    assert float(page.find("Brightness of gas").get_attribute("value")) == pytest.approx(2.5 * before, rel=0.01)
    # What is changed begins at what the film shows.
    page.find("Orbit left").click()
    assert page.setting("component.0.brightness") == pytest.approx(2.5 * before, rel=0.01)


def test_a_flight_is_recorded_as_few_keyframes(page):
    page.find("Record my flight").click()
    for _ in range(20):
        page.script("app.gestures.move('orbit', 0.3, 0)")
        time.sleep(0.05)
    page.find("End the recording").click()
    frames = page.script("app.store.state.keyframes.map(({frame}) => frame)")
    assert 2 <= len(frames) < 20 and frames[-1] > 20
    assert page.script("app.store.state.keyframes.at(-1).settings['camera.position']") == page.setting(
        "camera.position")
    page.find("Show the plan of the way").click()
    assert page.browser.find_element(By.ID, "plan").is_displayed()


def test_a_kind_of_particles_is_added_and_removed_again(page):
    before = page.picture()
    Select(page.find("Add a component")).select_by_value("gas")
    WebDriverWait(page.browser, PATIENCE).until(lambda _: page.script("app.components.length === 3"))
    page.wait_for_exact()
    assert page.picture() != before
    Select(page.find("Palette of gas 2")).select_by_visible_text("viridis")
    page.find("Remove the component gas 2").click()
    page.wait_for_exact()
    assert page.picture() == before


def test_what_no_scene_can_have_is_said_beside_the_field(page):
    field = page.find("Field of view")
    page.type_number("Field of view", "many")
    assert "expected a number" in problem_of(page, field)
    page.type_number("Field of view", 400)
    assert "found 400, expected a number from 0.001 to 360" in problem_of(page, field)
    page.browser.execute_script("for (const part of document.querySelectorAll('details')) part.open = true;")
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
    ActionChains(page.browser).drag_and_drop_by_offset(page.find("Brightness of gas"), 40, 0).perform()
    page.wait_for_exact()
    assert page.setting("component.0.brightness") == pytest.approx(before * 1.01**40, rel=0.05)
    assert page.find("Undo").get_attribute("title") == "Undo: gas brightness"
    page.find("Undo").click()
    assert page.setting("component.0.brightness") == before
    page.type_number("Range maximum of gas", "2.5e7")
    page.wait_for_exact()
    assert page.setting("component.0.color.max") == 2.5e7
    assert page.find("Range maximum of gas").get_attribute("value") == "2.5e7"


def test_glasses_of_red_and_cyan_and_words_change_the_picture(page):
    pictures = {page.picture()}
    Select(page.find("Stereo")).select_by_value("anaglyph")
    page.wait_for_exact()
    pictures.add(page.picture())
    page.find("Title").send_keys("Title", Keys.ENTER)
    page.wait_for_exact()
    pictures.add(page.picture())
    assert len(pictures) == 3
    Select(page.find("Stereo")).select_by_value("none")
    page.find("Title").clear()
    page.find("Caption").click()
    page.wait_for_exact()
    assert page.picture() in pictures


def test_a_sphere_that_clips_is_dragged_by_its_handles(page):
    page.browser.execute_script("for (const part of document.querySelectorAll('details')) part.open = true;")
    before = page.picture()
    page.find("Clip gas to a sphere").click()
    page.wait_for_exact()
    assert page.picture() != before
    center, radius = (page.setting(f"component.0.select.sphere.{key}") for key in ("center", "radius"))
    middle, rim = page.browser.find_elements(By.CSS_SELECTOR, "#clips .grip")
    ActionChains(page.browser).drag_and_drop_by_offset(rim, 30, 0).perform()
    page.wait_for_exact()
    assert page.setting("component.0.select.sphere.radius") < radius
    ActionChains(page.browser).drag_and_drop_by_offset(middle, 20, 10).perform()
    page.wait_for_exact()
    assert page.setting("component.0.select.sphere.center") != center
    page.find("Clip gas to a sphere").click()
    page.wait_for_exact()
    assert page.picture() == before


def test_a_box_that_clips_has_two_corners(page):
    page.browser.execute_script("for (const part of document.querySelectorAll('details')) part.open = true;")
    before = page.picture()
    page.find("Clip gas to a box").click()
    page.wait_for_exact()
    assert page.picture() != before
    low, high = (page.setting(f"component.0.select.box.{end}") for end in ("min", "max"))
    page.type_number("Highest x of the box of gas", (low[0] + high[0]) / 2)
    page.wait_for_exact()
    assert page.setting("component.0.select.box.max") == [(low[0] + high[0]) / 2, *high[1:]]
    page.find("Clip gas to a box").click()
    page.wait_for_exact()
    assert page.picture() == before


def test_a_look_sets_light_and_palettes(page):
    before = page.picture()
    Select(page.find("Look")).select_by_visible_text("paper")
    WebDriverWait(page.browser, PATIENCE).until(lambda _: page.script("app.store.past.length === 1"))
    page.wait_for_exact()
    assert page.setting("image.background") == [1, 1, 1]
    assert page.picture() != before
    page.find("Undo").click()
    page.wait_for_exact()
    assert page.picture() == before


def test_a_film_goes_through_the_time_of_a_series(browser, view, real_file, tmp_path):
    snapshots = [str(real_file(f"lcdm/fmt2_snapshot_{number:03d}")) for number in (4, 5, 6)]
    scene = tmp_path / "series.toml"
    scene.write_text(f"look = 'press'\n[time]\nsnapshots = {json.dumps(snapshots)}\n[image]\nsize = [160, 120]\n")
    page = Page(browser, view(scene))
    Select(page.find("Suggested films")).select_by_visible_text("Through time")
    first, last = page.script("[0, app.film.lastFrame]")
    pictures = []
    for frame in (first, last):
        page.script(f"app.film.goTo({frame})")
        page.wait_for_exact()
        pictures.append(page.picture())
    assert pictures[0] != pictures[1]
    assert page.find("Time index").get_attribute("value") == "2"
    browser.get("about:blank")


def test_states_are_kept_compared_and_linked_to(page):
    start = page.picture()
    page.find("Keep this view").click()
    page.find("Compare with another state").click()
    Select(page.find("Palette of gas")).select_by_visible_text("viridis")
    page.wait_for_exact()
    changed = page.picture()
    page.find("Compare with another state").click()
    page.wait_for_exact()
    assert page.picture() == start
    page.find("Compare with another state").click()
    page.wait_for_exact()
    assert page.picture() == changed
    page.find("Link to this state").click()
    address = page.script("location.href")
    page.find("Open kept view 1").click()
    page.wait_for_exact()
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
    Select(page.find("Color field of gas")).select_by_visible_text("density")
    page.wait_for_exact()
    assert page.setting("component.0.color.min") < page.setting("component.0.color.max")
    assert page.find("Range minimum of gas").get_attribute("value") != ""


def test_the_saved_scene_renders_to_the_bits_on_the_page(page, run, tmp_path):
    page.find("Orbit up").click()
    Select(page.find("Palette of gas")).select_by_visible_text("magma")
    page.wait_for_exact()
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
    page.find("Orbit left").click()
    page.wait_for_exact()
    kept, picture = page.setting("camera.position"), page.picture()
    page.browser.refresh()
    page.wait_for_exact()
    assert page.setting("camera.position") == kept
    assert page.picture() == picture


def test_a_lost_connection_comes_back(page):
    page.browser.execute_script("app.link.socket.close()")
    page.find("Orbit left").click()
    WebDriverWait(page.browser, PATIENCE).until(lambda _: page.script("app.link.isOpen"))
    page.wait_for_exact()


def test_two_hundred_moves_end_with_the_last_one_drawn(page):
    page.browser.execute_script(
        "for (let i = 0; i < 200; ++i) setTimeout(() => app.gestures.move('orbit', 0.1, 0), 5 * i);")
    time.sleep(1.5)
    page.wait_for_exact()
    assert page.last_state > 10


def test_scene_and_picture_can_be_downloaded(page, run, snapshot, tmp_path):
    page.browser.execute_cdp_cmd("Browser.setDownloadBehavior",
                                 {"behavior": "allow", "downloadPath": str(tmp_path)})
    page.find("Orbit left").click()
    page.wait_for_exact()
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


def test_a_snapshots_picture_fills_the_window_and_the_scene_keeps_it(browser, view, snapshot):
    page = Page(browser, view(snapshot))
    window = page.script("[innerWidth, innerHeight]")
    assert page.setting("image.size") == window
    assert page.script("[app.picture.canvas.width, app.picture.canvas.height]") == window
    # The shorter side shows what the suggested square did.
    shorter = math.tan(math.radians(page.setting("camera.field_of_view") / 2)) * min(window) / window[0]
    opened = math.tan(math.radians(page.script("app.store.opened.settings['camera.field_of_view']") / 2))
    assert shorter == pytest.approx(opened, rel=1e-5)
    assert not page.find("Undo").is_enabled()
    page.keep_screenshot("filled")
    page.type_number("Width in pixels", 200)
    page.wait_for_exact()
    assert page.setting("image.size") == [200, window[1]]
    assert not page.find("Fill the window").is_selected()
    browser.get("about:blank")


def under(page, x, y):
    """The point under a place of the picture, 0 to 1 each way, as far away as the look-at point."""
    position, target, sky = (np.array(page.setting(f"camera.{key}"), float)
                             for key in ("position", "look_at", "sky"))
    distance = np.linalg.norm(target - position)
    forward = (target - position) / distance
    right = np.cross(forward, sky) / np.linalg.norm(np.cross(forward, sky))
    width, height = page.setting("image.size")
    side = 2 * distance * math.tan(math.radians(page.setting("camera.field_of_view") / 2))
    return target + right * (x - 0.5) * side + np.cross(right, forward) * (0.5 - y) * side * height / width


def test_the_wheel_moves_towards_what_is_under_the_pointer(page):
    x, y = 0.7, 0.3
    before, distance = under(page, x, y), page.script("app.gestures.camera.position[2]")
    page.script(f"""(() => {{
        const {{canvas}} = app.picture, box = canvas.getBoundingClientRect();
        const width = app.picture.shownWidth, height = width * canvas.height / canvas.width;
        document.getElementById('view').dispatchEvent(new WheelEvent('wheel', {{
            deltaY: -240, bubbles: true, cancelable: true,
            clientX: box.left + (box.width - width) / 2 + {x} * width,
            clientY: box.top + (box.height - height) / 2 + {y} * height}})); }})()""")
    page.wait_for_exact()
    assert page.script("app.gestures.camera.position[2]") != distance
    side = np.linalg.norm(under(page, 1, 0.5) - under(page, 0, 0.5))
    assert np.linalg.norm(under(page, x, y) - before) < 1e-3 * side


def test_two_fingers_move_closer(page):
    def distance():
        return np.linalg.norm(np.subtract(page.setting("camera.position"), page.setting("camera.look_at")))

    def touch(kind, *places):
        points = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)]
        page.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    before = distance()
    touch("touchStart", (400, 300), (440, 300))
    for step in range(1, 6):
        touch("touchMove", (400 - 10 * step, 300), (440 + 10 * step, 300))
    touch("touchEnd")
    page.wait_for_exact()
    # From 40 to 140 pixels apart.
    assert distance() == pytest.approx(before * 40 / 140, rel=0.02)
    page.find("Undo").click()
    page.wait_for_exact()
    assert distance() == pytest.approx(before)


def test_a_page_without_the_token_shows_nothing(browser, view):
    opened = view()
    browser.get(f"http://127.0.0.1:{opened.port}/")
    assert "no token" in browser.find_element(By.TAG_NAME, "body").text


def test_ctrl_c_ends_the_program_with_the_page_open(browser, view):
    opened = view()
    Page(browser, opened)
    assert opened.end() == (0, "")
    browser.get("about:blank")
