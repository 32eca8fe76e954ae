"""What goes wrong."""

from __future__ import annotations

from typing import Any, NamedTuple


class Fault(NamedTuple):
    """One fault: what it is, how it is mended, and where it stands. Lines and columns count from 1, columns in characters."""

    message: str
    code: str | None = None
    help: str | None = None
    file: str | None = None
    line: int | None = None
    column: int | None = None

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part is not None)
        told = f"{place}: {self.message}" if place else self.message
        return f"{told} ({self.help})" if self.help else told


class Error(Exception):
    """Why a call failed. `faults` has each fault with its place; of one, its fields are here as well."""

    faults: list[Fault]

    def __init__(self, message: str, faults: list[dict[str, Any]] = []) -> None:
        self.message = message
        self.faults = [Fault._make(fault.get(name) for name in Fault._fields) for fault in faults]
        # One fault may be told in the names of the map.
        if len(self.faults) == 1:
            self.faults = [self.faults[0]._replace(message=message)]
        super().__init__(message, faults)

    @property
    def _first(self) -> Fault:
        return self.faults[0] if self.faults else Fault(self.message)

    @property
    def code(self) -> str | None:
        """A stable word for programs, such as `map::unknown_reference`."""
        return self._first.code

    @property
    def help(self) -> str | None:
        return self._first.help

    @property
    def file(self) -> str | None:
        return self._first.file

    @property
    def line(self) -> int | None:
        return self._first.line

    @property
    def column(self) -> int | None:
        return self._first.column

    def __str__(self) -> str:
        if not self.faults:
            return self.message
        if len(self.faults) == 1:
            return str(self.faults[0])
        return "\n".join([self.message, *(f"  {fault}" for fault in self.faults)])


class InputError(Error, ValueError):
    """What was given is wrong: a file, a name, an edit, a question. The same call will fail again."""


class MachineError(Error):
    """The disk, the robot or the program is at fault."""
