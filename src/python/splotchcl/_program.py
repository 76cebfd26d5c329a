"""The command line, where a wheel brings it along."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from ._opencl import choose_packaged_opencl

PROGRAM = Path(__file__).parent / "bin" / "splotchcl"


def main() -> None:
    """Becomes the program."""
    if not PROGRAM.exists():
        raise SystemExit(
            f"splotchcl: this package has no program ({PROGRAM}); a wheel of `scripts/wheel "
            "--bundle` has one"
        )

    def has_devices() -> bool:
        command = [str(PROGRAM), "devices"]
        return subprocess.run(command, capture_output=True, check=False).returncode == 0

    choose_packaged_opencl(has_devices)
    os.execv(PROGRAM, ["splotchcl", *sys.argv[1:]])
