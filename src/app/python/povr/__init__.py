"""Renders POV-Ray scenes to numpy arrays, without a program or a file.

>>> import povr
>>> picture = povr.render("sphere { 0, 1 pigment { rgb 1 } } light_source { -9, 1 } camera { location -3*z }")
>>> picture.shape, picture.dtype
((600, 800, 3), dtype('uint8'))

``render`` and ``render_frames`` draw, ``check`` and ``plan`` look at a scene, ``compare`` and ``curve`` measure.
``Scene`` and the elements beside it (``Sphere``, ``Camera``, ...) build scenes of Python objects; ``Spheres``,
``Cylinders`` and ``Triangles`` put arrays into them. Programs written for vapory import ``povr.vapory`` instead.
"""

from ._povr import Cancelled, CancelToken
from .errors import Finding, SceneError, SceneWarning
from .elements import *
from .elements import __all__ as _elements  # type: ignore[attr-defined]
from .rendering import Antialias, check, plan, png, render, render_frames
from .measuring import Comparison, compare, curve

__all__ = [
    "Antialias",
    "CancelToken",
    "Cancelled",
    "Comparison",
    "Finding",
    "SceneError",
    "SceneWarning",
    "check",
    "compare",
    "curve",
    "plan",
    "png",
    "render",
    "render_frames",
    *_elements,
]


def load_ipython_extension(shell):
    """Adds the cell magic ``%%povray [SWITCHES]`` to IPython: ``%load_ext povr``."""
    from .notebook import povray

    shell.register_magic_function(povray, "cell")
