"""Pictures in notebooks."""

import shlex

from .errors import SceneError
from .rendering import png


def povray(line, cell):
    """``%%povray [SWITCHES]``: draws the scene of a cell, by default at 480x360 with ``+A0.3``."""
    from IPython.display import Image

    try:
        return Image(data=png(cell, width=480, height=360, antialias=True, name="cell", options=shlex.split(line)))
    except SceneError as error:
        # The lines of the scene say more than the calls that led there.
        print(error)
        return None
