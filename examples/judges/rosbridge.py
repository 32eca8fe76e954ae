"""examples/rosbridge.py, with a robot behind a websocket that speaks rosbridge's protocol: python3 rosbridge.py ORTHO."""

import json
import math
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

try:
    from websockets.exceptions import ConnectionClosed
    from websockets.sync.server import serve
except ImportError as missing:
    print(missing)
    sys.exit(77)

ORTHO = str(Path(sys.argv[1]).resolve())
STORE = str(Path(tempfile.mkdtemp()) / "store")


class Robot:
    def __init__(self, at):
        self.at, self.goal, self.is_silent, self.goals = list(at), None, False, 0
        self.server = serve(self.attend, "127.0.0.1", 0)
        self.url = "ws://127.0.0.1:%d" % self.server.socket.getsockname()[1]
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def attend(self, socket):
        try:
            self.serve(socket)
        except ConnectionClosed:
            pass

    def serve(self, socket):
        topics = set()

        def result(goal_id, status):
            socket.send(json.dumps({"op": "publish", "topic": "/move_base/result", "msg": {"status": {"goal_id": {"id": goal_id}, "status": status}}}))

        while True:
            try:
                said = json.loads(socket.recv(timeout=0.05))
                if said["op"] == "subscribe":
                    topics.add(said["topic"])
                elif said["op"] == "publish" and said["topic"] == "/move_base/goal":
                    pose = said["msg"]["goal"]["target_pose"]["pose"]
                    yaw = 2 * math.atan2(pose["orientation"]["z"], pose["orientation"]["w"])
                    self.goal = (said["msg"]["goal_id"]["id"], pose["position"]["x"], pose["position"]["y"], yaw)
                    self.goals += 1
                elif said["op"] == "publish" and self.goal:
                    result(self.goal[0], 2)
                    self.goal = None
            except TimeoutError:
                pass
            if self.goal:
                goal_id, x, y, yaw = self.goal
                gap = math.hypot(x - self.at[0], y - self.at[1])
                step = min(1.0, 0.05 / gap) if gap > 0 else 1.0
                self.at = [self.at[0] + (x - self.at[0]) * step, self.at[1] + (y - self.at[1]) * step, yaw]
                if step == 1.0:
                    self.goal = None
                    result(goal_id, 3)
            if "/amcl_pose" in topics and not self.is_silent:
                x, y, yaw = self.at
                pose = {"position": {"x": x, "y": y, "z": 0}, "orientation": {"x": 0, "y": 0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}}
                socket.send(json.dumps({"op": "publish", "topic": "/amcl_pose", "msg": {"pose": {"pose": pose, "covariance": [0] * 36}}}))


def begin(robot, *more):
    vehicle = f"cmd:python3 examples/rosbridge.py --map 'Квартира РБ-2' --url {robot.url} --silence 2 " + " ".join(more)
    arguments = [ORTHO, "--store", STORE, "--json", "do", "Поезжай к Точке-К", "--reset", "--vehicle", vehicle]
    return subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True)


subprocess.run([ORTHO, "--store", STORE, "import", "maps/rb2.toml"], check=True, capture_output=True)
robot = Robot((1.2, 0.85, math.pi / 2))
told, _ = (mission := begin(robot)).communicate(timeout=120)
task = json.loads(told.splitlines()[-1])
assert mission.returncode == 0 and task["outcome"] == "done", told[-2000:]
assert math.hypot(robot.at[0] * 100 - task["end"]["x"], robot.at[1] * 100 - task["end"]["y"]) < 1 and robot.goals > 2
print(f"rosbridge: {robot.goals} goals")
robot = Robot((1.2, 0.85, math.pi / 2))
mission = begin(robot)
while not robot.goals:
    time.sleep(0.05)
robot.is_silent = True
told, _ = mission.communicate(timeout=60)
task = json.loads(told.splitlines()[-1])
assert mission.returncode == 3 and task["outcome"] == "vehicle_failed" and "/amcl_pose" in task["explanation"], told[-2000:]
print(task["explanation"])
