"""When OpenCL can be used, and which."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ._core import DeviceError
from ._process import run_python

# Threads of OpenCL do not live on in a child that was forked: drawing there would never end.
_used_in: list[int] = []

# In a wheel that carries one (scripts/wheel --bundle).
_OPENCL = Path(__file__).parent / "opencl"

# Ends with 0 where there is a device.
_ASK_FOR_DEVICES = "from splotchcl import _core; raise SystemExit(not _core.devices())"


@contextmanager
def using_opencl() -> Iterator[None]:
    """Refuses a forked child of a process that has used OpenCL.

    Before its first use in a process, the OpenCL that came with this package is chosen where the
    system has none.
    """
    if not _used_in:
        # Where Python is a part of another program, nobody can be asked.
        choose_packaged_opencl(
            lambda: not sys.executable or run_python(_ASK_FOR_DEVICES) == 0
        )
        _used_in.append(os.getpid())
    if _used_in[0] != os.getpid():
        raise DeviceError(
            "OpenCL was used before this process was forked, and does not work in it; start "
            'processes with multiprocessing.get_context("spawn")'
        )
    yield


def choose_packaged_opencl(has_devices: Callable[[], bool]) -> None:
    """Names this package's own OpenCL to the loader, where there is one and no other has a device.

    The loader reads its variable once, and looks at nothing else then: ``has_devices`` asks another
    process whether there is a device without it.
    """
    drivers = list(_OPENCL.glob("lib/*/libpocl.so.*"))
    if not drivers or "OCL_ICD_VENDORS" in os.environ or has_devices():
        return
    os.environ["OCL_ICD_VENDORS"] = str(drivers[0])
    # What the name of its compiler's linker begins with; other compilers expect folders here.
    prefixes = [str(_OPENCL / "bin" / "kernel-"), os.environ.get("COMPILER_PATH", "")]
    os.environ["COMPILER_PATH"] = os.pathsep.join(filter(None, prefixes))
