"""Sward: living grass on any ground. Bakes fields of grass, reads and edits them, and draws them into numpy arrays.

    field = sward.bake("hills", density=200, seed=7)
    blades = field.blades()
    picture = sward.Renderer(field).render("eye", size=(1280, 720))

docs/python.md explains it by examples.
"""

from ._arrays import Ground, Mesh
from ._bake import Progress, bake, estimate, settings
from ._errors import Error, Warning
from ._field import Comparison, Field, compare, read, validate
from ._native import version as __version__
from ._options import Value
from ._renderer import Renderer
from ._session import Session

__all__ = ["Comparison", "Error", "Field", "Ground", "Mesh", "Progress", "Renderer", "Session", "Value", "Warning",
           "bake", "compare", "estimate", "read", "settings", "validate"]
