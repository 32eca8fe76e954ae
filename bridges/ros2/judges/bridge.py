"""Missions through the bridge, with a robot on another make's DDS: python3 bridge.py ORTHO ORTHO_ROS2, in the repository's root."""

import json
import math
import os
import subprocess
import sys
import tempfile
import time
import uuid
from pathlib import Path

try:
    import numpy
    import peer
except ImportError as missing:
    print(missing)
    sys.exit(77)

ORTHO, BRIDGE = (str(Path(path).resolve()) for path in sys.argv[1:3])
HERE = Path(tempfile.mkdtemp())
STORE = str(HERE / "store")
# A domain of its own, so that other robots of the house are left alone.
DOMAIN = 40 + os.getpid() % 60
START = (1.20, 0.85, math.pi / 2)
MAP = "Квартира РБ-2"


def vehicle(*more):
    wire = f"--domain {DOMAIN} --rmw cyclonedds"
    return f"cmd:{BRIDGE} vehicle {wire} --map '{MAP}' " + " ".join(more)


def ortho(*arguments, code=0, timeout=240):
    done = subprocess.run([ORTHO, "--store", STORE, *arguments], capture_output=True, text=True, timeout=timeout)
    assert done.returncode == code, (arguments, done.returncode, done.stdout[-700:], done.stderr[-700:])
    return done


def drive(order, *more, code=0):
    told = ortho("--json", "do", order, "--reset", "--vehicle", vehicle("--silence 3", *more), code=code)
    return json.loads(told.stdout.splitlines()[-1]), told


def until(what, seconds, said):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = what()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(said)


SPREAD = {(0, 0): 0.02, (1, 1): 0.03, (0, 1): 0.01, (5, 5): 0.0009, (1, 5): 0.001}


def spread_after(end, draws=40_000):
    """The covariance of where a robot comes to that set out from somewhere within SPREAD, by trying: what it holds to have gone it has gone, turned by as much as its heading was wrong."""
    rows = numpy.array(peer.rows_of(SPREAD)).reshape(6, 6)[numpy.ix_((0, 1, 5), (0, 1, 5))]
    off = numpy.random.default_rng(1).multivariate_normal((0, 0, 0), rows, draws)
    dx, dy = end[0] - START[0], end[1] - START[1]
    sin, cos = numpy.sin(off[:, 2]), numpy.cos(off[:, 2])
    return numpy.cov([off[:, 0] + cos * dx - sin * dy, off[:, 1] + sin * dx + cos * dy, off[:, 2]])


def a_mission_drives_by_nav2(more=(), action="follow_path", spread=None):
    robot = peer.Robot(DOMAIN, START, offset=(0.3, -0.2, 0.4), spread=spread)
    looker = peer.Node(DOMAIN)
    paths = looker.reader("rt/orthoframe/path", peer.Path, peer.LATCHED)
    poses = looker.reader("rt/orthoframe/pose", peer.PoseWithCovarianceStamped)
    try:
        task, _ = drive("Поезжай к Точке-К", *more)
        assert task["outcome"] == "done", task
        end = task["end"]
        assert math.hypot(robot.at[0] * 100 - end["x"], robot.at[1] * 100 - end["y"]) < 1, (robot.at, end)
        assert robot.driven and {name for name, _ in robot.driven} == {action}, robot.driven
        heard = paths.take(100)
        assert len(heard) >= 3 and all(len(path.poses) >= 2 for path in heard), heard
        places = poses.take(1000)
        assert places and all(place.header.frame_id == "map" for place in places)
        for place in places:
            told = numpy.array(place.pose.covariance).reshape(6, 6)
            assert not told[2:5].any() and not told[:, 2:5].any(), told
            told = told[numpy.ix_((0, 1, 5), (0, 1, 5))]
            if spread:
                at = place.pose.pose.position
                assert numpy.allclose(told, spread_after((at.x, at.y)), rtol=0.05, atol=0.0015), (at, told)
            else:
                assert told[0, 0] >= 1e6 and told[1, 1] >= 1e6 and told[2, 2] > 3, told
        return len(robot.driven)
    finally:
        robot.close()


def a_stop_reaches_the_robot():
    robot = peer.Robot(DOMAIN, START, speed=0.05)
    try:
        arguments = [ORTHO, "--store", STORE, "--json", "do", "Поезжай к Точке-К", "--reset", "--vehicle", vehicle()]
        mission = subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True)
        until(lambda: robot.goal, 60, "it never set out")
        time.sleep(1)
        mission.terminate()
        told, _ = mission.communicate(timeout=30)
        assert mission.returncode == 130 and json.loads(told.splitlines()[-1])["outcome"] == "stopped", told
        assert robot.goal is None and robot.canceled >= 1
    finally:
        robot.close()


