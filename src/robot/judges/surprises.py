"""Missions in worlds that are not as the map says: python3 surprises.py ORTHO [MISSIONS [SEED [BUILDING…]]], in the
repository's root; of the missions those in the buildings named, or all.

Half of them in pyrobosim: hallways that turn out closed or locked, things that lie elsewhere or are gone. Half in IR-SIM: doors shut
and locked, furniture moved and gone, people who walk about; by wheels that slip and a laser that errs. A mission is to be done, or
told to be impossible; whether that is so is reckoned from the true world."""

import copy
import importlib.util
import json
import logging
import math
import os
import random
import sys
from collections import Counter
from pathlib import Path

try:
    import shapely
    from noise import Judge, Robot
    from pyrobosim.core.yaml_utils import WorldYamlLoader
    from pyrobosim.sensors.fov import FOVSensor
    from pyrobosim.utils.pose import Pose
    from world import Ortho, World, buildings, free_places, is_joined, name_places
except ImportError as missing:
    print(missing)
    sys.exit(77)

from vehicle import Bumped, Refused, drive

REACH = 100.0  # cm from the body to what its hand takes
PATIENCE = 400  # s of the clock for one mission; whoever takes longer is left hanging
GIRTH, PACE, POLITE = 22.0, 60.0, 45.0  # of people: cm, cm/s, and how near they come to a robot, cm


# --- pyrobosim


