"""Other renderers that `tools/bench --peers` runs beside povr and POV-Ray.

A peer has a `name`; `missing()` tells in a line what it lacks on this machine, or gives None; `measure(path, threads,
folder)` draws a scene of the bench once, or gives None if the peer has no words for it; `check(path, folder, measured,
ours)` tells whether that showed what povr shows in `povr.ppm`, and a word about it; `ratios(measured, ours)` compares
medians. `columns` are what it adds to the table: a title, the name of the figure, its format.
"""

from .embree import Embree
from .tachyon import Tachyon


def installed(kept, size):
    """The peers that are on this machine, and a line about each of the others.

    `kept` is the folder for translated scenes and programs, `size` the width and height of pictures in pixels."""
    peers, absent = [], []
    for peer in (Tachyon(kept, size), Embree(kept, size)):
        missing = peer.missing()
        if missing:
            absent.append(f"{peer.name} is left out: {missing}")
        else:
            peers.append(peer)
    return peers, absent
