"""The widget of splotchcl.View in JupyterLab: by the Python that SPLOTCHCL_JUPYTER names, or the one
of jupyter-lab in PATH, with the module of the program's build."""

import json
import os
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from page_socket import PATIENCE

CELLS = [
    "import splotchcl\nview = splotchcl.View('universe.gadget', size=(320, 240))\nview",
    "view.scene['component.0.brightness'] = 3",
    "print('brightness is', view.scene['component.0.brightness'])",
]
TOKEN = "abc"


def notebook():
    cells = [
        {"cell_type": "code", "id": f"cell{i}", "source": source, "metadata": {}, "outputs": [],
         "execution_count": None}
        for i, source in enumerate(CELLS)
    ]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    return {"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}


@pytest.fixture(scope="module")
def jupyter_python(program):
    """A Python with JupyterLab, anywidget and this module, and what it is to be called with."""
    path = os.environ.get("SPLOTCHCL_JUPYTER")
    if path is None and shutil.which("jupyter-lab"):
        first = Path(shutil.which("jupyter-lab")).read_text(errors="replace").splitlines()[0]
        path = first.removeprefix("#!")
    if path is None:
        pytest.skip("no jupyter-lab in PATH, and SPLOTCHCL_JUPYTER names no Python that has it")
    build = Path(program).parent
    environment = {**os.environ, "PYTHONPATH": str(build / "python"),
                   "PATH": f"{build}{os.pathsep}{os.environ['PATH']}"}
    words = [path, "-c", "import anywidget, ipykernel, jupyterlab, splotchcl"]
    if subprocess.run(words, env=environment, capture_output=True, check=False).returncode != 0:
        pytest.skip(f"{path} has not all of jupyterlab, anywidget and splotchcl")
    return path, environment


@pytest.fixture
def lab(jupyter_python, snapshot, tmp_path):
    """The address of a notebook of CELLS beside the snapshot."""
    path, environment = jupyter_python
    (tmp_path / "cells.ipynb").write_text(json.dumps(notebook()))
    (tmp_path / "universe.gadget").symlink_to(snapshot)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    # Settings of its own, which nobody's change.
    folders = {name: str(tmp_path / name) for name in
               ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")}
    server = subprocess.Popen(
        [path, "-m", "jupyterlab", "--no-browser", "--allow-root", f"--port={port}",
         f"--IdentityProvider.token={TOKEN}", "--ServerApp.port_retries=0"],
        cwd=tmp_path, env={**environment, **folders},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )
    address = f"http://localhost:{port}"
    wait_until(lambda: answers(f"{address}/api?token={TOKEN}"))
    yield f"{address}/lab/tree/cells.ipynb?token={TOKEN}"
    server.terminate()
    server.wait(PATIENCE)


def answers(address):
    try:
        return urllib.request.urlopen(address, timeout=5).status == 200
    except (urllib.error.URLError, OSError):
        return False


def wait_until(holds):
    deadline = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < deadline, "it has not come"
        time.sleep(0.2)


def run_cell(browser, number):
    from selenium.webdriver.common.keys import Keys

    wait_until(lambda: len(browser.find_elements("css selector", ".jp-CodeCell .cm-content")) == len(CELLS))
    editor = browser.find_elements("css selector", ".jp-CodeCell .cm-content")[number]
    browser.execute_script("arguments[0].scrollIntoView()", editor)
    editor.click()
    editor.send_keys(Keys.SHIFT, Keys.ENTER)


def has_run(browser, number):
    """Runs the cell, anew where the notebook was not ready yet."""
    run_cell(browser, number)
    for _ in range(20):
        time.sleep(0.5)
        prompt = browser.find_elements("css selector", ".jp-CodeCell .jp-InputPrompt")[number].text
        if prompt.strip("[]: ").isdecimal():
            return True
    return False


def page_says(browser, script):
    """What a script in the view's page returns; None where there is no such page yet."""
    frames = browser.find_elements("css selector", "iframe[title='splotchcl view']")
    if not frames:
        return None
    # Out of sight it rests.
    browser.execute_script("arguments[0].scrollIntoView()", frames[0])
    browser.switch_to.frame(frames[0])
    try:
        return browser.execute_script(script)
    finally:
        browser.switch_to.default_content()


def printed(browser):
    return " ".join(one.text for one in browser.find_elements("css selector", ".jp-OutputArea-output"))


def test_what_one_side_sets_the_other_has(browser, lab):
    browser.get(lab)
    wait_until(lambda: has_run(browser, 0))
    wait_until(lambda: page_says(browser, "return document.body.dataset.stage") == "exact")
    brightness = "return window.app.store.settings['component.0.brightness']"
    assert page_says(browser, brightness) != 3
    run_cell(browser, 1)
    wait_until(lambda: page_says(browser, brightness) == 3)
    # As a control does. The notebook has it once the exact picture is there.
    page_says(browser, "window.app.store.change({'component.0.brightness': 5})")
    wait_until(lambda: page_says(browser, "return document.getElementById('status').textContent").startswith("Exact"))

    def is_printed():
        run_cell(browser, 2)
        time.sleep(1)
        return "brightness is 5" in printed(browser)

    wait_until(is_printed)
    browser.get("about:blank")