class Hall:
    """A robot in pyrobosim, which says what is free, open, in view and to be had.

    A hallway that it closes is closed from end to end; here, where our map has the door of it. It takes corners of what it grows by the
    robot's radius for square; here the robot is a disc among what it has not grown."""

    def __init__(self, world, told, file, start):
        self.world, self.names, self.time, self.contacts, self.is_full = world, told, 0.0, 0, False
        self.truth = WorldYamlLoader().from_file(file)
        for extra in list(self.truth.robots)[1:]:
            self.truth.remove_robot(extra)
        self.robot = self.truth.robots[0]
        self.robot.grasp_generator = None
        self.robot.set_sensors({"eye": FOVSensor(update_rate_s=1, angle_units="degrees", min_angle=-180, max_angle=180, max_range_m=10)})
        for hallway in self.truth.hallways:
            door = world.doors[self.door_of(hallway)]
            leaf = shapely.union_all(door.outlines(0.0))
            hallway.closed_polygon = hallway.inflated_closed_polygon = shapely.affinity.scale(leaf, 0.01, 0.01, origin=(0, 0))
        self.truth.update_polygons()
        self.pose(*start)

    def pose(self, x, y, heading):
        self.x, self.y, self.heading = x, y, heading
        self.robot.set_pose(Pose(x=x / 100, y=y / 100, yaw=math.radians(heading)))

    def at(self):
        return {"map": self.world.map, "x": self.x, "y": self.y, "heading": self.heading % 360}

    def check(self, x, y):
        """Whether it can be there."""
        body = shapely.Point(x / 100, y / 100).buffer(self.world.radius / 100, quad_segs=32)
        for hallway in self.truth.hallways:
            if not hallway.is_open and hallway.closed_polygon.intersects(body):
                raise Bumped({"door": self.door_of(hallway)})
        if not self.truth.total_external_polygon.contains(body):
            self.contacts += 1
            raise Bumped("unknown")

    def follow(self, order, tell):
        for x, y in order["path"]:
            length = math.hypot(x - self.x, y - self.y)
            if length < 1e-6:
                continue
            heading, steps, begin = math.degrees(math.atan2(y - self.y, x - self.x)), math.ceil(length / 2), (self.x, self.y)
            self.pose(self.x, self.y, heading)
            for step in range(1, steps + 1):
                to = tuple(b + (e - b) * step / steps for b, e in zip(begin, (x, y)))
                self.check(*to)
                self.pose(*to, heading)
                self.time += length / steps / 50
                if step % 25 == 0:
                    tell({"say": "going"})
        if order["heading"] is not None:
            self.pose(self.x, self.y, order["heading"])

    def hallway(self, door):
        return next(hallway for hallway in self.truth.hallways if self.door_of(hallway) == door)

    def door_of(self, hallway):
        doors = self.names["doors"]
        return doors.get(hallway.name) or doors[hallway.reversed_name]

    def set_door(self, order, tell):
        hallway, opens = self.hallway(order["door"]), order["status"] == "open"
        self.time += 4
        done = (self.truth.open_location if opens else self.truth.close_location)(hallway)
        if not done.is_success():
            raise Refused({"locked": {"door": order["door"]}} if hallway.is_locked else {"jammed": {"door": order["door"], "by": None, "opening": 0}})

    def seen(self, thing):
        """Where the thing is, if it is in view, as our map would have it."""
        name = self.names["things"].get(thing)
        if location := name and self.truth.get_location_by_name(name):
            self.robot.detect_objects()
            is_seen = location.polygon.intersects(self.robot.sensors["eye"].fov_polygon)
            return {"thing": {"thing": thing, "place": self.names["stands"][thing]}} if is_seen else None
        body = name and self.truth.get_object_by_name(name)
        self.robot.detect_objects()
        if body is None or body not in self.robot.known_objects or body is self.robot.manipulated_object:
            return None
        self.robot.known_objects.discard(body)
        return {"thing": {"thing": thing, "place": self.place(thing, body)}}

    def place(self, thing, body):
        room = body.parent.parent.parent
        item = self.names["items"][thing]
        turn = math.degrees(body.pose.get_yaw())
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        area = next(area for area, name in self.names["rooms"].items() if name == room.name)
        origin = self.names["origins"][area]
        x = body.pose.x * 100 - (c * item["middle"][0] - s * item["middle"][1]) - origin[0]
        y = body.pose.y * 100 - (s * item["middle"][0] + c * item["middle"][1]) - origin[1]
        return {"area": area, "x": x, "y": y, "z": self.names["tops"][body.parent.parent.name], "angle": turn % 360}

    def sees(self, order, tell):
        return {"say": "seen", "sighting": self.seen(order["thing"])}

    def look_at(self, order, tell):
        what, sighting = order["what"], None
        if "door" in what:
            hallway = self.hallway(what["door"])
            status = "open" if hallway.is_open else "closed"
            sighting = {"door": {"door": what["door"], "status": status, "opening": 100.0 if hallway.is_open else 0.0}}
        elif "thing" in what:
            sighting = self.seen(what["thing"])
        return {"say": "seen", "sighting": sighting}

    def take(self, order, tell):
        body = self.truth.get_object_by_name(self.names["things"][order["thing"]])
        self.time += 5
        if body is None or body not in self.truth.objects:
            raise Refused({"not_there": {"thing": order["thing"]}})
        if self.robot.polygon.distance(body.parent.polygon) * 100 > REACH:
            raise Refused({"not_there": {"thing": order["thing"]}})
        self.robot.location = body.parent
        if not self.robot.pick_object(body).is_success():
            raise Refused({"shut": {"thing": order["thing"]}})

    def put(self, order, tell):
        place, item = order["place"], self.names["items"][order["thing"]]
        origin, turn = self.names["origins"][place["area"]], math.radians(place["angle"])
        x = origin[0] + place["x"] + math.cos(turn) * item["middle"][0] - math.sin(turn) * item["middle"][1]
        y = origin[1] + place["y"] + math.sin(turn) * item["middle"][0] + math.cos(turn) * item["middle"][1]
        spawns = [spawn for location in self.truth.locations for spawn in location.children]
        under = min(spawns, key=lambda spawn: spawn.polygon.distance(shapely.Point(x / 100, y / 100)))
        self.time += 5
        self.robot.location = under
        done = self.robot.place_object(Pose(x=x / 100, y=y / 100, yaw=turn)).is_success()
        # Its shapes are finer than our boxes: where the very place is taken, its hand finds another on the same.
        for spawn in under.parent.children:
            self.robot.location = spawn
            done = done or self.robot.place_object().is_success()
        if not done:
            self.is_full = True
            raise Refused({"no_room": {"thing": order["thing"]}})

    def nothing(self, order, tell):
        self.time += 2

    look_round = report = call = nothing


