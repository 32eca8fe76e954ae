"""Ways driven in IR-SIM by wheels that slip and a laser that errs: python3 noise.py ORTHO [WAYS [SEED [BUILDING…]]], in the
repository's root; of the ways those in the buildings named, or all.

The robot knows what its wheels count and what its laser tells; where it is the mission finds out. What IR-SIM says that it touches
is a contact. Beside it IR-SIM's own A*, in the same world with the same noise: driven by what the wheels count, and, which no robot
has, told after every step where it truly is."""

import math
import random
import statistics
import sys
import tempfile
from pathlib import Path

try:
    import irsim
    import numpy
    import shapely
    import yaml
    from irsim.lib.path_planners.a_star import AStarPlanner
    from world import Ortho, World, buildings, free_places, is_joined, name_places
except ImportError as missing:
    print(missing)
    sys.exit(77)

from vehicle import Bumped, Refused, drive

TICK = 0.1  # s
SPEED, TURN_RATE = 50.0, 60.0  # cm/s, degrees/s
LASER, BEAMS, REACH, ERROR = 20.0, 360, 10.0, 0.02  # cm above the floor; m
SLIP, SWERVE = 0.03, 0.9  # of a metre, and of a right angle; degrees on a metre
LOOK = 3  # ticks from scan to scan
ARRIVED = 15.0  # cm
CELL = 5.0  # cm of A*'s grid


def noise():
    """IR-SIM's alpha: squares of what a tick's velocity deviates by, so that the deviations of a way come to SLIP and SWERVE."""
    ahead = SLIP * math.sqrt(100 / (SPEED * TICK))
    swerve = math.radians(SWERVE) / math.sqrt(SPEED * TICK / 100)
    turn = SLIP * math.sqrt(90 / (TURN_RATE * TICK))
    return [ahead**2, 0.0, swerve**2, turn**2]


def ring(outline):
    return [[x / 100, y / 100] for x, y in list(outline.exterior.coords)[:-1]]


class Judge:
    """A world in IR-SIM, with the robot where it truly is. It stops at what it touches."""

    def __init__(self, world, pose, seed):
        self.world = world
        low_x, low_y, high_x, high_y = shapely.union_all(list(world.rooms.values())).bounds
        x, y, heading = pose
        robot = {
            "kinematics": {"name": "diff", "noise": True, "alpha": noise()},
            "shape": {"name": "circle", "radius": world.radius / 100},
            "state": [x / 100, y / 100, math.radians(heading)],
            "vel_max": [10, 100],
            "sensors": [{"name": "lidar2d", "range_max": REACH, "angle_range": 2 * math.pi, "number": BEAMS + 1, "noise": True, "std": ERROR}],
        }
        # What has no state is shifted.
        still = {"kinematics": {"name": "static"}, "state": [0, 0, 0]}
        lines = [[[x / 100, y / 100] for x, y in wall.coords] for wall in world.walls]
        solids = world.in_the_way()
        obstacles = [{**still, "shape": {"name": "linestring", "vertices": line}} for line in lines]
        obstacles += [{**still, "shape": {"name": "polygon", "vertices": ring(solid.outline)}} for solid in solids]
        file = Path(tempfile.mkdtemp()) / "world.yaml"
        plane = {"width": (high_x - low_x) / 100 + 2, "height": (high_y - low_y) / 100 + 2, "offset": [low_x / 100 - 1, low_y / 100 - 1],
                 "step_time": TICK, "sample_time": TICK, "collision_mode": "unobstructed"}
        file.write_text(yaml.safe_dump({"world": plane, "robot": [robot], "obstacle": obstacles}))
        self.env = irsim.make(str(file), headless=True, log_level="CRITICAL", seed=seed)
        outlines = [solid.outline for solid in solids]
        for obstacle, outline in zip(self.env.obstacle_list[len(lines):], outlines, strict=True):
            assert shapely.area(shapely.symmetric_difference(obstacle.geometry, shapely.affinity.scale(outline, 0.01, 0.01, origin=(0, 0)))) < 1e-6
        # The laser passes over what is low, and under what is high.
        unseen = {obstacle.id for obstacle, solid in zip(self.env.obstacle_list[len(lines):], solids) if not solid.bottom <= LASER < solid.top}
        laser = self.env.robot.sensors[0]
        all_near = laser._get_detected_objects
        laser._get_detected_objects = lambda beams: [near for near in all_near(beams) if near.id not in unseen]
        laser.step, self.cast = (lambda state: None), laser.step
        self.laser, self.contacts, self.way = laser, [], 0.0
        self.leaves, self.share = {}, {}
        for door in world.doors.values():
            self.swing(door, door.opening / 100 if door.status == "open" else 0.0)

    def swing(self, door, share):
        """Whether nothing stands in the way of its leaves."""
        before = self.share.get(door.name, share)
        body = self.env.robot.geometry
        ways = [leaf for step in range(11) for leaf in door.outlines(before + (share - before) * step / 10)]
        if before != share and any(shapely.intersects(shapely.affinity.scale(leaf, 0.01, 0.01, origin=(0, 0)), body) for leaf in ways):
            return False
        if door.name in self.leaves:
            self.env.delete_objects([leaf.id for leaf in self.leaves[door.name]])
        shapes = [{"name": "polygon", "vertices": ring(leaf)} for leaf in door.outlines(share)]
        self.leaves[door.name] = [self.env.create_obstacle(kinematics={"name": "static"}, state=[0, 0, 0], shape=shape) for shape in shapes]
        self.env.add_objects(self.leaves[door.name])
        self.share[door.name] = share
        return True

    def truth(self):
        x, y, heading = self.env.robot.state[:3, 0]
        return x * 100, y * 100, math.degrees(heading)

    def go(self, ahead, turn):
        """One tick, at cm/s and degrees/s; false where it touched something, and is back where it was before."""
        before = self.env.robot.state.copy()
        self.env.step([ahead / 100, math.radians(turn)])
        if not self.env.robot.collision:
            self.way += math.dist(before[:2, 0], self.env.robot.state[:2, 0])
            return True
        self.contacts.append(tuple(round(value, 1) for value in self.truth()))
        self.env.robot.set_state(before)
        self.env.build_tree()
        return False

    def scan(self):
        self.cast(self.env.robot.state[:3])
        ranges = [round(float(r) * 100, 1) if valid else None for r, valid in zip(self.laser.range_data, self.laser.valid)]
        return {"say": "scan", "height": LASER, "from": -180.0, "step": 360 / BEAMS, "ranges": ranges[:-1]}


