"""What moves the camera of the page: buttons, keys, pointer, wheel and fingers."""

import math
import time

import pytest

np = pytest.importorskip("numpy")
pytest.importorskip("selenium", reason="python3-selenium is missing; scripts/setup --browser installs it")
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from page import Page
from page_socket import PATIENCE


def test_orbiting_turns_the_camera_at_the_same_distance(page):
    before, target = page.setting("camera.position"), page.setting("camera.look_at")
    picture = page.picture()
    page.press("Orbit left")
    after = page.setting("camera.position")
    assert after != before and page.setting("camera.look_at") == target

    def distance(place):
        return sum((a - b) ** 2 for a, b in zip(place, target)) ** 0.5

    assert distance(after) == pytest.approx(distance(before))
    assert page.picture() != picture


def test_the_field_of_view_is_that_of_the_projection_until_the_first_comes_back(page):
    def shown_after(projection):
        page.choose_value("Projection", projection)
        page.wait_for_exact()
        return float(page.find("Field of view").get_attribute("value"))

    suggested = page.setting("camera.field_of_view")
    assert shown_after("fisheye") == 180
    assert shown_after("perspective") == suggested


def test_a_drag_orbits_and_is_one_step_of_undo(page):
    before = page.setting("camera.position")
    page.drag(page.find("Picture"), 80, 30, wait=True)
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


def test_two_hundred_moves_end_with_the_last_one_drawn(page):
    page.browser.execute_script(
        "for (let i = 0; i < 200; ++i) setTimeout(() => app.gestures.move('orbit', 0.1, 0), 5 * i);")
    time.sleep(1.5)
    page.wait_for_exact()
    assert page.last_state > 10


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
    page.type_number("Width in pixels", 200, wait=True)
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
    page.press("Undo")
    assert distance() == pytest.approx(before)