def names_of(ortho, world):
    """What is called how on our map and in pyrobosim, and where our frames are."""
    whole = json.loads((ortho.folder / "map.json").read_text())
    source = "ИСТОЧНИК"
    told = {"doors": {}, "things": {}, "items": {}, "rooms": {}, "origins": {}, "tops": {}, "stands": {}, "called": {}}
    for door in whole["door"].values():
        name, end = door["properties"][source].rsplit("/", 1)
        if door["kind"] != "passage":
            told["doors"][name] = door["name"]
    (plan,) = whole["map"].values()
    for item in plan["items"]:
        area = whole["area"][item["area"]]
        told["rooms"][area["name"]] = area["properties"][source]
        told["called"][area["properties"][source]] = area.get("name_en", area["name"])
        told["origins"][area["name"]] = item.get("at", [0, 0])
        assert not item.get("angle"), "rooms of these worlds are not turned"
        for replica in area.get("replicas", []):
            name, bodies = replica["properties"][source], [solid for solid in world.solids if solid.name == replica["name"]]
            middle, turn = shapely.union_all([body.outline for body in bodies]).centroid, math.radians(replica.get("angle", 0))
            off = [middle.x - replica["at"][0] - item.get("at", [0, 0])[0], middle.y - replica["at"][1] - item.get("at", [0, 0])[1]]
            off = [math.cos(turn) * off[0] + math.sin(turn) * off[1], math.cos(turn) * off[1] - math.sin(turn) * off[0]]
            told["things"][replica["name"]] = name
            told["called"][name] = replica.get("name_en", replica["name"])
            x, y, z = [*replica["at"], 0][:3]
            told["stands"][replica["name"]] = {"area": area["name"], "x": x, "y": y, "z": z, "angle": replica.get("angle", 0)}
            told["items"][replica["name"]] = {"middle": off, "area": area["name"]}
            told["tops"][name] = max(body.top for body in bodies)
    return told


def in_pyrobosim(program, file, count, dice):
    """Missions of going and fetching; hallways are closed and locked, things elsewhere and gone."""
    logging.disable(logging.CRITICAL)
    ortho = Ortho(program, file)
    radius = WorldYamlLoader().from_file(file).robots[0].radius * 100
    ortho.edit({"robot": {"radius": radius}})
    world = World(ortho)
    told = names_of(ortho, world)
    for _ in range(count):
        ((_, *start),) = free_places(world, 1, dice)
        hall = Hall(world, told, file, start)
        surprises = []
        for hallway in hall.truth.hallways:
            draw = dice.random()
            if draw < 0.5:
                hall.truth.close_location(hallway)
                surprises.append(f"{hallway.name} closed")
            if draw < 0.2:
                hall.truth.lock_location(hallway)
                surprises[-1] = f"{hallway.name} locked"
        open_places = [place for place in hall.truth.locations if place.is_open]
        things = [body for body in hall.truth.objects if body.parent.parent.is_open]
        body = dice.choice(things)
        home = body.parent.parent
        draw = dice.random()
        if draw < 0.5:
            other = dice.choice(open_places)
            if hall.truth.update_object(body, other):
                surprises.append(f"{body.name} on {body.parent.parent.name}")
        elif draw < 0.65:
            hall.truth.remove_object(body)
            surprises.append(f"{body.name} gone")
        rooms = reached(hall)
        if dice.random() < 0.3:
            room = dice.choice(hall.truth.rooms)
            area = next(area for area, name in told["rooms"].items() if name == room.name)
            task, can = f"Go to {told['called'][room.name]}", room.name in rooms
            is_so = lambda: world.room_at(hall.x, hall.y) == area  # noqa: E731
        else:
            goal = dice.choice([place for place in open_places if place is not home])
            task = f"Put {told['called'][body.name]} on {told['called'][goal.name]}"
            is_there = body in hall.truth.objects
            can = is_there and {body.parent.parent.parent.name, goal.parent.name} <= rooms
            is_so = lambda: body in hall.truth.objects and body.parent is not None and body.parent.parent is goal  # noqa: E731
        yield ortho, hall, task, (), can, is_so, surprises


