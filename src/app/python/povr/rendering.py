"""Pictures of scenes."""

import collections
import json
import logging
import os
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

from . import _povr
from .elements import Scene
from .errors import findings, scene_error, warn

_FORMATS = {8: ("+FN8", "u1"), 16: ("+FN16", ">u2"), 32: ("+FE", "f4")}

_log = logging.getLogger("povr")


class Antialias(NamedTuple):
    """POV-Ray's antialiasing."""

    threshold: float = 0.3
    """Difference of two colours above which a pixel is supersampled."""
    method: int = 1
    """1: a grid in pixels that differ from a neighbour; 2: recursive subdivision."""
    depth: int = 3
    """Side of the grid, or number of subdivisions; 1 to 9."""
    jitter: float = 1.0
    """Jitter of the samples as a part of a cell of the grid; 0 is none."""


def _quoted(path):
    path = os.fspath(path)
    mark = "'" if '"' in path else '"'
    if mark in path:
        raise ValueError(f"a path with both kinds of quotes: {path}")
    return f"{mark}{path}{mark}"


def render_options(
    width=800,
    height=600,
    antialias=None,
    alpha=False,
    depth=8,
    threads=None,
    version=None,
    include_path=(),
    declare=None,
    clock=None,
    error=None,
    time=None,
    options=(),
    allow_write=(),
):
    """The options of a render as POV-Ray's switches."""
    if depth not in _FORMATS:
        raise ValueError(f"depth is {depth!r}; it is 8, 16 or 32")
    switches = [f"+W{width:d}", f"+H{height:d}", _FORMATS[depth][0], "+UA" if alpha else "-UA"]
    if antialias is not None and antialias is not False:
        if antialias is True or not isinstance(antialias, tuple):
            antialias = Antialias() if antialias is True else Antialias(float(antialias))
        threshold, method, grid, jitter = antialias
        switches += [f"+A{threshold:f}", f"+AM{method:d}", f"+R{grid:d}"]
        switches.append(f"+J{jitter:f}" if jitter > 0 else "-J")
    if threads is not None:
        switches.append(f"+WT{threads:d}")
    if version is not None:
        switches.append(f"+MV{version}")
    if isinstance(include_path, (str, os.PathLike)):
        include_path = [include_path]
    switches += [f"Library_Path={_quoted(path)}" for path in include_path]
    switches += [f"Declare={name}={float(value)!r}" for name, value in (declare or {}).items()]
    if clock is not None:
        switches.append(f"+K{float(clock)!r}")
    if error is not None:
        switches.append(f"--error={float(error)!r}")
    if time is not None:
        switches.append(f"--time={float(time)!r}s")
    switches += options.split() if isinstance(options, str) else options
    allowed = [allow_write] if isinstance(allow_write, (str, os.PathLike)) else allow_write
    switches += [f"--allow-write={os.fspath(path)}" for path in allowed]
    # `--no-write` would win over folders that are named.
    if not any(switch.startswith("--allow-write") for switch in switches):
        switches.append("--no-write")
    return switches


def _session(scene, switches, *, depth=8, name="scene", cancel=None, is_series=False):
    """A session of the compiled module."""
    rows = []
    if isinstance(scene, Scene):
        scene, rows = scene.parts()
    elif not isinstance(scene, (str, bytes, os.PathLike)):
        raise TypeError(f"a scene of type {type(scene).__name__}; it is a str, bytes, a path or a Scene")
    is_file = isinstance(scene, os.PathLike)
    if isinstance(scene, str) and scene.lower().endswith(".pov") and "\n" not in scene:
        is_file = True
    if is_file:
        path = os.fspath(scene)
        if not os.path.isfile(path):
            raise FileNotFoundError(f"there is no scene `{path}`")
        source, switches = None, [*switches, "--", path]
    else:
        source = (name, scene.encode() if isinstance(scene, str) else scene)
    try:
        session = _povr.Session(switches, source, rows, depth, cancel, is_series)
    except _povr.Refused as refused:
        raise scene_error(refused) from None
    warn(session.warnings)
    return session


def _drawn(draw, **how):
    """Draws, and hands on what the scene reports."""
    try:
        drawn = draw(**how)
    except _povr.Refused as refused:
        warn(one for one in findings(refused.args[0]) if one.severity == "warning")
        raise scene_error(refused) from None
    warn(findings(drawn.findings))
    if drawn.output:
        _log.debug("%s", drawn.output.rstrip())
    return drawn


def _array(drawn, depth):
    import numpy

    array = numpy.frombuffer(drawn.data, _FORMATS[depth][1])
    # 16 bits come in the order of a PNG file; the conversion copies no other array.
    return array.astype(array.dtype.newbyteorder("="), copy=False).reshape(drawn.shape)


