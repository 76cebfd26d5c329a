"""Files of `splotchcl publish` for other viewers, read by other programs' readers."""

from __future__ import annotations

import re

import numpy as np
import pytest

from splotchcl import Image

SIZE = 256
HARMONIC = 0.5 / np.sqrt(np.pi)
# Viewers have neither bloom nor a background.
KEYS = ["finish.bloom=0", "image.background=[0,0,0]", "camera.field_of_view=40"]
SETTINGS = ["--look", "classic", "--size", f"{SIZE}x{SIZE}"]
SETTINGS += [word for key in KEYS for word in ("--set", key)]
COLUMNS = ["place", "deviation", "opacity", "color"]


@pytest.fixture(scope="module")
def published(program, universe, tmp_path_factory):
    folder = tmp_path_factory.mktemp("splats")
    for ending in ("ply", "glb", "usda"):
        path = folder / f"universe.{ending}"
        program("publish", universe, "-o", path, "--splats", 5000, *SETTINGS)
    return folder


@pytest.fixture(scope="module")
def ply_file(published):
    return pytest.importorskip("plyfile").PlyData.read(published / "universe.ply")


@pytest.fixture(scope="module")
def ply(ply_file):
    """The columns that viewers make of a .ply."""
    vertex = ply_file["vertex"]
    names = [["x", "y", "z"], [f"f_dc_{i}" for i in range(3)], [f"rot_{i}" for i in range(4)]]
    place, color, rotation = (np.stack([vertex[n] for n in group], 1) for group in names)
    assert (rotation == [1, 0, 0, 0]).all()
    for axis in (1, 2):
        assert (vertex[f"scale_{axis}"] == vertex["scale_0"]).all()
    return {
        "place": place,
        "deviation": np.exp(vertex["scale_0"]),
        "opacity": 1 / (1 + np.exp(-vertex["opacity"])),
        "color": 0.5 + HARMONIC * color,
    }


def assert_same(columns, ply):
    for name in COLUMNS:
        np.testing.assert_allclose(columns[name], ply[name], rtol=1e-4, atol=2e-6, err_msg=name)


def test_ply_holds_colors_and_opacities(ply):
    assert len(ply["place"]) == 5000
    assert (ply["deviation"] > 0).all()
    assert ply["opacity"].max() > 0.1
    np.testing.assert_allclose(ply["color"].max(1), 1, atol=1e-5)
    assert ply["color"].min() > -1e-6


def test_gltf_holds_the_same_splats(published, ply):
    pygltflib = pytest.importorskip("pygltflib")
    gltf = pygltflib.GLTF2().load(str(published / "universe.glb"))
    assert gltf.extensionsUsed == ["KHR_gaussian_splatting"]
    primitive = gltf.meshes[0].primitives[0]
    assert primitive.mode == pygltflib.POINTS
    assert primitive.extensions["KHR_gaussian_splatting"]["kernel"] == "ellipse"
    attributes = vars(primitive.attributes)
    kinds = {pygltflib.FLOAT: np.float32, pygltflib.BYTE: np.int8, pygltflib.UNSIGNED_BYTE: np.uint8}
    widths = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}

    def column(name):
        accessor = gltf.accessors[attributes[name]]
        view = gltf.bufferViews[accessor.bufferView]
        count = accessor.count * widths[accessor.type]
        values = np.frombuffer(
            gltf.binary_blob(), kinds[accessor.componentType], count, view.byteOffset
        )
        return values.reshape(accessor.count, -1)

    assert (column("KHR_gaussian_splatting:ROTATION") == [0, 0, 0, 127]).all()
    accessor = gltf.accessors[attributes["POSITION"]]
    np.testing.assert_array_equal(accessor.min, column("POSITION").min(0))
    np.testing.assert_array_equal(accessor.max, column("POSITION").max(0))
    assert_same(
        {
            "place": column("POSITION") * [1, -1, -1],
            "deviation": column("KHR_gaussian_splatting:SCALE")[:, 0],
            "opacity": column("KHR_gaussian_splatting:OPACITY")[:, 0],
            "color": 0.5 + HARMONIC * column("KHR_gaussian_splatting:SH_DEGREE_0_COEF_0"),
        },
        ply,
    )


def test_gltf_is_points_to_those_who_know_no_splats(published, ply):
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.load(published / "universe.glb")
    points = next(iter(scene.geometry.values()))
    np.testing.assert_allclose(points.vertices, ply["place"] * [1, -1, -1], atol=1e-6)


def test_usd_holds_the_same_splats(published, ply):
    usd = pytest.importorskip("pxr.Usd")
    stage = usd.Stage.Open(str(published / "universe.usda"))
    prim = stage.GetDefaultPrim()
    assert prim.GetTypeName() == "ParticleField3DGaussianSplat"
    if not usd.SchemaRegistry().FindConcretePrimDefinition(prim.GetTypeName()):
        pytest.skip("this OpenUSD is older than its splats")
    assert set(prim.GetAuthoredPropertyNames()) <= set(
        prim.GetPrimDefinition().GetPropertyNames()
    )

    def column(name):
        return np.array(prim.GetAttribute(name).Get())

    assert_same(
        {
            "place": column("positions") * [1, -1, -1],
            "deviation": column("scales")[:, 0],
            "opacity": column("opacities"),
            "color": 0.5 + HARMONIC * column("radiance:sphericalHarmonicsCoefficients"),
        },
        ply,
    )


def draw(ply, field_of_view: float) -> np.ndarray:
    """Display values of what a viewer shows: far splats first, each over what is there. What changes
    less than a step is left out, as viewers do."""
    distance = 1 / np.tan(np.radians(field_of_view / 2))
    depth = ply["place"][:, 2] + distance
    scale = SIZE / 2 * distance / depth
    middle = SIZE / 2 + scale[:, None] * ply["place"][:, :2]
    variance = (scale * ply["deviation"]) ** 2 + 0.3
    at = np.arange(SIZE) + 0.5
    picture = np.zeros((SIZE, SIZE, 3))
    for i in np.argsort(-depth):
        if depth[i] <= 0:
            continue
        across, along = (np.exp(-((at - m) ** 2) / (2 * variance[i])) for m in middle[i])
        opacity = (ply["opacity"][i] * along[:, None] * across)[..., None]
        opacity[opacity < 1 / 255] = 0
        picture += opacity * (ply["color"][i] - picture)
    return picture


def test_another_viewer_is_as_near_as_the_file_says(program, universe, ply_file, ply, tmp_path):
    program("render", universe, "-o", tmp_path / "drawn.png", *SETTINGS)
    drawn = Image.open(tmp_path / "drawn.png").display()[..., :3] / 255
    said = float(re.search(r"show them ([0-9.]+) of 255", ply_file.comments[0])[1])
    difference = 255 * (draw(ply, field_of_view=40) - drawn)
    assert np.sqrt((difference**2).mean()) == pytest.approx(said, abs=1.5)
    assert said < 0.3 * 255 * np.sqrt((drawn**2).mean())


def test_other_endings_are_refused(program, universe, tmp_path):
    with pytest.raises(AssertionError, match=r"ends in \.html, \.ply, \.glb or \.usda"):
        program("publish", universe, "-o", tmp_path / "universe.obj")
