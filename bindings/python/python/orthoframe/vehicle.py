"""A robot driven from Python: a class with the methods of a vehicle (docs/vehicle.md).

    class Cart(orthoframe.Vehicle):
        name = "cart"

        def pose(self):
            return ("My flat", self.x, self.y, self.heading)

        def follow(self, path, heading, speed):
            for x, y in path:
                while not self.motors.step_towards(x, y):
                    self.going()

    engine.run("Bring the medicine", vehicle=Cart())

Its methods run on one thread of their own, an order at a time.
"""

from __future__ import annotations

import json
import threading
import time
import traceback
from collections import deque
from collections.abc import Sequence
from typing import Any

PROTOCOL = 1


class Stopped(Exception):
    """The order under way was cancelled: `going` raises it; a method that stops by itself may as well."""


class Bumped(Exception):
    """Something stands in the way, and the robot stopped just before it: {"door": name}, {"thing": name}, {"wall": room}
    or "unknown"."""

    def __init__(self, against: Any = "unknown") -> None:
        super().__init__(against)
        self.against = against


class Refused(Exception):
    """The robot would not or could not, and all is as before: {"locked": {"door": name}} and the like (docs/vehicle.md)."""

    def __init__(self, why: dict[str, Any]) -> None:
        super().__init__(why)
        self.why = why


class _Over(BaseException):
    """The mission has gone."""


