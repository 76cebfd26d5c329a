"""The version is said in one place, CMakeLists.txt; recipes that must repeat it say the same."""

import re
from pathlib import Path

import splotchcl

ROOT = Path(__file__).parents[2]
VERSION = re.search(r"project\(splotchcl VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def test_the_module_has_the_version_of_the_project():
    assert splotchcl.__version__ == VERSION


def test_recipes_have_the_version_of_the_project():
    recipes = ROOT / "scripts" / "packaging"
    assert f'version("{VERSION}")' in (recipes / "spack" / "package.py").read_text()
    assert f'version = "{VERSION}"' in (recipes / "conda" / "meta.yaml").read_text()
