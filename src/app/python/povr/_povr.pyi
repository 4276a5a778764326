from typing import Any, Callable, Optional

class Refused(Exception): ...
class Cancelled(Exception): ...

class CancelToken:
    """A flag that cancels renders, from any thread."""

    def __init__(self) -> None: ...
    def cancel(self) -> None: ...
    @property
    def cancelled(self) -> bool: ...

class Drawn:
    data: bytearray
    shape: tuple[int, int, int]
    findings: str
    output: str
    statistics: str

class Session:
    frames: list[int]
    warnings: list[str]
    is_sequential: bool
    def __init__(
        self,
        switches: list[str],
        text: Optional[tuple[str, bytes]],
        objects: list[dict[str, Any]],
        depth: int,
        token: Optional[CancelToken],
        is_series: bool,
    ) -> None: ...
    def draw(
        self,
        frame: Optional[int] = None,
        is_file: bool = False,
        progress: Optional[Callable[[float], object]] = None,
    ) -> Drawn: ...
    def cancel(self) -> None: ...
    def check(self) -> str: ...
    def plan(self) -> tuple[str, str]: ...

def compare(expected: Any, actual: Any) -> list[tuple[str, float]]: ...
def curve(arguments: list[str], token: Optional[CancelToken]) -> str: ...
def run(arguments: list[str], start: Optional[str], code: str) -> int: ...
