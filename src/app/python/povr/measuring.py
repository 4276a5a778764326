"""Differences of pictures, and error against time."""

import json
import os
import tempfile
from typing import NamedTuple, Optional, Tuple

from . import _povr


class Comparison(NamedTuple):
    """The difference of two pictures, in steps of their depth: 1/255, 1/65535, or half floats."""

    pixels: int
    """Number of pixels of each picture."""
    equal: int
    """Pixels equal in all channels."""
    off_by_one: int
    """Pixels whose most different channel is one step off."""
    off_by_more: int
    """Pixels with a channel that is more than one step off."""
    mean: float
    """Mean of the absolute differences over all channels, in steps."""
    rms: float
    """Root of the mean of the squared differences over all channels, in steps."""
    max: float
    """The largest difference in one channel, in steps."""
    psnr: float
    """Peak signal-to-noise ratio in decibels; infinite for equal pictures."""
    flip: float
    """Mean FLIP error, 0 to 1."""
    place: Optional[Tuple[int, int]]
    """Column and row of the largest difference, from 0; ``None`` for equal pictures."""

    @property
    def same(self):
        """True if all pixels are equal."""
        return self.equal == self.pixels


def _picture(picture):
    if isinstance(picture, (str, os.PathLike)):
        return os.fspath(picture)
    import numpy

    array = numpy.asarray(picture)
    dtype = array.dtype.newbyteorder("=")
    if dtype not in (numpy.uint8, numpy.uint16, numpy.float32):
        raise ValueError(f"a picture of {array.dtype}; it is uint8, uint16 or float32")
    if array.ndim != 3 or array.shape[2] not in (3, 4):
        raise ValueError(f"a picture of the shape {array.shape}; it is (height, width, 3 or 4)")
    array = numpy.ascontiguousarray(array, dtype)
    height, width, channels = array.shape
    return width, height, channels, 8 * array.itemsize, array.tobytes()


def compare(expected, actual) -> Comparison:
    """Compares two pictures: arrays of ``render``, or files of any format that povr reads.

    Of pictures of unlike depth the one with fewer bits decides. Returns a ``Comparison``.

    :raises ValueError: the sizes differ.
    """
    fields = dict(_povr.compare(_picture(expected), _picture(actual)))
    place = (int(fields.pop("x")), int(fields.pop("y"))) if "x" in fields else None
    counts = {key: int(fields.pop(key)) for key in ("pixels", "equal", "off_by_one", "off_by_more")}
    return Comparison(**counts, **fields, place=place)


def curve(scene, settings=None, *, runs=3, povray=False, truth=None, folder=None, options=(), cancel=None):
    """Draws a scene with many settings and measures the error of each against its time, as ``povr curve`` does.

    :param scene: the path of a scene.
    :param settings: switches of each setting: ``["--error 1", "+A0.1 +AM1 +R3"]``; the usual ones by default.
    :param int runs: renders with each setting; times are their medians.
    :param bool povray: measures POV-Ray too.
    :param float truth: estimated error of the reference picture, in steps of 1/255.
    :param folder: keeps pictures, tables and a page there; a later call measures only what is missing.
    :param options: switches for all renders: ``"+W160 +H120"``.
    :param CancelToken cancel: cancels it from another thread.
    :returns: a ``dict``: ``truth`` describes the reference picture, and ``measured`` has a ``dict`` for each setting
        with ``family``, ``switches``, ``processor`` and ``wall`` (seconds: ``median``, ``least``, ``most``),
        ``samples_per_pixel`` and ``errors`` (``rmse``, ``max``, ``p999``, ``flip``; in linear light).
    """
    arguments = ["--quiet", "--runs", str(runs)]
    if settings is not None:
        arguments += ["--settings", settings if isinstance(settings, str) else ";".join(settings)]
    arguments += ["--povray"] if povray else []
    arguments += [] if truth is None else ["--truth", repr(float(truth))]
    arguments += options.split() if isinstance(options, str) else options
    with tempfile.TemporaryDirectory() as own:
        arguments += ["--out", os.fspath(folder or own), "--", os.fspath(scene)]
        return json.loads(_povr.curve(arguments, cancel))