def reached(hall):
    """Rooms to which no locked hallway is the only way."""
    at = hall.robot.location
    names, waits = set(), [at if at in hall.truth.rooms else hall.truth.rooms[0]]
    while waits:
        room = waits.pop()
        if room.name in names:
            continue
        names.add(room.name)
        for hallway in hall.truth.hallways:
            if room in (hallway.room_start, hallway.room_end) and (hallway.is_open or not hallway.is_locked):
                waits += [hallway.room_start, hallway.room_end]
    return names


# --- IR-SIM


class Walker:
    """Walks to and fro on a straight stretch of free floor, and stands before a robot."""

    def __init__(self, judge, ends, seed):
        self.judge, self.ends, self.at, self.goal, self.stood = judge, ends, ends[0], 1, 0.0
        shape = {"name": "circle", "radius": GIRTH / 100}
        self.body = judge.env.create_obstacle(kinematics={"name": "static"}, shape=shape, state=[ends[0][0] / 100, ends[0][1] / 100, 0])
        judge.env.add_objects([self.body])

    def walk(self, seconds):
        goal = self.ends[self.goal]
        left = math.dist(self.at, goal)
        if left < 1:
            self.goal = 1 - self.goal
            return
        step = min(1.0, PACE * seconds / left)
        to = tuple(a + (g - a) * step for a, g in zip(self.at, goal))
        robot = self.judge.truth()[:2]
        if math.dist(to, robot) < self.judge.world.radius + GIRTH + POLITE and math.dist(to, robot) < math.dist(self.at, robot):
            self.stood += seconds
            if self.stood > 2:
                self.goal, self.stood = 1 - self.goal, 0.0
            return
        self.at = to
        self.body.set_state([to[0] / 100, to[1] / 100, 0])
        self.judge.env.build_tree()


class Crowd(Judge):
    """With people about, and locks."""

    def __init__(self, world, pose, seed, walks):
        super().__init__(world, pose, seed)
        self.walkers = [Walker(self, ends, seed) for ends in walks]

    def go(self, ahead, turn):
        for walker in self.walkers:
            walker.walk(0.1)
        return super().go(ahead, turn)


class Visitor(Robot):
    def set_door(self, order, tell):
        door = self.judge.world.doors[order["door"]]
        if door.status == "locked" and order["status"] == "open":
            raise Refused({"locked": {"door": door.name}})
        super().set_door(order, tell)
        door.status = order["status"]


def in_irsim(program, file, count, dice):
    """Missions of going; doors are shut and locked, furniture elsewhere and gone, people about."""
    ortho = Ortho(program, file)
    world = World(ortho)
    places = free_places(world, 4 * count + 1, dice)
    name_places(ortho, places)
    pairs = [(number, [*start[:2], 0.0], goal) for number, ((_, *start), (_, *goal)) in enumerate(zip(places, places[1:]), 1)]
    pairs = [pair for pair in pairs if is_joined(world, pair[1:], world.radius + world.clearance + 1)][:count]
    for number, start, goal in pairs:
        truth, surprises = copy.deepcopy(world), []
        for door in truth.doors.values():
            draw = dice.random()
            if door.leaves and door.status == "open" and draw < 0.4:
                door.status = "locked" if draw < 0.15 else "closed"
                surprises.append(f"{door.name} {door.status}")
        keep = shapely.union_all([shapely.Point(end[:2]).buffer(world.radius + 15) for end in (start, goal)])
        standing = sorted({solid.name for solid in truth.in_the_way() if solid.bottom <= 5})
        for name in dice.sample(standing, min(3, len(standing))):
            if dice.random() < 0.4:
                truth.solids = [solid for solid in truth.solids if solid.name != name]
                surprises.append(f"{name} gone")
                continue
            by = [dice.uniform(-80, 80) for _ in range(2)]
            moved = [shapely.affinity.translate(solid.outline, *by) for solid in truth.solids if solid.name == name]
            others = [solid.outline for solid in truth.in_the_way() if solid.name != name] + truth.walls
            others += [leaf for door in truth.doors.values() for share in (0, 0.5, 1) for leaf in door.outlines(share)]
            room = shapely.union_all(list(truth.rooms.values()))
            whole = shapely.union_all(moved)
            if not whole.within(room) or whole.intersects(keep) or any(whole.intersects(other) for other in others):
                continue
            for solid in truth.solids:
                if solid.name == name:
                    solid.outline = shapely.affinity.translate(solid.outline, *by)
            surprises.append(f"{name} moved")
        walks = stretches(truth, keep, dice)
        surprises += [f"{len(walks)} walking"] if walks else []
        judge = Crowd(truth, start, dice.randrange(2**31), walks)
        can = is_joined(unlocked(truth), (start, goal), world.radius + world.clearance)
        is_so = lambda: math.dist(judge.truth()[:2], goal[:2]) < 15  # noqa: E731
        yield ortho, Visitor(judge), f"Go to Goal {number + 1}", ("--from", ",".join(str(round(value, 1)) for value in start[:2])), can, is_so, surprises


