"""Who gets an answer from the server, and what it does with what it cannot understand: without a
browser, by the same requests that one sends."""

import http.client
import json
import resource
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from page_socket import PATIENCE, PageSocket


def get(view, path, **headers):
    connection = http.client.HTTPConnection("127.0.0.1", view.port, timeout=PATIENCE)
    connection.request("GET", path, headers=headers)
    answer = connection.getresponse()
    return answer.status, answer.read().decode(errors="replace"), dict(answer.getheaders())


def is_exact(number):
    return lambda message: message.get("stage") == "exact" and message["state"] == number


def is_exact_of_opened(message):
    return is_exact(0)(message)


def test_the_address_is_one_line_with_a_token_on_this_machine_only(view):
    assert view().address.startswith("http://127.0.0.1:")
    assert len(view().token) == 32


def test_an_address_of_another_machine_is_refused(program, snapshot):
    words = [program, "view", str(snapshot), "--bind", "192.0.2.1", "--port", "0"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert done.returncode == 2
    assert "--bind: found 192.0.2.1, expected an address of this machine" in done.stderr


def test_the_page_is_for_those_who_know_the_token(view):
    opened = view()
    status, text, headers = get(opened, f"/{opened.token}/")
    assert status == 200 and "<!doctype html>" in text
    assert "default-src 'none'" in headers["Content-Security-Policy"]
    assert get(opened, f"/{opened.token}/app.js")[0] == 200
    assert get(opened, f"/{opened.token}/nothing")[0] == 404
    for path in ("/", "/app.js", f"/{'0' * 32}/", f"/{opened.token}"):
        status, text, _ = get(opened, path)
        assert status == 403 and opened.token not in text, path


def test_other_hosts_and_origins_are_refused(view):
    opened = view()
    page = f"/{opened.token}/"
    assert get(opened, page, Host="evil.example")[0] == 403
    assert get(opened, page, Origin="http://evil.example")[0] == 403
    # The port may be another: that of a forwarded one.
    assert get(opened, page, Host="localhost:9")[0] == 200
    assert PageSocket(opened).status == 101
    assert PageSocket(opened, token="0" * 32).status == 403
    assert PageSocket(opened, origin="http://evil.example").status == 403
    assert PageSocket(opened, origin="").status == 403
    assert PageSocket(opened, host="evil.example").status == 403


def test_only_the_page_that_may_shows_this_one_in_a_frame(view, snapshot):
    notebook = "http://localhost:8888"
    for opened, ancestors in ((view(), "'none'"), (view(snapshot, "--frame-in", notebook), notebook)):
        headers = get(opened, f"/{opened.token}/")[2]
        assert headers["Content-Security-Policy"].endswith(f"frame-ancestors {ancestors}")
        is_known = ancestors == notebook
        assert PageSocket(opened, origin=notebook).status == (101 if is_known else 403)


def test_requests_that_are_none_do_not_end_the_server(view):
    opened = view()
    for request in (b"\0\1\2\r\n\r\n", b"GET " + b"x" * 100000, b"POST / HTTP/1.1\r\n\r\n",
                    b"GET / HTTP/1.1\r\nContent-Length: 9999999999\r\n\r\n"):
        with socket.create_connection(("127.0.0.1", opened.port), timeout=PATIENCE) as connection:
            connection.sendall(request)
    assert get(opened, f"/{opened.token}/")[0] == 200


def is_asleep(process):
    """Whether the first thread, which serves, waits for something."""
    status = Path(f"/proc/{process}/task/{process}/stat").read_text()
    return status.rsplit(")", 1)[1].split()[0] == "S"


@pytest.mark.skipif(sys.platform != "linux", reason="needs prlimit and /proc")
def test_a_server_without_files_for_connections_waits_until_it_has_some(view):
    opened = view()
    most = resource.prlimit(opened.process.pid, resource.RLIMIT_NOFILE)
    resource.prlimit(opened.process.pid, resource.RLIMIT_NOFILE, (3, most[1]))
    with socket.create_connection(("127.0.0.1", opened.port), timeout=PATIENCE):
        looks = []
        for _ in range(20):
            time.sleep(0.02)
            looks.append(is_asleep(opened.process.pid))
        assert any(looks)
    resource.prlimit(opened.process.pid, resource.RLIMIT_NOFILE, most)
    assert get(opened, f"/{opened.token}/")[0] == 200


@pytest.mark.parametrize("message", ["", "x", '{"type":"state"}', "[" * 20000,
                                     '{"type":"histogram","id":1,"component":99}'],
                         ids=["empty", "text", "half", "deep", "component"])
def test_messages_that_are_none_are_answered_with_an_error(view, message):
    page = PageSocket(view())
    page.send(message)
    answers = page.receive_until(lambda m: m["type"] == "error" or "error" in m)
    assert answers
    page.set(5)
    page.receive_until(is_exact(5))


def test_a_huge_message_ends_its_own_page_only(view):
    opened = view()
    page, other = PageSocket(opened), PageSocket(opened)
    page.send("x" * 400000)
    with pytest.raises(ConnectionError):
        while True:
            page.receive()
    other.receive_until(is_exact_of_opened)


def test_a_state_that_cannot_be_drawn_leaves_the_page_as_it_is(view):
    page = PageSocket(view())
    page.set(1, **{"camera__field_of_view": 500})
    answers = page.receive_until(lambda m: m["type"] == "error")
    assert answers[-1]["state"] == 1 and "field_of_view" in answers[-1]["text"]
    page.set(2, **{"camera__field_of_view": 50})
    page.receive_until(is_exact(2))


def test_faces_of_a_cube_are_drawn_in_place_of_the_field_of_view_that_was_suggested(view):
    page = PageSocket(view())
    page.set(1, camera__projection="cube", image__size=[64, 64])
    assert page.receive_until(is_exact(1))[-1]["file"]


def test_two_hundred_states_leave_no_backlog_and_the_last_is_drawn(view):
    page = PageSocket(view())
    page.receive_until(is_exact_of_opened)
    for number in range(1, 201):
        page.set(number, moving=number < 200, **{"camera__field_of_view": 30 + 0.1 * number})
    frames = page.receive_until(is_exact(200))
    assert len(frames) < 60
    assert [frame["state"] for frame in frames] == sorted(frame["state"] for frame in frames)


def test_frames_wait_for_a_page_that_does_not_acknowledge(view):
    page = PageSocket(view())

    def next_frame(number):
        page.set(number, moving=True, **{"camera__field_of_view": 30 + number})
        while page.receive()["type"] != "frame":
            pass

    for number in (1, 2):
        next_frame(number)
    page.connection.settimeout(3)
    with pytest.raises(TimeoutError):
        next_frame(3)


def test_two_pages_have_states_of_their_own(view):
    opened = view()
    first, second = PageSocket(opened), PageSocket(opened)
    first.set(1, component__0__palette="magma")
    second.set(1, component__0__palette="ice")
    pictures = [page.receive_until(is_exact(1))[-1]["file"] for page in (first, second)]
    assert pictures[0] != pictures[1]


@pytest.mark.parametrize("settings", [
    {"camera__field_of_view": 33.3, "finish__exposure": None},
    {"stereo__layout": "side_by_side", "stereo__angle": 2.5, "image__size": [100, 80]},
    {"camera__projection": "cube", "image__size": [90, 90]},
])
def test_the_saved_scene_renders_to_the_bits_of_the_exact_picture(view, run, tmp_path, settings):
    page = PageSocket(view())
    page.set(1, component__0__palette="magma", component__0__brightness=3.7, **settings)
    exact = page.receive_until(is_exact(1))[-1]
    (tmp_path / "page.png").write_bytes(exact["file"])
    page.send({"type": "save_scene", "id": 1, "path": "saved.toml", "replace": False})
    page.send({"type": "save_picture", "id": 2, "path": "saved.png", "replace": False})
    answers = page.receive_until(lambda m: m.get("id") == 2)
    assert all(answer["saved"] for answer in answers if answer["type"] == "answer")
    run("render", tmp_path / "saved.toml", "-o", tmp_path / "rendered.png")
    rendered = (tmp_path / "rendered.png").read_bytes()
    assert rendered == exact["file"]
    assert rendered == (tmp_path / "saved.png").read_bytes()


def test_a_frame_of_the_keyframes_has_the_bits_of_the_film(view, run, tmp_path):
    page = PageSocket(view())
    keyframes = [{"frame": frame, "settings": {"camera.field_of_view": angle}}
                 for frame, angle in ((0, 25), (10, 40))]
    state = {"type": "state", "moving": False, "settings": {"finish.exposure": -2, "finish.white": 1},
             "hidden": [], "keyframes": keyframes}
    page.send({**state, "number": 1, "frame": 4})
    exact = page.receive_until(is_exact(1))[-1]
    page.send({**state, "number": 2})
    page.send({"type": "save_scene", "id": 1, "path": "film.toml", "replace": False})
    page.receive_until(lambda m: m["type"] == "answer")
    run("movie", tmp_path / "film.toml", "-o", tmp_path / "frame_%04d.png", "--frames", "4:5")
    assert (tmp_path / "frame_0004.png").read_bytes() == exact["file"]


def test_a_film_is_drawn_beside_the_pages_and_fetched_with_the_token(view, run, tmp_path):
    opened = view()
    page = PageSocket(opened)
    keyframes = [{"frame": frame, "settings": {"camera.field_of_view": angle}} for frame, angle in ((0, 25), (5, 40))]
    page.send({"type": "state", "number": 1, "moving": False, "settings": {}, "hidden": [], "keyframes": keyframes})
    page.receive_until(is_exact(1))
    page.send({"type": "make_film", "id": 1, "path": "film.png", "replace": False})
    assert "expected .mp4" in page.receive_until(lambda m: m.get("id") == 1)[-1]["error"]
    page.send({"type": "make_film", "id": 2, "path": "film.mp4", "replace": False})
    told = page.receive_until(lambda m: m.get("state") in ("complete", "failed"))
    assert told[-1]["state"] == "complete" and told[-1]["frames"] == 6
    run("movie", tmp_path / "film.toml", "-o", tmp_path / "again.mp4")
    assert (tmp_path / "film.mp4").read_bytes() == (tmp_path / "again.mp4").read_bytes()
    number = told[-1]["number"]
    assert get(opened, f"/{opened.token}/film/{number}")[0] == 200
    assert get(opened, f"/{opened.token}/film/{number + 1}")[0] == 404
    assert get(opened, f"/{'0' * 32}/film/{number}")[0] == 403
    # What is there is replaced only when that is said.
    page.send({"type": "make_film", "id": 3, "path": "film.mp4", "replace": False})
    assert page.receive_until(lambda m: m.get("id") == 3)[-1]["saved"] is False


def test_ctrl_c_and_sigterm_end_it_while_it_draws_a_film(view, tmp_path):
    for ending in (signal.SIGINT, signal.SIGTERM):
        opened = view()
        page = PageSocket(opened)
        keyframes = [{"frame": frame, "settings": {"camera.field_of_view": angle}}
                     for frame, angle in ((0, 25), (9000, 40))]
        page.send({"type": "state", "number": 1, "moving": False, "settings": {}, "hidden": [], "keyframes": keyframes})
        page.send({"type": "make_film", "id": 1, "path": "long.mp4", "replace": True})
        page.receive_until(lambda m: m.get("state") == "drawing" and m["done"] > 0)
        page.send({"type": "make_film", "id": 2, "path": "other.mp4", "replace": False})
        assert "another film" in page.receive_until(lambda m: m.get("id") == 2)[-1]["error"]
        opened.process.send_signal(ending)
        opened.process.communicate(timeout=20)
        assert opened.process.returncode == 0
        assert not (tmp_path / "long.mp4").exists() and not (tmp_path / "other.toml").exists()


def test_a_component_for_other_particles_is_added_and_taken_away(view, run, real_file, tmp_path):
    page = PageSocket(view(real_file("lcdm/fmt2_snapshot_006"), "--size", "80x60"))
    before = page.receive_until(is_exact_of_opened)[-1]["file"]
    page.send({"type": "component", "id": 1, "particles": "halo"})
    halo = page.receive_until(lambda m: m.get("id") == 1)[-1]["component"]
    assert halo["name"] == "halo" and halo["settings"]["palette"]
    page.send({"type": "state", "number": 1, "moving": False, "settings": {}, "hidden": [], "added": ["halo"]})
    added = page.receive_until(is_exact(1))[-1]["file"]
    assert added != before
    (tmp_path / "page.png").write_bytes(added)
    page.send({"type": "save_scene", "id": 2, "path": "saved.toml", "replace": False})
    page.receive_until(lambda m: m.get("id") == 2)
    run("render", tmp_path / "saved.toml", "-o", tmp_path / "rendered.png")
    run("compare", tmp_path / "page.png", tmp_path / "rendered.png", "--limit", 0)
    page.send({"type": "state", "number": 2, "moving": False, "settings": {}, "added": ["halo"],
               "hidden": [1]})
    assert page.receive_until(is_exact(2))[-1]["file"] == before


def test_a_moment_between_two_snapshots_has_the_bits_of_render(view, run, real_file, tmp_path):
    snapshots = [str(real_file(f"lcdm/fmt2_snapshot_{number:03d}")) for number in (4, 5, 6)]
    scene = tmp_path / "series.toml"
    scene.write_text(f"[time]\nsnapshots = {json.dumps(snapshots)}\n"
                     "[image]\nsize = [160, 120]\n[[component]]\nname = 'gas'\n"
                     "color.field = 'internal_energy'\ncolor.scaling = 'log'\n")
    page = PageSocket(view(scene))
    assert page.receive()["times"] == [0, 2]
    page.set(1, time__index=1.25)
    moved = page.receive_until(is_exact(1))[-1]["file"]
    page.send({"type": "save_scene", "id": 1, "path": "moment.toml", "replace": False})
    assert page.receive_until(lambda m: m["type"] == "answer")[-1]["saved"]
    run("render", tmp_path / "moment.toml", "-o", tmp_path / "moment.png")
    assert (tmp_path / "moment.png").read_bytes() == moved
    page.set(2, time__index=3)
    assert "time.index" in page.receive_until(lambda m: m["type"] == "error")[-1]["text"]


def test_files_are_replaced_only_when_that_is_said(view, snapshot, tmp_path):
    page = PageSocket(view())
    kept = tmp_path / "kept.toml"
    kept.write_text("mine")

    def save(path, replace, kind="save_scene"):
        page.send({"type": kind, "id": 1, "path": str(path), "replace": replace})
        return page.receive_until(lambda m: m["type"] == "answer")[-1]

    assert save("kept.toml", False)["saved"] is False
    assert kept.read_text() == "mine"
    assert save("kept.toml", True)["saved"] is True
    assert "[camera]" in kept.read_text()
    assert "error" in save("scene.txt", False)
    assert "error" in save("nowhere/scene.toml", False)
    assert "filesystem" not in save("x" * 300 + ".toml", False)["error"]
    linked = tmp_path / "snapshot.png"
    linked.symlink_to(snapshot)
    before = snapshot.read_bytes()
    assert "error" in save(linked, True, "save_picture")
    assert snapshot.read_bytes() == before


def test_open_ranges_are_found_and_told(view):
    page = PageSocket(view())
    page.set(1, **{"component__0__color__field": "density", "component__0__color__min": None,
                   "component__0__color__max": None})
    decided = page.receive_until(is_exact(1))[-1]["decided"]
    assert decided["component.0.color.min"] < decided["component.0.color.max"]


def test_components_that_are_off_are_not_drawn(view):
    page = PageSocket(view())
    page.receive_until(is_exact_of_opened)
    page.send({"type": "state", "number": 1, "moving": False, "settings": {}, "hidden": [0]})
    without_gas = page.receive_until(is_exact(1))[-1]["file"]
    page.send({"type": "state", "number": 2, "moving": False, "settings": {}, "hidden": []})
    assert page.receive_until(is_exact(2))[-1]["file"] != without_gas
    page.send({"type": "state", "number": 3, "moving": False, "settings": {}, "hidden": [0, 1]})
    assert "off" in page.receive_until(lambda m: m["type"] == "error")[-1]["text"]


def test_ctrl_c_ends_it_with_a_page_open(view):
    opened = view()
    page = PageSocket(opened)
    page.receive()
    assert opened.end() == (0, "")


def test_ctrl_c_again_and_again_is_no_other_end(view):
    opened = view()
    PageSocket(opened).receive()
    deadline = time.monotonic() + PATIENCE
    while opened.process.poll() is None and time.monotonic() < deadline:
        opened.process.send_signal(signal.SIGINT)
        time.sleep(0.001)
    assert opened.process.returncode == 0


def test_a_page_makes_the_program_read_no_file_through_a_keyframe(view):
    opened = view()
    secret = opened.folder / "secret"
    secret.write_text("password=hunter2\n")
    page = PageSocket(opened)
    keyframes = [{"frame": 0, "settings": {"component.0.palette": "magma"}},
                 {"frame": 2, "settings": {"component.0.palette": str(secret)}}]
    page.send({"type": "state", "number": 1, "moving": False, "settings": {}, "hidden": [],
               "keyframes": keyframes, "frame": 2})
    text = page.receive_until(lambda message: message.get("type") == "error")[-1]["text"]
    assert "expected the scene's own" in text and "hunter2" not in text


def test_what_a_component_reads_that_is_off_is_not_replaced(view, snapshot, tmp_path):
    numbers = tmp_path / "ids.toml"
    numbers.write_text("\n".join(map(str, range(1, 2000))))
    before = numbers.read_text()
    scene = tmp_path / "scene.toml"
    scene.write_text(f"""
snapshot = "{snapshot}"
[image]
size = [64, 48]
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[[component]]
types = "gas"
[[component]]
types = "gas"
select = {{ ids = "ids.toml" }}
""")
    page = PageSocket(view(scene))
    page.send({"type": "state", "number": 1, "moving": False, "settings": {}, "hidden": [1]})
    for kind, path in (("save_scene", numbers), ("save_scene", snapshot), ("save_picture", snapshot)):
        page.send({"type": kind, "id": 1, "path": str(path), "replace": True})
        answer = page.receive_until(lambda message: message.get("type") == "answer")[-1]
        assert "error" in answer, path
    assert numbers.read_text() == before


def test_connections_without_the_token_lock_nobody_out(view):
    opened = view()
    strangers = []
    for _ in range(100):
        strangers.append(socket.create_connection(("127.0.0.1", opened.port), timeout=PATIENCE))
    assert get(opened, f"/{opened.token}/")[0] == 200
    for _ in range(100):
        strangers.append(socket.create_connection(("127.0.0.1", opened.port), timeout=PATIENCE))
        strangers[-1].sendall(b"GET /x/ HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
    assert get(opened, f"/{opened.token}/")[0] == 200
    assert PageSocket(opened).status == 101
    # All are closed, whether they ask for anything or not.
    for stranger in strangers:
        try:
            while stranger.recv(4096):
                pass
        except ConnectionResetError:
            pass
        stranger.close()


def test_ctrl_c_ends_a_picture_that_is_drawn_in_one_part(view, run, tmp_path):
    universe = tmp_path / "universe"
    run("generate", "universe", "--particles", 300000, "-o", universe)
    for ending in (signal.SIGINT, signal.SIGTERM):
        opened = view(universe, "--size", "1024x1024")
        page = PageSocket(opened)
        page.receive_until(lambda message: message.get("stage") == "preview")
        page.set(1, tolerance=0, component__0__absorption=2, component__0__size__factor=5)
        time.sleep(2)
        opened.process.send_signal(ending)
        # It would draw for a minute.
        opened.process.communicate(timeout=20)
        assert opened.process.returncode == 0
