"""When OpenCL can be used, and which."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ._core import DeviceError
from ._process import run_python

# Threads of OpenCL do not live on in a child that was forked: drawing there would never end.
_used_in: list[int] = []

# Ends with 0 where there is a device.
_ASK_FOR_DEVICES = "from splotchcl import _core; raise SystemExit(not _core.devices())"


@contextmanager
def using_opencl() -> Iterator[None]:
    """Refuses a forked child of a process that has used OpenCL.

    Before its first use in a process, the OpenCL of the extra ``[pocl]`` is chosen where it is
    installed and the system has none.
    """
    if not _used_in:
        _choose_packaged_opencl()
        _used_in.append(os.getpid())
    if _used_in[0] != os.getpid():
        raise DeviceError(
            "OpenCL was used before this process was forked, and does not work in it; start "
            'processes with multiprocessing.get_context("spawn")'
        )
    yield


# The loader reads OCL_ICD_VENDORS once, and looks at nothing else then: so another process is asked
# whether there is a device without it.
def _choose_packaged_opencl() -> None:
    library = _packaged_opencl()
    if library is None or "OCL_ICD_VENDORS" in os.environ or not sys.executable:
        return
    if run_python(_ASK_FOR_DEVICES) != 0:
        os.environ["OCL_ICD_VENDORS"] = str(library)


def _packaged_opencl() -> Path | None:
    package = importlib.util.find_spec("pocl_binary_distribution")
    if package is None or package.origin is None:
        return None
    libraries = Path(package.origin).parents[1] / "pyopencl" / ".libs"
    return next(libraries.glob("libpocl*.so"), None)