def unlocked(world):
    """The world in which what is locked is a wall."""
    other = copy.deepcopy(world)
    other.walls += [shapely.LineString([door.right, door.left]) for door in world.doors.values() if door.status == "locked"]
    return other


def stretches(world, keep, dice):
    """Straight stretches of free floor for two people, on which a robot can pass them by."""
    solids = shapely.union_all([solid.outline for solid in world.in_the_way()] + world.walls + [keep])
    found = []
    for outline in dice.sample(list(world.rooms.values()), len(world.rooms)):
        low_x, low_y, high_x, high_y = outline.bounds
        for _ in range(30):
            ends = [(dice.uniform(low_x, high_x), dice.uniform(low_y, high_y)) for _ in range(2)]
            line = shapely.LineString(ends)
            if line.length > 100 and line.within(outline) and line.distance(solids) > GIRTH + 8:
                found.append(ends)
                break
    return found[:2]


def main():
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 6
    seed, wanted = sys.argv[3] if len(sys.argv) > 3 else "1", sys.argv[4:]
    data = Path(importlib.util.find_spec("pyrobosim").origin).parent / "data"
    halls = [data / name for name in ("test_world.yaml", "roscon_2024_workshop_world.yaml")]
    houses = [file for file in buildings() if file.suffix in (".toml", ".json")]
    runs = [("pyrobosim", in_pyrobosim, halls), ("IR-SIM", in_irsim, houses if count >= 50 else houses[:3])]
    print("| world | missions | surprises | done | told impossible, and so it is | wrongly told impossible | told done, and is not | left hanging | contacts |")
    print("|---|---|---|---|---|---|---|---|---|")
    faults, driven = [], 0
    for name, missions, files in runs:
        tally, total = Counter(), count // 2
        for number, file in enumerate(files):
            if wanted and file.stem not in wanted:
                continue
            share = total * (number + 1) // len(files) - total * number // len(files)
            # Each building has missions of its own, whichever are driven.
            dice = random.Random(f"{seed} {file.stem}")
            for ortho, body, task, more, can, is_so, surprises in missions(program, file, share, dice):
                value, code, seconds, _ = drive(ortho, body, task, "--reset", *more, patience=PATIENCE)
                contacts = getattr(getattr(body, "judge", body), "contacts")
                contacts = contacts if isinstance(contacts, int) else len(contacts)
                tally["missions"] += 1
                tally["surprises"] += len(surprises)
                tally["contacts"] += contacts
                if code == 0:
                    kind = "done" if is_so() else "untrue"
                elif code == 1:
                    kind = "wrong" if can and not getattr(body, "is_full", False) else "impossible"
                else:
                    kind = "hanging"
                tally[kind] += 1
                print(name, file.stem, task, kind, contacts, round(seconds), file=sys.stderr, flush=True)
                if kind not in ("done", "impossible"):
                    why = value.get("explanation_en") or value.get("explanation") or value.get("errors")
                    faults.append((name, file.stem, task, more, surprises, kind, value.get("outcome"), why, code, round(seconds)))
        row = [tally[key] for key in ("missions", "surprises", "done", "impossible", "wrong", "untrue", "hanging", "contacts")]
        driven += tally["missions"]
        print(f"| {name} | " + " | ".join(str(value) for value in row) + " |", flush=True)
    for fault in faults:
        print(fault)
    # Threads of pyrobosim's sensors do not end by themselves.
    sys.stdout.flush()
    os._exit(1 if len(faults) > 0.02 * driven else 0)


if __name__ == "__main__":
    main()
