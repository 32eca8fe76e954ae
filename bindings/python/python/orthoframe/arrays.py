"""Relations and floors as arrays.

`numpy.asarray(array)` takes an `Array` without copying; who has no numpy reads it by `tolist()` or `memoryview()`.
"""

from __future__ import annotations

from typing import Any, NamedTuple


class Array:
    """Numbers in a block, as `numpy.asarray` takes them; they cannot be changed."""

    __slots__ = ("_bytes", "_kind", "shape")

    shape: tuple[int, ...]

    def __init__(self, data: bytes, kind: str, shape: list[int]) -> None:
        self._bytes, self._kind, self.shape = data, kind, tuple(shape)

    @property
    def __array_interface__(self) -> dict[str, Any]:
        return {"version": 3, "typestr": self._kind, "shape": self.shape, "data": self._bytes}

    def memoryview(self) -> memoryview[Any]:
        """All numbers one after the other, row by row."""
        numbers: memoryview[Any] = memoryview(self._bytes)
        return numbers.cast("d") if self._kind == "<f8" else numbers.cast("q")

    def tolist(self) -> list[Any]:
        """Lists in a list, as the shape says."""
        lists: list[Any] = self.memoryview().tolist()
        for width in self.shape[:0:-1]:
            if width == 0:
                return [[] for _ in range(self.shape[0])]
            lists = [lists[at : at + width] for at in range(0, len(lists), width)]
        return lists

    def __len__(self) -> int:
        return self.shape[0]

    def __repr__(self) -> str:
        return f"<orthoframe.Array {self._kind} {self.shape}>"


class Relation(NamedTuple):
    """A relation: a row a fact. Lengths are tenths of a millimetre, angles hundredths of a degree, shares thousandths."""

    name: str
    columns: list[str]
    #: Of each column whether its numbers are places in `names`.
    is_symbol: list[bool]
    names: list[str]
    #: (facts, columns), int64.
    rows: Array

    def tuples(self) -> list[tuple[Any, ...]]:
        """The facts with their names."""
        names = self.names
        return [
            tuple(names[value] if symbol else value for value, symbol in zip(row, self.is_symbol))
            for row in self.rows.tolist()
        ]


class Floor(NamedTuple):
    """The free floor of a map that the robot can cover, cut into convex Passframes."""

    map: str
    rooms: list[str]
    #: Of each Passframe the place of its room in `rooms`, int64.
    room: Array
    #: The corners of Passframe i are corners[offsets[i]:offsets[i + 1]], int64.
    offsets: Array
    #: (corners, 2), float64: cm in the map's frame, counter-clockwise.
    corners: Array
    #: (links, 2), int64: Passframes of one room, from the first of which the robot can drive straight into the second.
    links: Array

    def polygons(self) -> list[list[list[float]]]:
        """The corners of each Passframe."""
        corners, ends = self.corners.tolist(), self.offsets.tolist()
        return [corners[start:end] for start, end in zip(ends, ends[1:])]
