"""Python's lock is free while something is drawn; threads, forks and interruptions end well."""

import multiprocessing
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import splotchcl
from conftest import make_arrays, run_python
from splotchcl import DeviceError, Particles, UsageError

SIZE = (64, 64)


def test_two_renderers_in_two_threads_draw_what_one_draws(renderer, particles):
    scene = splotchcl.suggest(particles, size=SIZE)
    expected = renderer.render(scene, particles).linear

    def draw(_):
        own = Particles().gas(**make_arrays(500))
        return splotchcl.Renderer().render(scene, own).linear

    with ThreadPoolExecutor(2) as pool:
        pictures = list(pool.map(draw, range(4)))
    assert all(np.array_equal(picture, expected) for picture in pictures)


def test_threads_take_turns_at_one_renderer_and_its_particles(renderer, particles):
    scene = splotchcl.suggest(particles, size=SIZE)
    expected = renderer.render(scene, particles).linear
    with ThreadPoolExecutor(4) as pool:
        pictures = list(pool.map(lambda _: renderer.render(scene, particles).linear, range(8)))
    assert all(np.array_equal(picture, expected) for picture in pictures)


def test_arrays_may_be_set_by_another_thread_while_they_are_drawn(renderer, particles):
    scene = splotchcl.suggest(particles, size=SIZE)
    expected = renderer.render(scene, particles).linear
    with ThreadPoolExecutor(2) as pool:
        pictures = [pool.submit(lambda: renderer.render(scene, particles).linear) for _ in range(5)]
        for _ in range(20):
            particles.gas(**make_arrays(500))  # the same numbers elsewhere
    assert all(np.array_equal(picture.result(), expected) for picture in pictures)


def test_python_goes_on_while_a_picture_is_drawn():
    """A thread that counts gets on while the reference draws for a while."""
    particles = Particles().gas(**make_arrays(3000))
    counted = []
    drawing = threading.Event()
    done = threading.Event()

    def count():
        drawing.wait(60)
        while not done.is_set():
            counted.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    scene = splotchcl.suggest(particles, size=(200, 200))
    drawing.set()
    splotchcl.reference(scene, particles)
    done.set()
    thread.join()
    assert len(counted) > 5


def test_progress_is_told(particles):
    told = []
    splotchcl.reference(
        particles, size=(32, 32), progress=lambda what, fraction: told.append((what, fraction))
    )
    fractions = [fraction for what, fraction in told if "reference" in what]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1


