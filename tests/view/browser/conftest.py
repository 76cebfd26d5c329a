"""What the tests of the live view share: the program that serves it, and a browser that looks."""

import os
import shutil
import signal
import subprocess
from pathlib import Path

import pytest

from page_socket import PATIENCE


@pytest.fixture(scope="session")
def program() -> str:
    path = os.environ.get("SPLOTCHCL_PROGRAM")
    if path is None:
        pytest.skip("SPLOTCHCL_PROGRAM does not name the program")
    return path


@pytest.fixture(scope="session")
def run(program):
    """Runs the command line; it must succeed."""

    def run_program(*arguments):
        words = [program, *map(str, arguments)]
        done = subprocess.run(words, capture_output=True, text=True, timeout=600, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run_program


@pytest.fixture(scope="session")
def snapshot(run, tmp_path_factory) -> Path:
    """20000 particles of gas and stars."""
    path = tmp_path_factory.mktemp("universe") / "universe.gadget"
    run("generate", "universe", "--particles", 20000, "-o", path)
    return path


@pytest.fixture(scope="session")
def real_file():
    """Finds a real snapshot by its name below the folder of them."""
    folder = Path(os.environ.get("SPLOTCHCL_TEST_DATA", "nowhere"))

    def find(name) -> Path:
        if not (folder / name).is_file():
            pytest.skip(f"no snapshot {name} in the folder SPLOTCHCL_TEST_DATA")
        return (folder / name).resolve()

    return find


class View:
    """A running splotchcl view, in a folder of its own."""

    def __init__(self, program: str, folder: Path, kernels: Path, *arguments):
        self.folder = folder
        words = [program, "view", *map(str, arguments)]
        self.process = subprocess.Popen(
            words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            env={**os.environ, "SPLOTCHCL_CACHE": str(kernels)},
        )
        self.address = self.process.stdout.readline().strip()

    @property
    def port(self) -> int:
        return int(self.address.split(":")[2].split("/")[0])

    @property
    def token(self) -> str:
        return self.address.rstrip("/").rsplit("/", 1)[1]

    def end(self):
        """As Ctrl-C does. Returns the exit code, and what else was printed."""
        self.process.send_signal(signal.SIGINT)
        rest, _ = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, rest


@pytest.fixture(scope="session")
def kernels(tmp_path_factory) -> Path:
    """Compiled kernels, which all programs of these tests share, with other tests where ctest says so."""
    shared = os.environ.get("SPLOTCHCL_CACHE")
    return Path(shared) if shared else tmp_path_factory.mktemp("kernels")


@pytest.fixture
def view(program, snapshot, kernels, tmp_path):
    opened = []

    def open_view(*arguments) -> View:
        opened.append(View(program, tmp_path, kernels, *(arguments or (snapshot, "--size", "320x240"))))
        assert opened[-1].address, opened[-1].process.stderr.read()
        return opened[-1]

    yield open_view
    for one in opened:
        if one.process.poll() is None:
            one.process.kill()
            one.process.communicate()


@pytest.fixture(scope="session")
def browser():
    webdriver = pytest.importorskip(
        "selenium.webdriver", reason="python3-selenium is missing; scripts/setup --browser installs it"
    )
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if chromium is None or driver is None:
        pytest.skip("chromium or its driver is missing; scripts/setup --browser installs it")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1200,800",
                     "--disable-dev-shm-usage", "--force-device-scale-factor=1",
                     # WebGL by the processor.
                     "--use-angle=swiftshader", "--enable-unsafe-swiftshader"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.chrome.service.Service(executable_path=driver)
    made = webdriver.Chrome(service=service, options=options)
    made.set_script_timeout(PATIENCE)
    yield made
    made.quit()


@pytest.fixture
def page(browser, view):
    from page import Page

    made = Page(browser, view())
    made.errors()
    yield made
    assert made.errors() == []
    browser.get("about:blank")