def ticks(whole, rate):
    """A way in ticks at this rate, all alike."""
    count = max(1, math.ceil(abs(whole) / (rate * TICK) - 1e-9))
    return count, whole / count


class Robot:
    """Knows what its wheels count."""

    odometry = True

    def __init__(self, judge):
        self.judge, self.x, self.y, self.heading, self.looked = judge, 0.0, 0.0, 0.0, 0

    @property
    def time(self):
        return self.judge.env.time

    def at(self):
        return {"map": self.judge.world.map, "x": self.x, "y": self.y, "heading": self.heading % 360}

    def tick(self, tell, ahead=0.0, turn=0.0, must_look=False):
        is_free = self.judge.go(ahead / TICK, turn / TICK)
        if is_free:
            self.heading += turn / 2
            self.x += ahead * math.cos(math.radians(self.heading))
            self.y += ahead * math.sin(math.radians(self.heading))
            self.heading += turn / 2
        self.looked += 1
        if must_look or not is_free or self.looked >= LOOK:
            self.looked = 0
            tell({"say": "going"})
            tell(self.judge.scan())
        if not is_free:
            raise Bumped("unknown")

    def follow(self, order, tell):
        for x, y in order["path"]:
            if math.hypot(x - self.x, y - self.y) < 1e-6:
                continue
            self.turn(math.degrees(math.atan2(y - self.y, x - self.x)), tell)
            count, step = ticks(math.hypot(x - self.x, y - self.y), SPEED)
            for number in range(1, count + 1):
                self.tick(tell, ahead=step, must_look=number == count)
        if order["heading"] is not None:
            self.turn(order["heading"], tell)

    def turn(self, heading, tell):
        turn = (heading - self.heading + 180) % 360 - 180
        if abs(turn) < 1e-6:
            return
        count, step = ticks(turn, TURN_RATE)
        for number in range(1, count + 1):
            self.tick(tell, turn=step, must_look=number == count)

    def look_round(self, order, tell):
        for number in range(1, 11):
            self.tick(tell, must_look=number == 10)

    report = call = look_round

    def set_door(self, order, tell):
        door = self.judge.world.doors[order["door"]]
        if not self.judge.swing(door, order["opening"] / 100 if order["status"] == "open" else 0.0):
            raise Refused({"jammed": {"door": door.name, "by": None, "opening": 0}})
        self.look_round(order, tell)

    def look_at(self, order, tell):
        return {"say": "seen", "sighting": None}

    sees = look_at


