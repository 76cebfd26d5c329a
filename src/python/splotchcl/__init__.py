"""Draws particle simulations of the universe with OpenCL.

>>> import splotchcl
>>> splotchcl.render("snapshot_006").save("a.png")

`render` draws, `suggest` chooses a `Scene`, `Particles` takes one's own arrays, `Snapshot` opens
a file, `column` makes a map in physical units, `movie` a film, `View` is the live view in a notebook,
`reference` says how exact a picture is. Errors are of `Error`, with one line each: `UsageError` is a ValueError, `DataError` an OSError,
`DeviceError` a RuntimeError.
"""

try:
    from ._core import DataError, DeviceError, Error, UsageError
except ImportError as error:
    if "libOpenCL" not in str(error):
        raise
    raise ImportError(
        f"{error}: OpenCL's loader, which finds devices, is not installed (Debian: apt-get install "
        "ocl-icd-libopencl1; conda: khronos-opencl-icd-loader)"
    ) from error

from ._core import version as __version__
from ._galaxy import galaxy
from ._image import Difference, Image
from ._inside import inside
from ._maps import Map, column
from ._movie import Film, movie
from ._render import Renderer, devices, reference, render, suggest
from ._scene import Scene, UnknownKey
from ._particles import Particles
from ._sources import ParticleType, Snapshot
from ._statistics import Histogram, Profile, histogram, profile
from ._view import View

__all__ = [
    "DataError",
    "DeviceError",
    "Difference",
    "Error",
    "Film",
    "Histogram",
    "Image",
    "Map",
    "ParticleType",
    "Particles",
    "Profile",
    "Renderer",
    "Scene",
    "Snapshot",
    "UnknownKey",
    "UsageError",
    "View",
    "__version__",
    "column",
    "devices",
    "galaxy",
    "histogram",
    "inside",
    "movie",
    "profile",
    "reference",
    "render",
    "suggest",
]
