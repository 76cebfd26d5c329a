"""Keyframes and films that are made in the page."""

import json
import subprocess
import time

import pytest

pytest.importorskip("selenium", reason="python3-selenium is missing; scripts/setup --browser installs it")
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from page import Page
from page_socket import PATIENCE


def test_keyframes_are_added_played_and_saved(page, tmp_path):
    page.find("Add keyframe").click()
    page.press("Orbit left")
    here = page.picture()
    page.find("Picture").send_keys("k")
    frame = page.find("Frame of keyframe 2")
    assert frame.get_attribute("value") == "50"
    page.find("Play the keyframes").click()
    page.wait_for("app.film.timer === null && app.film.frame === 50")
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
    page.choose("Suggested films", "Turn once")
    page.type_number("Frames per second", 2)
    page.type_number("Length of the film in seconds", 60)
    fourth = page.script("app.store.state.keyframes[3].frame")
    page.find(f"Keyframe 4 at {fourth / 2} s").click()
    page.find("Slow down at keyframe 4").click()
    page.drag(page.find(f"Keyframe 4 at {fourth / 2} s"), 20, 0)
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
    page.choose("Suggested films", "Turn once")
    page.type_number("Length of the film in seconds", 600)
    page.find("Draw the film").click()
    page.find("Draw film").click()
    page.wait_for("document.body.dataset.film === 'drawing'")
    page.find("Cancel drawing").click()
    page.wait_for("document.body.dataset.film === 'cancelled'")
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


def test_a_film_goes_through_the_time_of_a_series(browser, view, real_file, tmp_path):
    snapshots = [str(real_file(f"lcdm/fmt2_snapshot_{number:03d}")) for number in (4, 5, 6)]
    scene = tmp_path / "series.toml"
    scene.write_text(f"look = 'press'\n[time]\nsnapshots = {json.dumps(snapshots)}\n[image]\nsize = [160, 120]\n")
    page = Page(browser, view(scene))
    page.choose("Suggested films", "Through time")
    first, last = page.script("[0, app.film.lastFrame]")
    pictures = []
    for frame in (first, last):
        page.script(f"app.film.goTo({frame})")
        page.wait_for_exact()
        pictures.append(page.picture())
    assert pictures[0] != pictures[1]
    assert page.find("Time index").get_attribute("value") == "2"
    browser.get("about:blank")
