"""Ways driven in MuJoCo: python3 touch.py ORTHO [WAYS [SEED]], in the repository's root. Without noise nothing is touched.

The map is prisms at their heights, doors are leaves on hinges, the robot a cylinder between the step that it climbs and its
height. It goes where the mission sends it, a centimetre at a time, and MuJoCo says what it touches; leaves are swung a degree at
a time, and may touch no thing either."""

import math
import random
import statistics
import sys
import tempfile
from pathlib import Path

try:
    import mujoco
    import shapely
    from world import Ortho, World, buildings, convex, free_places, is_joined, name_places
except ImportError as missing:
    print(missing)
    sys.exit(77)

from vehicle import drive

WALL = 0.1  # cm thick, about the line that it is
ROBOT, LEAF = 1, 2
STEP, TURN = 1.0, 1.0  # cm, degrees
PLAY = 0.1  # cm: hinges have it


class Scene:
    """A world in MuJoCo, metres."""

    def __init__(self, world, height=None):
        self.world, self.height = world, height or world.height
        spec = mujoco.MjSpec()
        spec.option.gravity = [0, 0, 0]
        self.spec, self.names = spec, []
        for wall in world.walls:
            self.solid(spec.worldbody, "wall", wall.buffer(WALL / 2, cap_style="flat"), 0, 250, 0, ROBOT)
        for solid in world.solids:
            for piece in convex(solid.outline):
                self.solid(spec.worldbody, solid.name, piece, solid.bottom, solid.top, 0, ROBOT | LEAF)
        self.leaves = {}
        for door in world.doors.values():
            if door.height:
                lintel = shapely.LineString([door.right, door.left]).buffer(WALL / 2, cap_style="flat")
                self.solid(spec.worldbody, "wall", lintel, door.height, max(250, door.height + 1), 0, ROBOT)
            for number, leaf in enumerate(door.leaves):
                name = f"{door.name}/{number}"
                begin, end = (leaf.right, leaf.left) if leaf.hinge == "right" else (leaf.left, leaf.right)
                at = [begin[0] / 100, begin[1] / 100, 0]
                body = spec.worldbody.add_body(pos=at)
                along = [(e - b) / leaf.length for b, e in zip(begin, end)]
                if door.kind == "hinged":
                    sign = along[0] * leaf.swing[1] - along[1] * leaf.swing[0]
                    body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, sign])
                    most = math.radians(leaf.most)
                else:
                    body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[-along[0], -along[1], 0])
                    most = leaf.length * leaf.most / 1e4
                shut = shapely.affinity.translate(leaf.outline(0.0, door.kind == "sliding"), -begin[0], -begin[1])
                self.solid(body, door.name, shut, 2, door.height or 200, LEAF, ROBOT)
                self.leaves.setdefault(door.name, []).append((name, most))
        robot = spec.worldbody.add_body()
        robot.add_joint(name="x", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[1, 0, 0])
        robot.add_joint(name="y", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 1, 0])
        robot.add_joint(name="heading", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1])
        half = (self.height - world.step) / 200
        robot.add_geom(name="robot", type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[world.radius / 100, half, 0],
                       pos=[0, 0, world.step / 100 + half], contype=ROBOT, conaffinity=0)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self.robot = self.model.geom("robot").id
        self.share = {}
        for door in world.doors.values():
            self.swing(door.name, door.opening / 100 if door.status == "open" else 0.0)

    def solid(self, body, name, outline, bottom, top, kind, meets):
        top = max(top, bottom + 0.2)
        corners = [(x / 100, y / 100, z / 100) for z in (bottom, top) for x, y in list(outline.exterior.coords)[:-1]]
        mesh = self.spec.add_mesh(name=f"mesh {len(self.names)}", uservert=[c for corner in corners for c in corner])
        body.add_geom(name=str(len(self.names)), type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh.name, contype=kind, conaffinity=meets)
        self.names.append(name)

    def swing(self, door, share):
        self.share[door] = share
        for name, most in self.leaves.get(door, []):
            self.data.joint(name).qpos[0] = share * most

    def stand(self, x, y, heading):
        for name, value in (("x", x / 100), ("y", y / 100), ("heading", math.radians(heading))):
            self.data.joint(name).qpos[0] = value

    def touched(self, play=0.0):
        """What the robot touches, and what leaves touch by more than their play."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_collision(self.model, self.data)
        by_robot, by_leaves = set(), set()
        for contact in self.data.contact[: self.data.ncon]:
            one, other = contact.geom
            if self.robot in (one, other):
                by_robot.add(self.names[int(self.model.geom(int(one + other - self.robot)).name)])
            elif contact.dist < -PLAY / 100:
                by_leaves.add(tuple(sorted(self.names[int(self.model.geom(int(geom)).name)] for geom in (one, other))))
        return by_robot, by_leaves

    def gap(self):
        """How near the robot is to what is nearest, cm, up to 50."""
        mujoco.mj_kinematics(self.model, self.data)
        least = 0.5
        for geom in range(self.model.ngeom):
            if geom != self.robot and self.model.geom_conaffinity[geom] & ROBOT:
                least = min(least, mujoco.mj_geomDistance(self.model, self.data, self.robot, geom, least, None))
        return least * 100


class Robot:
    """Goes where it is sent, whatever it touches."""

    speed, turn_rate = 50.0, 90.0

    def __init__(self, scene, x, y, heading):
        self.scene, self.x, self.y, self.heading, self.time = scene, x, y, heading, 0.0
        self.touches, self.strikes, self.gaps, self.way, self.swings = [], [], [], 0.0, 0

    def at(self):
        return {"map": self.scene.world.map, "x": self.x, "y": self.y, "heading": self.heading % 360}

    def look(self):
        self.scene.stand(self.x, self.y, self.heading)
        by_robot, by_leaves = self.scene.touched()
        self.touches += [(round(self.x, 1), round(self.y, 1), name) for name in sorted(by_robot)]
        return by_leaves

    def follow(self, order, tell):
        for x, y in order["path"]:
            length = math.hypot(x - self.x, y - self.y)
            if length < 1e-6:
                continue
            self.turn(math.degrees(math.atan2(y - self.y, x - self.x)))
            steps = math.ceil(length / STEP)
            begin = (self.x, self.y)
            for step in range(1, steps + 1):
                self.x, self.y = (b + (e - b) * step / steps for b, e in zip(begin, (x, y)))
                self.time += length / steps / self.speed
                self.look()
                if step % 10 == 0:
                    self.gaps.append(self.scene.gap())
                    tell({"say": "going"})
            self.way += length
        if order["heading"] is not None:
            self.turn(order["heading"])

    def turn(self, heading):
        turn = (heading - self.heading + 180) % 360 - 180
        self.heading += turn
        self.time += abs(turn) / self.turn_rate
        self.look()

    def set_door(self, order, tell):
        share = order["opening"] / 100 if order["status"] == "open" else 0.0
        before = self.scene.share[order["door"]]
        most = max([most for _, most in self.scene.leaves.get(order["door"], [])], default=0.0)
        steps = max(1, math.ceil(abs(share - before) * math.degrees(most) / TURN))
        # What a leaf touches as the map has it stand is no fault of who swings it.
        struck, known = set(), self.look()
        for step in range(1, steps + 1):
            self.scene.swing(order["door"], before + (share - before) * step / steps)
            struck |= self.look()
        self.strikes += sorted(struck - known)
        self.swings += 1
        self.time += 4

    def nothing(self, order, tell):
        self.time += 1

    look_round = report = call = nothing

    def look_at(self, order, tell):
        return {"say": "seen", "sighting": None}

    sees = look_at


def ways(program, file, count, dice, shut=0.5):
    """So many ways on one map, one after the other; each of its doors is shut first with this probability."""
    ortho = Ortho(program, file)
    world = World(ortho)
    for door in world.doors.values():
        if door.leaves and door.status == "open" and dice.random() < shut:
            ortho.run("edit", "state", door.name, "closed")
    world = World(ortho)
    scene = Scene(world)
    places = free_places(world, 3 * count + 1, dice)
    name_places(ortho, places)
    for _, *pose in places:
        scene.stand(*pose)
        assert not scene.touched()[0], pose
    told = {"ways": 0, "refused": [], "wrong": [], "touches": [], "strikes": [], "gaps": [], "metres": 0.0, "swings": 0}
    at = places[0][1:]
    for number, (_, x, y, heading) in enumerate(places[1:], 2):
        if told["ways"] == count:
            break
        robot = Robot(scene, *at)
        value, code, _, _ = drive(ortho, robot, f"Go to Goal {number}")
        is_there = math.hypot(robot.x - x, robot.y - y) < 1
        if code == 0 and is_there:
            told["ways"] += 1
        elif code == 1 and not is_joined(world, (at, (x, y)), world.radius + world.clearance):
            told["refused"].append(number)
            robot.x, robot.y, robot.heading = x, y, heading
        else:
            told["wrong"].append((number, at, (x, y), value))
        told["touches"] += [(number, *touch) for touch in robot.touches]
        told["strikes"] += [(number, strike) for strike in robot.strikes]
        told["gaps"] += robot.gaps
        told["metres"] += robot.way / 100
        told["swings"] += robot.swings
        at = (robot.x, robot.y, robot.heading)
    return told


UNDER = """
format = 1
domain = { key = "under", name = "Under" }
robot = { radius = 25, height = 70, step = 2, clearance = 2, start = "West" }
[orthoframe]
hall = { points = [[0, 0], [600, 0], [600, 200], [0, 200]], height = 250 }
top = { points = [[0, 0], [80, 0], [80, 200], [0, 200]], height = 4 }
[object.bench]
name = "Bench"
items = [{ id = "A", orthoframe = "top" }]
[area.hall]
name = "Hall"
items = [{ id = "A", orthoframe = "hall" }]
places = [{ name = "West", at = [60, 100] }, { name = "East", at = [540, 100] }]
replicas = [{ name = "Bench 1", object = "bench", at = [260, 0, 72] }]
[map.floor]
name = "Floor"
items = [{ area = "hall" }]
"""


def a_low_robot_passes_under(program):
    """What is 72 cm high lets one of 70 cm pass, and not one of 80."""
    file = Path(tempfile.mkdtemp()) / "under.toml"
    file.write_text(UNDER)
    ortho = Ortho(program, file)
    for height, passes in ((70, True), (80, False)):
        ortho.edit({"robot": {"height": height}})
        robot = Robot(Scene(World(ortho)), 60, 100, 0)
        value, code, _, _ = drive(ortho, robot, "Go to East")
        assert (code == 0) == passes and (robot.x > 500) == passes and not robot.touches, (height, value)
        print(f"{height} cm under 72 cm: {'passes' if passes else 'stays'}")
    # And it is touched by who does not stay.
    robot.follow({"path": [(540, 100)], "heading": None}, lambda message: None)
    assert {name for _, _, name in robot.touches} == {"Bench 1"}, robot.touches


def main():
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 12
    dice = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
    a_low_robot_passes_under(program)
    files = buildings(few=count < 50)
    print("| map | ways | refused, and no way is | m | touches | doors swung | touches of leaves | least gap, cm | median |")
    print("|---|---|---|---|---|---|---|---|---|")
    faults = []
    for number, file in enumerate(files):
        share = count * (number + 1) // len(files) - count * number // len(files)
        told = ways(program, file, share, dice)
        gaps = told["gaps"] or [math.inf]
        print(f"| {file.stem} | {told['ways']} | {len(told['refused'])} | {told['metres']:.0f} | {len(told['touches'])} | {told['swings']} | {len(told['strikes'])} "
              f"| {min(gaps):.1f} | {statistics.median(gaps):.1f} |", flush=True)
        faults += [(file.stem, kind, fault) for kind in ("wrong", "touches", "strikes") for fault in told[kind]]
    for fault in faults[:20]:
        print(fault)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
