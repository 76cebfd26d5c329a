"""A `splotchcl view` that ends with this process."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from ._core import DataError, UsageError
from ._process import environment_with_modules
from ._program import PROGRAM

# The pipe ends with this process, however that ends.
_GUARD = """
import subprocess, sys, threading
child = subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL)
def end():
    sys.stdin.buffer.read()
    child.terminate()
    try:
        child.wait(5)
    except subprocess.TimeoutExpired:
        child.kill()
threading.Thread(target=end, daemon=True).start()
raise SystemExit(child.wait())
"""
_RUN_PROGRAM = "from splotchcl._program import main; main()"


class ViewServer:
    """Serves the page of a scene file until it is closed.

    Parameters
    ----------
    scene
        The scene file.
    origin
        Of the page that shows it in a frame; empty: none does.

    Raises
    ------
    UsageError, DataError
        With what the program says.
    """

    def __init__(self, scene: Path, origin: str = "") -> None:
        words = [*_program(), "view", str(scene), "--quiet"]
        if origin:
            words += ["--frame-in", origin]
        with tempfile.TemporaryFile() as errors:
            self._process = subprocess.Popen(
                [*_python(_GUARD), *words],
                env=environment_with_modules(),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
            )
            assert self._process.stdout is not None
            self.address = self._process.stdout.readline().decode().strip()
            if not self.address:
                code = self._process.wait()
                errors.seek(0)
                message = errors.read().decode(errors="replace").strip().removeprefix("splotchcl: ")
                self.close()
                raise UsageError(message) if code == 2 else DataError(message)

    def close(self) -> None:
        """Ends the program."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        self._process.wait()

    def is_open(self) -> bool:
        return self._process.poll() is None


# What a wheel brings along needs its own OpenCL chosen first.
def _program() -> list[str]:
    if PROGRAM.exists():
        return _python(_RUN_PROGRAM)
    for folder in os.get_exec_path():
        program = Path(folder) / "splotchcl"
        if program.is_absolute() and os.access(program, os.X_OK) and program.is_file():
            return [str(program)]
    raise UsageError(
        "no program splotchcl in PATH, and none in this package; expected one, which a view is "
        "served by: install it (docs/packages.md)"
    )


# What lies in the current folder, where the view writes its files, is no module (-P from 3.11 on).
def _python(code: str) -> list[str]:
    return [sys.executable, "-c", f"import sys; sys.path[:] = [p for p in sys.path if p]\n{code}"]