def a_peer_that_is_lost_ends_the_mission(how, said):
    robot = peer.Robot(DOMAIN, START, speed=0.1)
    try:
        arguments = [ORTHO, "--store", STORE, "--json", "do", "Поезжай к Точке-К", "--reset", "--vehicle", vehicle("--silence 2")]
        mission = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        until(lambda: robot.goal, 60, "it never set out")
        time.sleep(0.5)
        how(robot)
        told, faults = mission.communicate(timeout=60)
        task = json.loads(told.splitlines()[-1])
        assert mission.returncode == 3 and task["outcome"] == "vehicle_failed", (mission.returncode, told[-2000:], faults)
        assert said in task["explanation"], (said, task["explanation"])
        return task["explanation"]
    finally:
        robot.close()


def nobody_is_there():
    told, _ = drive("Поезжай к Точке-К", code=3)
    fault = told["errors"][0]
    assert fault["code"] == "vehicle::own_fault" and "base_link" in fault["message"], told
    return fault["message"]


def questions_and_orders_are_heard():
    robot = peer.Robot(DOMAIN, START, speed=2.0)
    arguments = [BRIDGE, "node", "--domain", str(DOMAIN), "--rmw", "cyclonedds", "--ortho", ORTHO, "--store", STORE, "--vehicle", vehicle()]
    node = subprocess.Popen(arguments, env={**os.environ, "ORTHO_LANG": "ru"})
    me = peer.Node(DOMAIN)
    try:
        grids = me.reader("rt/map", peer.OccupancyGrid, peer.LATCHED)
        grid = until(lambda: grids.take(1), 60, "no /map")[0]
        assert len(grid.data) == grid.info.width * grid.info.height and {0, 100} <= set(grid.data) <= {-1, 0, 100}
        column, row = (int((at - low) / grid.info.resolution) for at, low in zip(START, (grid.info.origin.position.x, grid.info.origin.position.y)))
        assert grid.data[row * grid.info.width + column] == 0, "the robot stands on free floor"
        marks = until(lambda: me_marks.take(1), 30, "no markers")[0] if (me_marks := me.reader("rt/orthoframe/markers", peer.MarkerArray, peer.LATCHED)) else None
        assert {"Комната-В", "Стол-1"} <= {m.text for m in marks.markers}, [m.text for m in marks.markers][:20]
        header = list(uuid.uuid4().bytes)
        ask, answers = me.asks("orthoframe/ask", peer.Ask)
        until(lambda: ask.get_matched_subscriptions() and answers.get_matched_publications(), 30, "no /orthoframe/ask")
        ask.write(peer.Ask[0](header, "Где лекарство?"))
        answer = until(lambda: answers.take(1), 60, "no answer")[0]
        assert list(answer.header) == header and answer.outcome == "found" and "лекарств" in answer.text.lower(), answer
        ask.write(peer.Ask[0](header, "абракадабра"))
        answer = until(lambda: answers.take(1), 60, "no answer")[0]
        assert answer.outcome not in ("found", "yes"), answer
        goals, accepted = me.asks("orthoframe/run/_action/send_goal", peer.RunGoal)
        results, ended = me.asks("orthoframe/run/_action/get_result", peer.RunResult)
        feedback = me.reader("rt/orthoframe/run/_action/feedback", peer.RunFeedback)
        health = me.reader("rt/diagnostics", peer.DiagnosticArray)
        until(lambda: goals.get_matched_subscriptions() and results.get_matched_subscriptions() and feedback.get_matched_publications(), 30, "no /orthoframe/run")
        goal = list(uuid.uuid4().bytes)
        goals.write(peer.RunGoal[0](header, goal, "Поезжай к Точке-К"))
        assert until(lambda: accepted.take(1), 60, "the goal is not answered")[0].accepted
        results.write(peer.RunResult[0](header, goal))
        second = list(uuid.uuid4().bytes)
        goals.write(peer.RunGoal[0](header, second, "Поезжай к Точке-А"))
        assert not until(lambda: accepted.take(1), 60, "the second goal is not answered")[0].accepted
        told = []
        result = until(lambda: told.extend(feedback.take(100)) or ended.take(1), 180, "no result")[0]
        assert (result.status, result.outcome) == (peer.SUCCEEDED, "done"), result
        events = [one.event for one in told + list(feedback.take(100)) if list(one.goal_id) == goal]
        assert events[0] == "planned" and "arrived" in events, events
        assert robot.driven
        status = until(lambda: health.take(10), 10, "no diagnostics")[-1].status[0]
        assert status.name == "orthoframe: orders" and status.level == 0, status
    finally:
        node.terminate()
        node.wait()
        robot.close()


os.environ["ORTHO_LANG"] = "ru"
ortho("import", "maps/rb2.toml")
count = a_mission_drives_by_nav2()
print(f"follow_path: {count} goals")
count = a_mission_drives_by_nav2(("--poses",), "navigate_to_pose", SPREAD)
print(f"navigate_to_pose: {count} goals")
a_stop_reaches_the_robot()
print(a_peer_that_is_lost_ends_the_mission(lambda robot: setattr(robot, "is_silent", True), "odom"))
print(a_peer_that_is_lost_ends_the_mission(lambda robot: robot.close(), "odom"))
print(nobody_is_there())
questions_and_orders_are_heard()
print("missions are driven over DDS")
