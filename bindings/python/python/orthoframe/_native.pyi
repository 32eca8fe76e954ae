"""Types of the compiled part. The shapes of the dicts are told in docs/cli.md."""

from collections.abc import Iterator, Sequence
from os import PathLike
from types import TracebackType
from typing import Any, Literal, final

from .arrays import Floor, Relation
from .vehicle import Vehicle

_Path = str | PathLike[str]
_Language = Literal["en", "ru"]

@final
class Engine:
    """The knowledge of one building: a store, and all that follows from its map. Any thread may call it."""

    @staticmethod
    def open(
        store: _Path, *, rules: _Path | None = None, language: _Language = "en", user: str = "python", read_only: bool = False
    ) -> Engine:
        """Opens the store in a directory, or makes one there."""

    @staticmethod
    def in_memory(map: _Path, *, rules: _Path | None = None, language: _Language = "en", user: str = "python") -> Engine:
        """A map of any format that can be imported, held in memory without a store."""

    def close(self) -> None:
        """Closes the store, for others to open. What is asked afterwards is an error."""

    def __enter__(self) -> Engine: ...
    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None, /
    ) -> None: ...
    def import_file(self, file: _Path, *, reason: str = "", pixel: float | None = None) -> dict[str, Any]:
        """Makes a building the map: a map file, one of docs/import.md, or a picture of so many cm a pixel."""

    def export_map(self) -> str:
        """The map as a map file, TOML."""

    @property
    def revision(self) -> int:
        """The number of the last change of the map; 0 for a map in memory."""

    def names(self) -> list[str]:
        """Every name of the map, in both languages."""

    def ask(self, question: str) -> dict[str, Any]:
        """Answers a question in English or Russian. No order is followed."""

    def dialogue(self) -> Dialogue:
        """Begins a dialogue."""

    def query(self, question: str, *, proofs: bool = False) -> dict[str, Any]:
        """Answers a question in the rules' language: `?- ON_TOP_OF(X, Y), CONTAINS("Kitchen", Y)`."""

    def relations(self, name: str | None = None, *, of: str | None = None) -> Any:
        """The facts of a relation, those about a thing, or both; how many there are of each relation without either."""

    def relation(self, name: str) -> Relation:
        """A relation as an array."""

    def floor(self, map: str | None = None) -> Floor:
        """The free floor of a map as arrays."""

    def why(self, relation: str, *of: str) -> dict[str, Any]:
        """Why a relation holds of these, down to what was measured; or what was missing."""

    def plan(self, text: str) -> dict[str, Any]:
        """What the robot would do if it were told so: its plans, and each step's way. Nothing is carried out."""

    def plan_scenario(self, file: _Path, *, time_limit: float | None = None) -> dict[str, Any]:
        """The plan of a scenario (.strips), with the facts of the map."""

    def route(self, start: str, goal: str) -> dict[str, Any]:
        """The shortest way between two places, rooms, doors or things, or "X,Y"."""

    def where(
        self, x: float | None = None, y: float | None = None, heading: float | None = None, *, map: str | None = None
    ) -> dict[str, Any]:
        """A pose in words; without one, that of the robot."""

    def find(self, name: str) -> dict[str, Any]:
        """Where a thing is believed to be, how surely, and since when."""

    def story(self, name: str) -> list[dict[str, Any]]:
        """All that is known of where a thing stood."""

    def observe(
        self,
        name: str,
        at: Sequence[float] | None = None,
        *,
        room: str | None = None,
        map: str | None = None,
        angle: float | None = None,
        sure: float = 0.9,
    ) -> dict[str, Any]:
        """Notes that a thing was seen somewhere, in the frame of its room or of a map; or that it was not there."""

    def proposals(self) -> list[dict[str, Any]]:
        """Things that are believed to stand elsewhere than the map says."""

    def confirm(self, name: str, *, reason: str = "confirm") -> dict[str, Any]:
        """Corrects the map: the thing does stand where it is believed to."""

    def reject(self, name: str, *, reason: str = "reject") -> None:
        """The map is right: what was seen of the thing until now counts no more."""

    def edit(self, edits: str | dict[str, Any], *, reason: str = "", dry_run: bool = False) -> dict[str, Any]:
        """Edits the map: one transaction, checked as a whole. A dict, or a text of edits (TOML)."""

    def history(self) -> list[dict[str, Any]]:
        """All revisions, the oldest first."""

    def diff(self, start: int, end: int | None = None) -> list[dict[str, Any]]:
        """What changed between two revisions; to the last without a second."""

    def undo(self, revision: int | None = None, *, reason: str = "") -> dict[str, Any]:
        """Takes back the last edit that stands, or a certain one."""

    def redo(self, *, reason: str = "") -> dict[str, Any]:
        """Brings back what the last undo took."""

    def as_of(self, revision: int) -> Engine:
        """The map as it stood at a revision, held in memory."""

    def draw(self, map: str | None = None, *, floor: bool = False) -> str:
        """A map drawn, as SVG."""

    def run(
        self, text: str, vehicle: Vehicle | str | None = None, *, silence: float = 10.0, poses: bool = False
    ) -> Task:
        """Has the robot do something: the simulated one, a `Vehicle`, or one elsewhere ("cmd:…", "tcp:HOST:PORT")."""

    def reset_robot(self) -> None:
        """Puts the robot back to the map's start, in a map as surveyed."""

@final
class Dialogue:
    """What was said so far, and what waits for an answer. The simulated robot carries out what is ordered."""

    def hear(self, text: str) -> list[dict[str, Any]]:
        """Hears a line, answers it, and does what it orders; a dict for all that came of it, in its order."""

@final
class Task:
    """An order under way, or done. Iterated, it tells what happens."""

    def __iter__(self) -> Iterator[dict[str, Any]]: ...
    def __next__(self) -> dict[str, Any]:
        """The next event; waits for it."""

    def cancel(self) -> None:
        """Stops the robot at once; may be called from any thread, and more than once."""

    @property
    def done(self) -> bool:
        """Whether it came to an end."""

    def result(self, timeout: float | None = None) -> dict[str, Any]:
        """What it came to; waits for so many seconds, for ever without a number."""

@final
class Link:
    """The vehicle's end of the conversation; `orthoframe.Vehicle` holds it."""

    def receive(self, timeout: float | None = None) -> str | None:
        """The next order, a line of JSON. An empty text where none came in time; None when the mission is over."""

    def send(self, line: str) -> bool:
        """Says a line of JSON; false when the mission is over."""
