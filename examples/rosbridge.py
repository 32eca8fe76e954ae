#!/usr/bin/env python3
"""A robot of ROS 1, or of any ROS behind rosbridge, as a vehicle of orthoframe (docs/vehicle.md): move_base drives it.

    pip install websockets
    ortho do "Поезжай к Точке-К" --vehicle "cmd:python3 examples/rosbridge.py --map 'Квартира РБ-2' --url ws://robot:9090"

Where it is a topic says (a Pose, PoseStamped or PoseWithCovarianceStamped in the frame of the map that was exported); every
corner of a route is a goal of its own. Silence of the robot ends the mission with what was silent.
"""

import argparse
import contextlib
import json
import math
import queue
import sys
import threading
import time
import uuid

from websockets.sync.client import connect

SUCCEEDED, PREEMPTED = 3, 2


class Lost(Exception):
    """The robot is of no more use."""


class Stopped(Exception):
    """The order under way was cancelled."""


class Robot:
    def __init__(self, args):
        self.args, self.pose, self.heard, self.results = args, None, 0.0, {}
        try:
            # It is open until the program ends.
            self.socket = contextlib.ExitStack().enter_context(connect(args.url, open_timeout=args.silence, max_size=None))
        except (OSError, TimeoutError) as error:
            raise Lost(f"rosbridge at {args.url}: {error}") from error
        self.send(op="subscribe", topic=args.pose, throttle_rate=50)
        self.send(op="subscribe", topic="/move_base/result")
        self.send(op="advertise", topic="/move_base/goal", type="move_base_msgs/MoveBaseActionGoal")
        self.send(op="advertise", topic="/move_base/cancel", type="actionlib_msgs/GoalID")
        threading.Thread(target=self.listen, daemon=True).start()

    def send(self, **said):
        self.socket.send(json.dumps(said))

    def listen(self):
        try:
            for text in self.socket:
                told = json.loads(text)
                message = told.get("msg", {})
                if told.get("topic") == self.args.pose:
                    while "position" not in message:
                        message = message["pose"]
                    self.pose, self.heard = message, time.monotonic()
                elif told.get("topic") == "/move_base/result":
                    status = message["status"]
                    self.results[status["goal_id"]["id"]] = status["status"]
        except Exception:  # whatever it was, nothing more is heard, and `at` says so
            pass

    def at(self):
        silent = time.monotonic() - self.heard
        if self.pose is None or silent > self.args.silence:
            raise Lost(f"nothing on {self.args.pose} for {min(silent, 1e4):.1f} s")
        place, turn = self.pose["position"], self.pose["orientation"]
        heading = 2 * math.degrees(math.atan2(turn["z"], turn["w"]))
        return {"map": self.args.map, "x": place["x"] * 100, "y": place["y"] * 100, "heading": heading % 360}

    def hello(self, order, going):
        end = time.monotonic() + self.args.silence
        while self.pose is None and time.monotonic() < end:
            time.sleep(0.05)
        return {"say": "ready", "protocol": 1, "name": "rosbridge"}

    def follow(self, order, going):
        here, points = self.at(), order["path"]
        at = (here["x"], here["y"])
        for no, (x, y) in enumerate(points):
            heading = math.degrees(math.atan2(y - at[1], x - at[0])) if math.dist(at, (x, y)) > 0.1 else here["heading"]
            if no + 1 < len(points):
                heading = math.degrees(math.atan2(points[no + 1][1] - y, points[no + 1][0] - x))
            elif order.get("heading") is not None:
                heading = order["heading"]
            status = self.drive(x / 100, y / 100, math.radians(heading), going)
            if status == PREEMPTED:
                return {"say": "stopped"}
            if status != SUCCEEDED:
                raise Lost(f"move_base ended with status {status}")
            at = (x, y)
        return {"say": "done"}

    def drive(self, x, y, yaw, going):
        goal_id = uuid.uuid4().hex
        turn = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
        target = {"header": {"frame_id": self.args.frame}, "pose": {"position": {"x": x, "y": y, "z": 0.0}, "orientation": turn}}
        self.send(op="publish", topic="/move_base/goal", msg={"goal_id": {"id": goal_id}, "goal": {"target_pose": target}})
        is_stopped = None
        while goal_id not in self.results:
            time.sleep(0.2)
            try:
                going()
            except Stopped:
                if is_stopped is None:
                    is_stopped = time.monotonic()
                    self.send(op="publish", topic="/move_base/cancel", msg={"id": goal_id})
                if time.monotonic() - is_stopped > self.args.silence:
                    raise Lost("move_base was to stop and has not") from None
            except Lost:
                self.send(op="publish", topic="/move_base/cancel", msg={"id": goal_id})
                raise
        return self.results[goal_id]

    def done(self, order, going):
        return {"say": "done"}

    def look(self, order, going):
        # It names nothing of what it sees.
        return {"say": "seen", "sighting": None}

    report = look_round = done
    sees = look_at = look


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--map", required=True, help="the name of the map on which it drives")
    parser.add_argument("--url", default="ws://localhost:9090", help="of rosbridge")
    parser.add_argument("--pose", default="/amcl_pose", help="the topic that says where it is")
    parser.add_argument("--frame", default="map")
    parser.add_argument("--silence", type=float, default=5.0, help="seconds that it may say nothing")
    args = parser.parse_args()
    orders, cancelled = queue.Queue(), set()

    def read():
        for line in sys.stdin.buffer:
            order = json.loads(line)
            cancelled.add(order["order"]) if order["do"] == "cancel" else orders.put(order)
        orders.put(None)

    threading.Thread(target=read, daemon=True).start()
    robot, begun = None, time.monotonic()
    while (order := orders.get()) is not None:

        def say(message, at=None):
            whole = {"id": order["id"], "time": time.monotonic() - begun, "at": at or robot.at(), **message}
            sys.stdout.buffer.write(json.dumps(whole, ensure_ascii=False).encode() + b"\n")
            sys.stdout.buffer.flush()

        def going():
            say({"say": "going"})
            if order["id"] in cancelled:
                raise Stopped

        try:
            robot = robot or Robot(args)
            obey = getattr(robot, order["do"], None)
            if obey is None:
                raise Lost(f"a robot that only drives cannot {order['do']}")
            say(obey(order, going))
        except Lost as lost:
            say({"say": "failed", "text": str(lost)}, {"map": args.map, "x": 0, "y": 0, "heading": 0})


if __name__ == "__main__":
    main()
