"""Another process of Python, for what may end one."""

from __future__ import annotations

import os
import subprocess
import sys


def run_python(code: str, *arguments: str) -> int:
    """Its exit code, below 0 where a signal ended it. It finds the modules that this process finds.

    Python would look for them in the current folder first, which may be a stranger's.
    """
    return subprocess.run(
        [sys.executable, "-c", code, *arguments],
        env=environment_with_modules(),
        cwd=os.path.abspath(os.sep),
        capture_output=True,
        check=False,
    ).returncode


def environment_with_modules() -> dict[str, str]:
    """In which another Python finds the modules that this one finds."""
    folders = [os.path.abspath(folder) for folder in sys.path if folder]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(folders)}
