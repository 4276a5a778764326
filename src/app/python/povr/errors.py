"""Errors and warnings about scenes."""

import json
import sys
import warnings
from typing import NamedTuple, Optional


class Finding(NamedTuple):
    """An error or warning about a scene."""

    severity: str
    """``"error"`` or ``"warning"``."""
    message: str
    """The message, in one line."""
    file: Optional[str]
    """The file, or the name of the text; ``None`` for a finding about no place."""
    line: Optional[int]
    """The line, from 1."""
    column: Optional[int]
    """The column in characters, from 1."""
    help: str
    """Remedies, as sentences; may be empty."""
    code: Optional[str]
    """The category for programs: ``"undeclared"``, ``"missing-file"``, ...; ``None`` without one."""
    excerpt: str
    """The message with the lines of the scene and the remedies, as povr prints it."""

    def __str__(self):
        place = f"{self.file}:{self.line}:{self.column}: " if self.file else ""
        remedy = f" ({self.help})" if self.help else ""
        return f"{place}{self.severity}: {self.message}{remedy}"


class SceneError(ValueError):
    """A scene that cannot be drawn.

    ``errors`` has all errors of the run; ``file``, ``line``, ``column``, ``message`` and ``help`` are those of the
    first.
    """

    def __init__(self, errors):
        super().__init__("\n".join(error.excerpt.rstrip() for error in errors))
        self.errors = list(errors)

    def __reduce__(self):
        return SceneError, (self.errors,)

    file = property(lambda self: self.errors[0].file, doc="The file, or the name of the text.")
    line = property(lambda self: self.errors[0].line, doc="The line, from 1.")
    column = property(lambda self: self.errors[0].column, doc="The column in characters, from 1.")
    message = property(lambda self: self.errors[0].message, doc="The message, in one line.")
    help = property(lambda self: self.errors[0].help, doc="Remedies, as sentences.")


class SceneWarning(UserWarning):
    """A warning about a scene, or about an option."""


def findings(text):
    """The findings of their JSON form."""
    return [
        Finding(
            severity=one["severity"],
            message=one["message"],
            file=one.get("file"),
            line=one.get("line"),
            column=one.get("column"),
            help=" ".join(one["hints"]),
            code=one.get("code"),
            excerpt=one["excerpt"],
        )
        for one in json.loads(text)
    ]


def scene_error(refused):
    """The ``SceneError`` of an exception of the compiled module."""
    return SceneError([one for one in findings(refused.args[0]) if one.severity == "error"])


def warn(messages):
    """Issues warnings at the line outside of this package that called it."""
    depth, frame = 1, sys._getframe(0)
    while frame and frame.f_globals.get("__name__", "").partition(".")[0] == "povr":
        depth, frame = depth + 1, frame.f_back
    for message in messages:
        warnings.warn(str(message), SceneWarning, stacklevel=depth)
