"""Galaxies from pictures."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from . import _core
from ._sources import Snapshot
from ._untrusted import check_picture


def galaxy(
    picture: str | os.PathLike[str],
    path: str | os.PathLike[str],
    *,
    center: Sequence[float] | None = None,
    inclination: float = 0,
    position_angle: float = 0,
    radius: float | None = None,
    size: float = 30,
    gamma: float | None = None,
    threshold: float = 2,
    removes_stars: bool = True,
    speed: float = 200,
    core: float = 1,
    rotation_curve: str | os.PathLike[str] | None = None,
    clockwise: bool = False,
    seed: int = 1,
    **matter: float,
) -> Snapshot:
    """Makes a galaxy in three dimensions from one picture of it (docs/galaxy.md).

    Gas, disk stars ("disk"), a bulge ("bulge") and globular clusters ("stars"), each particle with a
    color, and dust ("boundary") with an opacity, around the origin, in kpc and km/s: what
    ``splotchcl galaxy`` makes.

    Parameters
    ----------
    picture : path-like
        A picture of a spiral galaxy, in any format.
    path : path-like
        The snapshot that is written, Gadget HDF5; it appears under its name when it is complete.
    center : 2 floats, optional
        The galaxy's center in pixels from the left and top; None: the center of light.
    inclination, position_angle : float
        Degrees by which the disk is tilted, 0 (face-on) to 80, and from up, counter-clockwise, to
        its longest diameter.
    radius : float, optional
        Where the galaxy ends, in pixels along its longest diameter; None: the whole picture.
    size : float
        Length of the picture's longer side, in kpc.
    gamma : float, optional
        Light is value^gamma; None: 2.2 for whole numbers, 1 for floats.
    threshold : float
        Pixels count that exceed the sky by so many deviations of its noise.
    removes_stars : bool
        Takes points of light for stars of the Milky Way.
    speed, core : float
        Of the flat rotation curve, in km/s, and the radius in kpc inside of which it turns like a
        solid body.
    rotation_curve : path-like, optional
        A file of two columns, kpc and km/s, instead.
    clockwise : bool
        Turns clockwise in the picture.
    seed : int
        The same seed makes the same galaxy.
    **matter
        The command's other options with underscores: ``gas_height``, ``cloud_points``,
        ``cloud_radius``, ``dust``, ``dust_height``, ``dust_points``, ``detail``, ``disk_stars``, ``disk_width``, ``disk_height``, ``disk_light``,
        ``bulge_stars``, ``bulge_radius``, ``bulge_light``, ``clusters``, ``cluster_stars``,
        ``cluster_light``.

    Returns
    -------
    Snapshot
        What was written, opened.

    Raises
    ------
    UsageError
        For settings out of range, and a `path` that is read.
    DataError
        For a picture without a galaxy, and files that cannot be read or written.
    """
    settings: dict[str, object] = {
        "inclination": inclination,
        "position_angle": position_angle,
        "size": size,
        "threshold": threshold,
        "removes_stars": removes_stars,
        "clockwise": clockwise,
        "seed": seed,
        **matter,
    }
    if center is not None:
        settings["center"] = [float(x) for x in center]
    if radius is not None:
        settings["radius"] = radius
    curve = None if rotation_curve is None else Path(rotation_curve)
    check_picture(picture)
    _core.make_galaxy_file(Path(picture), Path(path), settings, gamma, speed, core, curve)
    return Snapshot(path)
