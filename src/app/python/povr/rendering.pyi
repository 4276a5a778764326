from os import PathLike
from typing import Any, Callable, Iterable, Iterator, Literal, Mapping, NamedTuple, Optional, Union

import numpy

from ._povr import CancelToken
from .elements import Scene
from .errors import Finding

_Source = Union[str, bytes, PathLike[str], Scene]
_Folders = Union[str, PathLike[str], Iterable[Union[str, PathLike[str]]]]
_Progress = Optional[Callable[[float], object]]

class Antialias(NamedTuple):
    threshold: float = 0.3
    method: int = 1
    depth: int = 3
    jitter: float = 1.0

def render(
    scene: _Source,
    *,
    width: int = 800,
    height: int = 600,
    antialias: Union[None, bool, float, Antialias] = None,
    alpha: bool = False,
    depth: Literal[8, 16, 32] = 8,
    threads: Optional[int] = None,
    version: Optional[float] = None,
    include_path: _Folders = (),
    declare: Optional[Mapping[str, float]] = None,
    clock: Optional[float] = None,
    error: Optional[float] = None,
    time: Optional[float] = None,
    options: Union[str, Iterable[str]] = (),
    allow_write: _Folders = (),
    name: str = "scene",
    progress: _Progress = None,
    cancel: Optional[CancelToken] = None,
) -> numpy.ndarray: ...
def png(
    scene: _Source,
    *,
    width: int = 800,
    height: int = 600,
    antialias: Union[None, bool, float, Antialias] = None,
    alpha: bool = False,
    depth: Literal[8, 16] = 8,
    threads: Optional[int] = None,
    version: Optional[float] = None,
    include_path: _Folders = (),
    declare: Optional[Mapping[str, float]] = None,
    clock: Optional[float] = None,
    error: Optional[float] = None,
    time: Optional[float] = None,
    options: Union[str, Iterable[str]] = (),
    allow_write: _Folders = (),
    name: str = "scene",
    progress: _Progress = None,
    cancel: Optional[CancelToken] = None,
) -> bytes: ...
def render_frames(
    scene: _Source,
    frames: int,
    *,
    first: int = 1,
    cyclic: bool = False,
    width: int = 800,
    height: int = 600,
    antialias: Union[None, bool, float, Antialias] = None,
    alpha: bool = False,
    depth: Literal[8, 16, 32] = 8,
    threads: Optional[int] = None,
    version: Optional[float] = None,
    include_path: _Folders = (),
    declare: Optional[Mapping[str, float]] = None,
    clock: tuple[float, float] = (0.0, 1.0),
    error: Optional[float] = None,
    time: Optional[float] = None,
    options: Union[str, Iterable[str]] = (),
    allow_write: _Folders = (),
    name: str = "scene",
    progress: _Progress = None,
    cancel: Optional[CancelToken] = None,
) -> Iterator[numpy.ndarray]: ...
def check(
    scene: _Source,
    *,
    width: int = 800,
    height: int = 600,
    antialias: Union[None, bool, float, Antialias] = None,
    alpha: bool = False,
    depth: Literal[8, 16, 32] = 8,
    threads: Optional[int] = None,
    version: Optional[float] = None,
    include_path: _Folders = (),
    declare: Optional[Mapping[str, float]] = None,
    clock: Optional[float] = None,
    error: Optional[float] = None,
    time: Optional[float] = None,
    options: Union[str, Iterable[str]] = (),
    allow_write: _Folders = (),
    name: str = "scene",
) -> list[Finding]: ...
def plan(
    scene: _Source,
    *,
    width: int = 800,
    height: int = 600,
    antialias: Union[None, bool, float, Antialias] = None,
    alpha: bool = False,
    depth: Literal[8, 16, 32] = 8,
    threads: Optional[int] = None,
    version: Optional[float] = None,
    include_path: _Folders = (),
    declare: Optional[Mapping[str, float]] = None,
    clock: Optional[float] = None,
    error: Optional[float] = None,
    time: Optional[float] = None,
    options: Union[str, Iterable[str]] = (),
    allow_write: _Folders = (),
    name: str = "scene",
) -> dict[str, Any]: ...
