"""Errors and warnings: the same texts as those of the programs."""

from __future__ import annotations


class Error(Exception):
    """What `sward` tells with an exit code.

    kind: "usage", "io", "input", "runtime", "unsupported", "difference" or "interrupted".
    exit_code: that of the program: 1, 2, 3, 4, 5, 7 or 130.
    """

    kind: str
    exit_code: int

    def __init__(self, message: str, kind: str = "usage", exit_code: int = 1) -> None:
        super().__init__(message)
        self.kind = kind
        self.exit_code = exit_code

    def __reduce__(self):
        return type(self), (str(self), self.kind, self.exit_code)


class Warning(UserWarning):
    """Something imperfect but usable was read or baked; the program writes the same line to stderr."""
