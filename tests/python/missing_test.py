"""Stands for the suites of the Python module in a build without it."""

import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from needs import needs


class Missing(unittest.TestCase):
    def test_the_module_is_built_where_it_can_be(self):
        needs("pybind11")
        self.fail("pybind11 is there, but the module was left out: configure again, or see SWARD_BUILD_PYTHON")


if __name__ == "__main__":
    unittest.main()