class Grid:
    """A world as IR-SIM's planners want it: cells where the robot may not be are taken."""

    def __init__(self, world):
        floor = shapely.union_all(list(world.rooms.values()))
        solids = [solid.outline for solid in world.in_the_way()] + world.walls
        solids += [leaf for door in world.doors.values() for leaf in door.outlines()]
        free = floor.difference(shapely.union_all([outline.buffer(world.radius + world.clearance) for outline in solids]))
        low_x, low_y, high_x, high_y = floor.bounds
        wide, high = math.ceil((high_x - low_x) / CELL), math.ceil((high_y - low_y) / CELL)
        xs, ys = numpy.meshgrid(low_x + numpy.arange(wide) * CELL, low_y + numpy.arange(high) * CELL, indexing="ij")
        self.grid = numpy.where(shapely.contains_xy(free, xs, ys), 0.0, 100.0)
        self.width, self.height, self.resolution = wide * CELL / 100, high * CELL / 100, CELL / 100
        self.obstacle_list, self.world_offset, self.grid_resolution = [], (low_x / 100, low_y / 100), (CELL / 100, CELL / 100)

    def is_collision(self, cell):
        x, y = (value - low for value, low in zip((cell.centroid.x, cell.centroid.y), self.world_offset))
        return self.grid[round(x / self.resolution), round(y / self.resolution)] > 50

    def way(self, start, goal):
        planned = AStarPlanner(self).planning([start[0] / 100, start[1] / 100], [goal[0] / 100, goal[1] / 100], show_animation=False)
        points = [(x * 100, y * 100) for x, y in zip(*planned)][::-1]
        corners = [b for a, b, c in zip(points, points[1:], points[2:]) if abs((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])) > 1e-6]
        return [*corners, goal[:2]]


def along(judge, way, is_told):
    """Drives a way corner by corner, by what the wheels count from the true start, or told every tick where it is."""
    counted = list(judge.truth())
    for x, y in way:
        for _ in range(2000):
            at = judge.truth() if is_told else counted
            left = math.hypot(x - at[0], y - at[1])
            if left < 1.0:
                break
            turn = (math.degrees(math.atan2(y - at[1], x - at[0])) - at[2] + 180) % 360 - 180
            ahead, turn = (0.0, max(-TURN_RATE * TICK, min(TURN_RATE * TICK, turn))) if abs(turn) > 3 else (min(SPEED * TICK, left), 0.0)
            if not judge.go(ahead / TICK, turn / TICK):
                return False
            counted[2] += turn
            counted[0] += ahead * math.cos(math.radians(counted[2]))
            counted[1] += ahead * math.sin(math.radians(counted[2]))
    return math.dist(judge.truth()[:2], way[-1]) < ARRIVED


class Told:
    """What came of the ways of one driver."""

    def __init__(self):
        self.ways = self.arrived = self.contacts = self.refused = 0
        self.misses, self.metres, self.seconds = [], 0.0, []

    def add(self, judge, goal, arrived):
        self.ways += 1
        self.arrived += arrived
        self.contacts += len(judge.contacts)
        self.metres += judge.way
        if arrived:
            self.misses.append(math.dist(judge.truth()[:2], goal[:2]))

    def row(self, name):
        misses = self.misses or [math.nan]
        return (f"| {name} | {self.ways} | {self.arrived} | {self.contacts} | {self.metres:.0f} | {statistics.median(misses):.1f} | {max(misses):.1f} |")


def ways(program, file, count, dice, ours, counted, told):
    """So many ways on one map; what went wrong."""
    ortho = Ortho(program, file)
    world = World(ortho)
    places = free_places(world, count + 1, dice)
    name_places(ortho, places)
    grid, faults = Grid(world), []
    for number, ((_, *start), (_, *goal)) in enumerate(zip(places, places[1:]), 1):
        if not is_joined(world, (start, goal), world.radius + world.clearance + 1):
            continue
        # Where it begins it is told without a heading, which is along x.
        start[2], seed = 0.0, dice.randrange(2**31)
        judge = Judge(world, start, seed)
        value, code, _, _ = drive(ortho, Robot(judge), f"Go to Goal {number + 1}", "--from", ",".join(str(round(value, 1)) for value in start[:2]))
        arrived = code == 0 and math.dist(judge.truth()[:2], goal[:2]) < ARRIVED
        ours.add(judge, goal, arrived)
        if not arrived or judge.contacts:
            faults.append((file.stem, number, seed, start, goal, judge.truth(), judge.contacts[:3], value.get("outcome"), value.get("explanation")))
        way = grid.way(start, goal)
        for driver, is_told in ((counted, False), (told, True)):
            judge = Judge(world, start, seed)
            driver.add(judge, goal, along(judge, way, is_told))
    return faults


def main():
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    seed, wanted = sys.argv[3] if len(sys.argv) > 3 else "1", sys.argv[4:]
    files = buildings(few=count < 50)
    ours, counted, told, faults = Told(), Told(), Told(), []
    for number, file in enumerate(files):
        share = count * (number + 1) // len(files) - count * number // len(files)
        if wanted and file.stem not in wanted:
            continue
        # Each building has ways of its own, whichever are driven.
        dice = random.Random(f"{seed} {file.stem}")
        faults += ways(program, file, share, dice, ours, counted, told)
        print(ours.row(file.stem), flush=True)
    print("| who drives | ways | arrived | contacts | m | off the goal, cm: median | most |")
    print("|---|---|---|---|---|---|---|")
    print(ours.row("`ortho do`, by wheels and laser"))
    print(counted.row("IR-SIM's A*, by its wheels"))
    print(told.row("IR-SIM's A*, told where it is"))
    for fault in faults:
        print(fault)
    good = ours.arrived >= 0.99 * ours.ways and not ours.contacts
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