class Vehicle:
    """What a mission asks of a robot. `pose` and `follow` must be written; of the other orders those that the robot can do.

    A method that returns has done what was asked. While it is at work it calls `going`, once a second or more often:
    that tells where the robot is, and raises `Stopped` when the order is cancelled.
    """

    #: What people call it.
    name = "robot"
    #: Whether `pose` is what the wheels count in a frame of their own; it must then `scan`.
    odometry = False

    _link: Any = None
    _thread: threading.Thread | None = None
    _order = 0
    _told: float = 0.0

    def pose(self) -> tuple[str, float, float, float]:
        """Where it stands: the map's name, x and y in cm, heading in degrees."""
        raise NotImplementedError("a vehicle says where it stands: write pose()")

    def time(self) -> float:
        """Its clock, seconds, which never goes back."""
        return time.monotonic()

    def follow(self, path: list[tuple[float, float]], heading: float | None, speed: float | None) -> None:
        """Drive along the path from where it stands, turning on the spot at each corner, and face `heading` in the end."""
        raise NotImplementedError("a vehicle drives: write follow()")

    def _cannot(self, order: str) -> NotImplementedError:
        return NotImplementedError(f"{type(self).__name__} has no method {order}()")

    def set_door(self, door: str, status: str, opening: float) -> None:
        """Make the door at which it stands "open" (so many per cent), "closed" or "locked"."""
        raise self._cannot("set_door")

    def call_lift(self, door: str | None) -> None:
        """Call a lift to this door and wait until it is open."""
        raise self._cannot("call_lift")

    def ride(self, lift: str, start: str, to: str, rise: float, door: str | None, arrival: dict[str, Any]) -> None:
        """Ride until the door is open at the other stop; `pose` is then `arrival`."""
        raise self._cannot("ride")

    def set_open(self, thing: str, open: bool) -> None:
        """Open or shut the doors, lid or drawer of a thing."""
        raise Refused({"shut": {"thing": thing}})

    def push(self, thing: str, place: dict[str, Any]) -> None:
        """Push a thing over the floor to a place: area, x, y, z, angle."""
        raise Refused({"stays": {"thing": thing}})

    def take(self, thing: str) -> None:
        """Take a thing into the hand."""
        raise self._cannot("take")

    def put(self, thing: str, place: dict[str, Any]) -> None:
        """Put down what the hand holds: area, x, y, z, angle."""
        raise self._cannot("put")

    def hand_over(self, thing: str) -> None:
        """Give it to the person who stands by."""
        raise self._cannot("hand_over")

    def take_back(self, thing: str) -> None:
        """Take it from the person who stands by."""
        raise self._cannot("take_back")

    def switch(self, device: str, on: bool) -> None:
        """Switch a device."""
        raise self._cannot("switch")

    def call(self, person: str) -> None:
        """Call a person."""
        raise self._cannot("call")

    def look_round(self) -> None:
        """Turn round once, looking."""

    def sees(self, thing: str) -> dict[str, Any] | None:
        """Where the thing is, if it is in view: {"thing": {"thing": name, "place": {…}}}."""
        return None

    def look_at(self, what: Any) -> dict[str, Any] | None:
        """What there is to see of it: {"door": {"door", "status", "opening"}}, {"thing": {"thing", "place"}}."""
        return None

    # What these methods call.

    def going(self) -> None:
        """Tells where it is; raises `Stopped` when what is under way was cancelled."""
        self._say({"say": "going"})
        if self.is_cancelled:
            raise Stopped

    def saw(self, sighting: dict[str, Any]) -> None:
        """Tells what was seen on the way, as `look_at` would."""
        self._say({"say": "saw", "sighting": sighting})

    def scan(self, height: float, start: float, step: float, ranges: Sequence[float | None]) -> None:
        """Tells one turn of a range finder at this pose; cm and degrees, None where nothing was met."""
        self._say({"say": "scan", "height": height, "from": start, "step": step, "ranges": list(ranges)})

    @property
    def is_cancelled(self) -> bool:
        """Whether the order under way was cancelled."""
        self._read(0.0)
        return self._order in self._cancelled

    # The conversation.

    def _say(self, message: dict[str, Any]) -> None:
        map_name, x, y, heading = self.pose()
        at = {"map": map_name, "x": x, "y": y, "heading": heading % 360.0}
        # A clock of the machine may begin anywhere.
        self._told = max(self._told, self.time())
        whole = {"id": self._order, "time": self._told, "at": at, **message}
        if not self._link.send(json.dumps(whole, default=float)):
            raise _Over

    def _read(self, timeout: float | None) -> None:
        while line := self._link.receive(timeout):
            order = json.loads(line)
            if order["do"] == "cancel":
                self._cancelled.add(order["order"])
            else:
                self._orders.append(order)
            timeout = 0.0
        if line is None:
            self._is_over = True

    def _next(self) -> dict[str, Any] | None:
        while not self._orders:
            if self._is_over:
                return None
            self._read(None)
        return self._orders.popleft()

    def _carry_out(self, order: dict[str, Any]) -> dict[str, Any]:
        do = order.pop("do")
        if do == "hello":
            return {"say": "ready", "protocol": PROTOCOL, "name": self.name, "odometry": self.odometry}
        if do == "report":
            return {"say": "done"}
        if do == "follow":
            path = [(x, y) for x, y in order["path"]]
            self.follow(path, order.get("heading"), order.get("speed"))
            return {"say": "done"}
        if do == "ride":
            order["start"] = order.pop("from")
        seen = getattr(self, do)(**order)
        return {"say": "seen", "sighting": seen} if do in ("sees", "look_at") else {"say": "done"}

    def _serve(self, link: Any) -> None:
        self._link, self._is_over, self._told = link, False, 0.0
        self._orders: deque[dict[str, Any]] = deque()
        self._cancelled: set[int] = set()
        try:
            while (order := self._next()) is not None:
                self._order = order.pop("id")
                try:
                    ending = self._carry_out(order)
                except Stopped:
                    ending = {"say": "stopped"}
                except Bumped as bump:
                    ending = {"say": "bumped", "against": bump.against}
                except Refused as no:
                    ending = {"say": "refused", "why": no.why}
                except Exception as error:
                    traceback.print_exc()
                    text = f"{type(error).__name__}: {error}"
                    ending = {"say": "failed", "text": text}
                self._say(ending)
        except _Over:
            pass
        except Exception as error:
            # pose() or time() itself: the mission learns why, at a place that says nothing.
            traceback.print_exc()
            at = {"map": "", "x": 0.0, "y": 0.0, "heading": 0.0}
            text = f"{type(error).__name__}: {error}"
            whole = {"id": self._order, "time": self._told, "at": at, "say": "failed", "text": text}
            link.send(json.dumps(whole))
        finally:
            self._link = None


def ready(vehicle: Vehicle) -> None:
    """Refuses what cannot drive: no vehicle, or one that drives already."""
    if not isinstance(vehicle, Vehicle):
        raise TypeError(f"a vehicle is an orthoframe.Vehicle or an address, not {type(vehicle).__name__}")
    if vehicle._thread is not None:
        # The mission before may just have ended.
        vehicle._thread.join(2.0)
        if vehicle._thread.is_alive():
            raise RuntimeError("this vehicle drives already")


def begin(vehicle: Vehicle, link: Any) -> None:
    """Has a vehicle speak with a mission, on a thread of its own."""
    vehicle._thread = threading.Thread(target=vehicle._serve, args=(link,), name="orthoframe vehicle", daemon=True)
    vehicle._thread.start()
