"""That no generator of odd files is without a test."""

import re
from pathlib import Path

from odd import SCRIPTS


def test_each_generator_has_a_test_of_what_it_makes():
    tests = Path(__file__).parent.glob("test_odd_*.py")
    named = [name for path in tests for name in re.findall(r'^@of\("(\w+)"\)$', path.read_text(), re.M)]
    assert len(named) == len(set(named))
    assert SCRIPTS.keys() <= set(named)
