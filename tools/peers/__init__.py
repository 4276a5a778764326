"""Other renderers that `tools/bench --peers` runs beside povr and POV-Ray.

A peer has a `name`; `missing()` returns a line about its missing prerequisites, or None; `measure(path, threads, folder)`
draws a scene of the bench once, or returns None if the peer does not support it; `check(path, folder, measured, ours)`
returns whether the result agrees with povr's picture `povr.ppm`, and a remark; `ratios(measured, ours)` compares medians.
`columns` are its columns of the table: a title, the name of the figure, its format.
"""

from .embree import Embree
from .tachyon import Tachyon


def installed(folder, size):
    """The peers that are installed, and a line about each of the others.

    `folder` is the folder for translated scenes and programs, `size` the width and height of pictures in pixels."""
    peers, absent = [], []
    for peer in (Tachyon(folder, size), Embree(folder, size)):
        missing = peer.missing()
        if missing:
            absent.append(f"{peer.name} is left out: {missing}")
        else:
            peers.append(peer)
    return peers, absent