def render(scene, *, depth=8, name="scene", progress=None, cancel=None, **options):
    """Renders a scene to an array.

    Other threads of Python run meanwhile, and any number of them may render. Ctrl-C ends a render with
    ``KeyboardInterrupt``. Files that the scene names are read; it writes none unless ``allow_write`` lets it.

    :param scene: the text of a scene; a path, as ``pathlib.Path`` or a ``str`` that ends in ``.pov``; or a ``Scene``.
    :param int width: columns of the picture, 800 by default.
    :param int height: rows of the picture, 600 by default.
    :param antialias: ``None`` for one ray per pixel; ``True``, a threshold or an ``Antialias`` for POV-Ray's methods.
    :param bool alpha: adds a channel with the opacity of the background.
    :param int depth: bits per channel. 8 and 16 give ``uint8`` and ``uint16``, the values of a PNG file (sRGB). 32
        gives ``float32``, the linear light of an EXR file, with premultiplied alpha.
    :param int threads: threads to draw with, one for each core by default; the picture is the same for any number.
    :param float version: the language version in force at the start; the scene's ``#version`` by default.
    :param include_path: folders for included files, besides the current one.
    :param dict declare: names and numbers that are declared before the scene is read.
    :param float clock: the value of ``clock``.
    :param float error: samples until the estimated error of every pixel is below this, in steps of 1/255.
    :param float time: samples for this time, in seconds, or until ``error`` is reached.
    :param options: further switches of the command line, as a ``str`` or a list: ``"+Q5 +SC0.5"``. Switches for other
        file types, for a number of bits other than ``depth`` and for grey pictures are refused.
    :param allow_write: folders in which the scene may write files.
    :param str name: the name of a text in messages.
    :param progress: called with the part done, from 0 to 1, 20 times a second and at the end. An exception cancels.
    :param CancelToken cancel: cancels the render from another thread: ``Cancelled`` is raised.
    :returns: an array of the shape (height, width, 3), or (height, width, 4) with ``alpha``.
    :raises SceneError: the scene has errors.
    :raises ValueError: an option is wrong.
    """
    session = _session(scene, render_options(depth=depth, **options), depth=depth, name=name, cancel=cancel)
    return _array(_drawn(session.draw, progress=progress), depth)


def png(scene, *, depth=8, name="scene", progress=None, cancel=None, **options):
    """Renders a scene to the ``bytes`` of a PNG file. The options are those of ``render``; ``depth`` is 8 or 16."""
    if depth == 32:
        raise ValueError("a PNG file has 8 or 16 bits")
    session = _session(scene, render_options(depth=depth, **options), depth=depth, name=name, cancel=cancel)
    return bytes(_drawn(session.draw, is_file=True, progress=progress).data)


def render_frames(
    scene,
    frames,
    *,
    first=1,
    clock=(0.0, 1.0),
    cyclic=False,
    depth=8,
    name="scene",
    progress=None,
    cancel=None,
    **options,
):
    """Renders an animation, with its frames side by side. Yields their arrays in order.

    ``frame_number`` runs from ``first`` to ``frames``, and ``clock`` between the two numbers given. With ``cyclic`` the
    clock of the last frame is one step short of its end. All other options are those of ``render``; ``progress`` gets
    the part of the frames that are done. Frames are drawn one after the other where the scene may write files or
    ``time`` is set. Leaving the loop early cancels the frames that are being drawn, but not the token ``cancel``.
    """
    if frames < first:
        raise ValueError(f"the last frame, {frames}, is before the first, {first}")
    switches = render_options(depth=depth, **options)
    switches += [f"+KFI{first:d}", f"+KFF{frames:d}", f"+KI{clock[0]}", f"+KF{clock[1]}"]
    switches.append("+KC" if cyclic else "-KC")
    session = _session(scene, switches, depth=depth, name=name, cancel=cancel, is_series=True)
    numbers = session.frames or [None]
    workers = 1 if session.is_sequential else options.get("threads") or os.cpu_count() or 1
    return _frames(session, numbers, min(workers, len(numbers)), depth, progress)


def _frames(session, numbers, workers, depth, progress):
    """Draws frames side by side, at most one for each worker ahead of the one that is taken."""
    waiting, done, is_complete = collections.deque(), 0, False
    with ThreadPoolExecutor(workers, "povr-frame") as executor:
        try:
            for number in numbers:
                waiting.append(executor.submit(session.draw, number))
                if len(waiting) <= workers:
                    continue
                yield _array(_drawn(waiting.popleft().result), depth)
                done = _advance(done, len(numbers), progress)
            while waiting:
                yield _array(_drawn(waiting.popleft().result), depth)
                done = _advance(done, len(numbers), progress)
            is_complete = True
        finally:
            # Left early, by an exception or because no more frames are taken.
            if not is_complete:
                session.cancel()
                for future in waiting:
                    future.cancel()


def _advance(done, of, progress):
    if progress:
        progress((done + 1) / of)
    return done + 1


def check(scene, *, depth=8, name="scene", **options):
    """Reads a scene without drawing it. Returns its errors and warnings as a list of ``Finding``.

    Nothing is written. The options are those of ``render``.
    """
    return findings(_session(scene, render_options(depth=depth, **options), depth=depth, name=name).check())


def plan(scene, *, depth=8, name="scene", **options):
    """Reads and prepares a scene without drawing it. Returns a ``dict`` of its content.

    ``primitives`` counts the shapes of each kind; ``surfaces``, ``lights``, ``instances`` and so on are counts, and
    keys in ``_bytes`` are memory; ``left_out`` names features that no ray of the scene needs. The options are those of
    ``render``.
    """
    session = _session(scene, render_options(depth=depth, **options), depth=depth, name=name)
    try:
        reported, lowered = session.plan()
    except _povr.Refused as refused:
        raise scene_error(refused) from None
    warn(findings(reported))
    return json.loads(lowered)
