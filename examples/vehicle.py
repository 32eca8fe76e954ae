#!/usr/bin/env python3
"""A robot that speaks orthoframe's vehicle protocol (docs/vehicle.md), with the standard library alone.

It is a disc that goes exactly where it is sent, meets nothing, and whose hand and doors never fail:

    ortho do "Принеси лекарство" --vehicle "cmd:python3 examples/vehicle.py --map 'Квартира РБ-2' --at 120,85,90"

Replace `Disc` by the driver of a real robot: each method returns what is said in the end, and `going` tells of the way.
"""

import argparse
import json
import math
import queue
import sys
import threading
import time

PROTOCOL = 1
STEP = 0.5  # seconds between two messages of the way


class Stopped(Exception):
    """The order under way was cancelled."""


class Disc:
    speed = 50.0  # cm a second
    turn_rate = 90.0  # degrees a second

    def __init__(self, name_of_map, x, y, heading, pace):
        self.map, self.x, self.y, self.heading = name_of_map, x, y, heading
        self.time, self.pace = 0.0, pace

    def at(self):
        return {"map": self.map, "x": self.x, "y": self.y, "heading": self.heading % 360.0}

    def spend(self, seconds, going):
        """Time passes; None ends a motion that was cancelled."""
        self.time += seconds
        if self.pace:
            time.sleep(seconds / self.pace)
        going()

    def move(self, seconds, to, going):
        start, begun = (self.x, self.y, self.heading), self.time
        steps = max(1, math.ceil(seconds / STEP))
        for step in range(1, steps + 1):
            share = step / steps
            self.x, self.y, self.heading = (a + (b - a) * share for a, b in zip(start, to))
            self.spend(begun + seconds * share - self.time, going)

    def turn(self, heading, going):
        angle = (heading - self.heading + 180.0) % 360.0 - 180.0
        to = (self.x, self.y, self.heading + angle)
        self.move(abs(angle) / self.turn_rate, to, going)

    def follow(self, order, going):
        for x, y in order["path"]:
            way = math.hypot(x - self.x, y - self.y)
            if way < 1e-6:
                continue
            self.turn(math.degrees(math.atan2(y - self.y, x - self.x)), going)
            self.move(way / self.speed, (x, y, self.heading), going)
        if order.get("heading") is not None:
            self.turn(order["heading"], going)
        return {"say": "done"}

    def ride(self, order, going):
        self.spend(10.0, going)
        there = order["arrival"]
        self.map, self.x, self.y, self.heading = (there[k] for k in ("map", "x", "y", "heading"))
        return {"say": "done"}

    def obey(self, order, going):
        self.spend(3.0, going)
        return {"say": "done"}

    def report(self, order, going):
        return {"say": "done"}

    def look(self, order, going):
        # It has no eyes: nothing is in view.
        return {"say": "seen", "sighting": None}

    def hello(self, order, going):
        return {"say": "ready", "protocol": PROTOCOL, "name": "disc of examples/vehicle.py"}

    set_door = call_lift = take = put = hand_over = take_back = switch = call = look_round = obey
    sees = look_at = look


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--map", required=True, help="the name of the map on which it stands")
    parser.add_argument("--at", required=True, help="X,Y,HEADING in cm and degrees")
    parser.add_argument("--pace", type=float, default=0.0, help="so many times as fast as the clock; at once when 0")
    args = parser.parse_args()
    robot = Disc(args.map, *(float(number) for number in args.at.split(",")), args.pace)
    orders, cancelled = queue.Queue(), set()

    def read():
        """Beside what is under way, so that it can be cancelled."""
        for line in sys.stdin.buffer:
            order = json.loads(line)
            if order["do"] == "cancel":
                cancelled.add(order["order"])
            else:
                orders.put(order)
        orders.put(None)

    threading.Thread(target=read, daemon=True).start()
    while (order := orders.get()) is not None:
        number = order["id"]

        def say(message):
            whole = {"id": number, "time": robot.time, "at": robot.at(), **message}
            sys.stdout.buffer.write(json.dumps(whole, ensure_ascii=False).encode() + b"\n")
            sys.stdout.buffer.flush()

        def going():
            if number in cancelled:
                raise Stopped
            say({"say": "going"})

        try:
            ending = getattr(robot, order["do"])(order, going)
        except Stopped:
            ending = {"say": "stopped"}
        say(ending)


if __name__ == "__main__":
    main()
