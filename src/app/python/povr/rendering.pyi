from os import PathLike
from typing import Any, Callable, Iterable, Iterator, Literal, Mapping, NamedTuple, Optional, Union

from typing_extensions import TypedDict, Unpack

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

class _Options(TypedDict, total=False):
    width: int
    height: int
    antialias: Union[None, bool, float, Antialias]
    alpha: bool
    threads: Optional[int]
    version: Optional[float]
    include_path: _Folders
    declare: Optional[Mapping[str, float]]
    error: Optional[float]
    time: Optional[float]
    options: Union[str, Iterable[str]]
    allow_write: _Folders
    name: str

class _Still(_Options, total=False):
    clock: Optional[float]

class _Drawn(_Still, total=False):
    progress: _Progress
    cancel: Optional[CancelToken]

class _Frames(_Options, total=False):
    clock: tuple[float, float]
    progress: _Progress
    cancel: Optional[CancelToken]

def render(scene: _Source, *, depth: Literal[8, 16, 32] = 8, **options: Unpack[_Drawn]) -> numpy.ndarray: ...
def png(scene: _Source, *, depth: Literal[8, 16] = 8, **options: Unpack[_Drawn]) -> bytes: ...
def render_frames(
    scene: _Source,
    frames: int,
    *,
    first: int = 1,
    cyclic: bool = False,
    depth: Literal[8, 16, 32] = 8,
    **options: Unpack[_Frames],
) -> Iterator[numpy.ndarray]: ...
def check(scene: _Source, *, depth: Literal[8, 16, 32] = 8, **options: Unpack[_Still]) -> list[Finding]: ...
def plan(scene: _Source, *, depth: Literal[8, 16, 32] = 8, **options: Unpack[_Still]) -> dict[str, Any]: ...