def test_what_progress_raises_ends_the_work(particles):
    def stop(what, fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        splotchcl.reference(particles, size=(32, 32), progress=stop)


def test_a_renderer_draws_again_after_progress_raised(particles):
    renderer = splotchcl.Renderer("reference")

    def stop(what, fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError):
        renderer.render(particles, size=(32, 32), progress=stop)
    assert renderer.render(particles, size=(32, 32)).linear.any()


def test_progress_must_not_draw_the_same_particles(particles):
    def draw(what, fraction):
        splotchcl.reference(particles, size=(8, 8))

    with pytest.raises(UsageError, match="progress"):
        splotchcl.reference(particles, size=(32, 32), progress=draw)


INTERRUPTED = """
import os, signal, threading
import numpy as np, splotchcl
signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs behind a shell ignores it
random = np.random.default_rng(1)
particles = splotchcl.Particles().gas(
    position=random.random((COUNT, 3), np.float32), mass=1.0,
    smoothing_length=np.full(COUNT, SIZE, np.float32))
began = threading.Event()
def interrupt():
    began.wait()
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt, daemon=True).start()
scene = splotchcl.suggest(particles, size=(1000, 1000))
scene["component.0.absorption"] = "none"
def began_with(what):
    return lambda told, fraction: began.set() if what in told else None
try:
    DRAW
except KeyboardInterrupt:
    print("interrupted", flush=True)
    os._exit(0)
"""


def run_interrupted(drawing, count, size):
    script = INTERRUPTED
    for word, text in (("DRAW", drawing), ("COUNT", str(count)), ("SIZE", str(size))):
        script = script.replace(word, text)
    done = run_python("-c", script, timeout=500)
    assert done.stdout == "interrupted\n", done.stderr


def test_an_interruption_ends_a_picture_of_the_reference():
    """It would take minutes."""
    call = "splotchcl.reference(scene, particles, progress=began_with('reference'))"
    run_interrupted(call, 20000, 0.5)


def test_an_interruption_ends_a_picture_of_a_device(renderer):
    """It takes its particles in tens of parts."""
    call = "splotchcl.render(scene, particles, progress=began_with('drawing'))"
    run_interrupted(call, 1500000, 0.01)


def gas_and_stars():
    """A scene whose components are drawn one after the other, and its particles."""
    particles = Particles().gas(**make_arrays(200)).stars(**make_arrays(200))
    scene = splotchcl.suggest(particles, size=SIZE)
    for component in scene["component"]:
        scene[f"component.{component['name']}.absorption"] = "none"
    return scene, particles


def test_a_device_tells_how_far_it_is(renderer):
    told = []
    scene, particles = gas_and_stars()
    renderer.render(scene, particles, progress=lambda what, part: told.append((what, part)))
    assert ("drawing", 0.5) in told


def test_a_renderer_draws_again_after_a_device_was_stopped(renderer):
    def stop(what, fraction):
        if what == "drawing" and fraction > 0:
            raise LookupError("enough")

    scene, particles = gas_and_stars()
    expected = renderer.render(scene, particles).linear
    with pytest.raises(LookupError):
        renderer.render(scene, particles, progress=stop)
    assert np.array_equal(renderer.render(scene, particles).linear, expected)


def try_to_draw(queue):
    try:
        splotchcl.render(Particles().gas(**make_arrays(50)), size=(8, 8))
        queue.put("drawn")
    except DeviceError as error:
        queue.put(str(error))


def test_a_forked_child_is_refused(renderer):
    fork = multiprocessing.get_context("fork")
    queue = fork.Queue()
    child = fork.Process(target=try_to_draw, args=(queue,))
    child.start()
    answer = queue.get(timeout=60)
    child.join(60)
    assert "spawn" in answer


DRAWN = """
import os, sys, threading, time
import numpy as np
import splotchcl
position = np.random.default_rng(0).random((200000, 3), dtype="f4")
particles = splotchcl.Particles().gas(position=position, mass=1, smoothing_length=np.full(200000, 0.01, "f4"))
renderer = splotchcl.Renderer()
scene = splotchcl.suggest(particles, size=(64, 64))
renderer.render(scene, particles)
"""


@pytest.mark.parametrize("end", ["renderer = None; os._exit(3)", "sys.exit(3)"])
def test_a_renderer_is_freed_in_a_forked_child_without_harm(end):
    script = DRAWN + f"""
child = os.fork()
if child == 0:
    {end}
for _ in range(600):
    done, status = os.waitpid(child, os.WNOHANG)
    if done:
        os._exit(os.waitstatus_to_exitcode(status) % 256)
    time.sleep(0.1)
os.kill(child, 9)
os._exit(1)
"""
    assert run_python("-c", script, timeout=120).returncode == 3


def test_python_that_ends_while_a_thread_draws_has_its_own_exit_code():
    script = DRAWN + """
def draw():
    while True:
        renderer.render(scene, particles)
for _ in range(3):
    threading.Thread(target=draw, daemon=True).start()
time.sleep(0.5)
sys.exit(7)
"""
    for _ in range(3):
        assert run_python("-c", script, timeout=120).returncode == 7


def test_a_file_that_is_cut_while_it_is_mapped_is_an_error(tmp_path):
    script = """
import os, sys
import numpy as np, splotchcl
path = sys.argv[1]
np.save(path, np.random.default_rng(0).random((200000, 3), dtype="f4"))
snapshot = splotchcl.Snapshot(path)
scene = splotchcl.suggest(snapshot, size=(64, 48))
os.truncate(path, 100000)
try:
    splotchcl.reference(scene, snapshot)
except splotchcl.DataError as error:
    sys.exit(4 if "became shorter" in str(error) else 5)
sys.exit(6)
"""
    assert run_python("-c", script, tmp_path / "a.npy", timeout=120).returncode == 4


# As a simulation does it with a snapshot of one name, while a picture is drawn of it.
def test_a_file_that_is_written_anew_again_and_again_does_not_end_python(tmp_path):
    script = """
import os, sys, threading
import numpy as np, splotchcl
path = sys.argv[1]
np.save(path, np.random.default_rng(0).random((200000, 3), dtype="f4"))
whole = open(path, "rb").read()
scene = splotchcl.suggest(splotchcl.Snapshot(path), size=(32, 24))
ends = threading.Event()
def write_anew():
    while not ends.is_set():
        with open(path, "wb") as file:
            file.write(whole[: len(whole) // 3])
            file.flush()
            ends.wait(0.005)
            file.write(whole[len(whole) // 3 :])
        ends.wait(0.02)
writer = threading.Thread(target=write_anew)
writer.start()
for _ in range(30):
    try:
        splotchcl.reference(scene, splotchcl.Snapshot(path))
    except splotchcl.DataError:
        pass
ends.set()
writer.join()
sys.exit(7)
"""
    assert run_python("-c", script, tmp_path / "a.npy", timeout=240).returncode == 7
