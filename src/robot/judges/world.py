"""A building as another program reads it: from what `ortho export` writes, cm, in the frame of its one Map."""

import importlib.util
import json
import math
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import shapely
from shapely.geometry import LineString, Point, Polygon

NEAR = 0.5


class Ortho:
    """The program on a store of its own."""

    def __init__(self, program, map_file):
        self.program, self.folder = str(Path(program).resolve()), Path(tempfile.mkdtemp())
        self.store = str(self.folder / "store")
        self.run("import", str(map_file))

    def run(self, *arguments, codes=(0,)):
        command = [self.program, "--store", self.store, "--lang", "en", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300)
        assert done.returncode in codes, (arguments, done.returncode, done.stdout[-2000:], done.stderr[-2000:])
        return done.stdout

    def edit(self, edits):
        file = self.folder / "edits.json"
        file.write_text(json.dumps(edits, ensure_ascii=False))
        self.run("edit", "--file", str(file))


@dataclass
class Solid:
    """A prism of a thing."""

    name: str
    outline: Polygon
    bottom: float
    top: float


@dataclass
class Leaf:
    """`right` and `left` are the ends of what it shuts, on the face into which it swings; `swing` is the unit vector there."""

    right: tuple
    left: tuple
    swing: tuple
    hinge: str
    thickness: float
    most: float

    @property
    def length(self):
        return math.dist(self.right, self.left)

    def outline(self, share, is_sliding=False):
        """Where it stands when it is open by a share of the most."""
        begin, end = (self.right, self.left) if self.hinge == "right" else (self.left, self.right)
        along = ((end[0] - begin[0]) / self.length, (end[1] - begin[1]) / self.length)
        if is_sliding:
            kept = self.length * (1 - share * self.most / 100)
            tip = (begin[0] + along[0] * kept, begin[1] + along[1] * kept)
            return LineString([begin, tip]).buffer(self.thickness / 2, cap_style="flat")
        angle = math.radians(self.most * share)
        turned = tuple(a * math.cos(angle) + s * math.sin(angle) for a, s in zip(along, self.swing))
        back = tuple((a * math.sin(angle) - s * math.cos(angle)) * self.thickness for a, s in zip(along, self.swing))
        tip = (begin[0] + turned[0] * self.length, begin[1] + turned[1] * self.length)
        corners = [begin, tip, (tip[0] + back[0], tip[1] + back[1]), (begin[0] + back[0], begin[1] + back[1])]
        return Polygon(corners)


@dataclass
class Door:
    name: str
    kind: str
    right: tuple
    left: tuple
    height: float
    status: str
    opening: float = 100.0
    leaves: list = field(default_factory=list)

    def outlines(self, share=None):
        """Its leaves as they stand, or open by a share of the most."""
        share = (self.opening / 100 if self.status == "open" else 0.0) if share is None else share
        return [leaf.outline(share, self.kind == "sliding") for leaf in self.leaves]


class World:
    def __init__(self, ortho):
        whole, plan = ortho.folder / "map.json", ortho.folder / "map.geojson"
        for file in (whole, plan):
            file.unlink(missing_ok=True)
        ortho.run("export", str(whole), "--geojson", str(plan))
        whole, plan = json.loads(whole.read_text()), json.loads(plan.read_text())
        features = {}
        for feature in plan["features"]:
            features.setdefault(feature["feature_type"], []).append(feature)
        assert plan["units"] == "m" and len(features["level"]) == 1, "buildings of one storey alone are read"
        self.map = features["level"][0]["properties"]["name"]["ru"]
        self.robot = whole["robot"]
        self.radius, self.height, self.step = (self.robot.get(key, 0) for key in ("radius", "height", "step"))
        self.clearance = self.robot.get("clearance", 0)
        self.rooms = {name_of(unit): Polygon(points(unit)[:-1]) for unit in features["unit"]}
        self.solids = [solid(fixture) for fixture in features.get("fixture", [])]
        self.doors = {}
        for opening in features.get("opening", []):
            door = self.door(opening, whole)
            self.doors[door.name] = door
        self.walls = [wall for outline in self.rooms.values() for wall in self.walls_of(outline)]

    def door(self, opening, whole):
        told = opening["properties"]
        name = name_of(opening) if "name" in told else opening["id"]
        right, left = points(opening)
        found = [(key, door) for key, door in whole["door"].items() if door.get("name", key) == name]
        if not found:
            return Door(name, "passage", right, left, 0.0, "open")
        (key, door), *others = found
        assert not others, name
        status = door.get("state", "open")
        made = Door(name, door["kind"], right, left, door["height"], status, door.get("opening", 100.0 if status == "open" else 0.0))
        leaves = door.get("leaves", [])
        mounts = [(area, mount) for area in whole["area"].values() for mount in area.get("doors", []) if mount["door"] == key]
        # The first of its rooms is to the left of its line.
        length = math.dist(right, left)
        along = ((left[0] - right[0]) / length, (left[1] - right[1]) / length)
        within = [area["name"] for area, mount in mounts if mount.get("opens", "inside") in ("inside", "внутрь")]
        swing = (-along[1], along[0])
        middle = ((right[0] + left[0]) / 2 + swing[0], (right[1] + left[1]) / 2 + swing[1])
        if not any(self.rooms[area].buffer(NEAR).contains(Point(middle)) for area in within):
            swing = (-swing[0], -swing[1])
        begin = 0.0
        for leaf in leaves:
            share = leaf.get("share") or 1 / len(leaves)
            ends = [tuple(r + a * length * t for r, a in zip(right, along)) for t in (begin, begin + share)]
            most = leaf.get("max_open", 90 if made.kind == "hinged" else 100)
            made.leaves.append(Leaf(*ends, swing, leaf["hinge"], leaf.get("thickness", 4), most))
            begin += share
        return made

    def walls_of(self, outline):
        """The sides of a room, without what doors and passages take of them."""
        holes = shapely.union_all([LineString([d.right, d.left]).buffer(NEAR, cap_style="flat") for d in self.doors.values()])
        ring = list(outline.exterior.coords)
        for side in zip(ring, ring[1:]):
            rest = LineString(side).difference(holes)
            yield from (piece for piece in shapely.get_parts(rest) if piece.length > NEAR)

    def in_the_way(self, height=None):
        """What stands between the step that the robot climbs and its height."""
        height = height or self.height
        return [solid for solid in self.solids if solid.top > self.step and solid.bottom < height]

    def opens(self, door):
        """Whether nothing stands in the way of its leaves."""
        things = shapely.union_all([solid.outline for solid in self.solids if solid.top > 2 and solid.bottom < (door.height or 200)])
        ways = [leaf.buffer(-0.2) for step in range(46) for leaf in door.outlines(step / 45)]
        return not any(way.intersects(things) for way in ways)

    def room_at(self, x, y):
        return next((name for name, outline in self.rooms.items() if outline.contains(Point(x, y))), None)


def name_of(feature):
    return feature["properties"]["name"]["ru"]


def points(feature):
    """Of a polygon its only ring."""
    shape = feature["geometry"]
    rings = shape["coordinates"] if shape["type"] == "Polygon" else [shape["coordinates"]]
    assert len(rings) == 1, feature["id"]
    return [(x * 100, y * 100) for x, y in rings[0]]


def solid(fixture):
    told = fixture["properties"]
    bottom = told["min_height"] * 100
    return Solid(name_of(fixture), Polygon(points(fixture)), bottom, bottom + told["height"] * 100)


def convex(outline):
    """It, or the triangles of which it is made."""
    if outline.area > 0.999 * outline.convex_hull.area:
        return [outline]
    return list(shapely.get_parts(shapely.constrained_delaunay_triangles(outline)))


def buildings(few=False):
    """Map files: ours, ten houses of ProcTHOR, and the worlds that pyrobosim brings."""
    found = importlib.util.find_spec("pyrobosim")
    if not found:
        raise ImportError("pyrobosim is missing")
    files = [Path("maps/rb2.toml"), Path("maps/lab.toml")]
    files += [Path(f"../shared/data/procthor/house_{number}.json") for number in range(10)]
    worlds = ("test_world.yaml", "pddlstream_simple_world.yaml", "roscon_2024_workshop_world.yaml")
    files += [Path(found.origin).parent / "data" / name for name in worlds]
    return files[:3] + files[-1:] if few else files


def free_places(world, count, dice):
    """Poses with their rooms, where the robot has its clearance, whatever doors do."""
    wide = world.radius + world.clearance + 0.5
    solids = [solid.outline for solid in world.in_the_way()] + world.walls
    leaves = [leaf for door in world.doors.values() for share in (0, 0.25, 0.5, 0.75, 1) for leaf in door.outlines(share)]
    taken = shapely.union_all([outline.buffer(wide) for outline in solids + leaves])
    free = [(name, room.difference(taken)) for name, room in world.rooms.items()]
    free = [(name, left) for name, left in free if left.area > 100]
    places = []
    while len(places) < count:
        name, left = dice.choices(free, [left.area for _, left in free])[0]
        low_x, low_y, high_x, high_y = left.bounds
        x, y = dice.uniform(low_x, high_x), dice.uniform(low_y, high_y)
        if left.contains(Point(x, y)):
            places.append((name, x, y, dice.uniform(0, 360)))
    return places


def name_places(ortho, places):
    """Has the map know them, as Goal 1 and so on."""
    edits = [{"point": f"Goal {number}", "area": area, "pose": [x, y], "heading": heading}
             for number, (area, x, y, heading) in enumerate(places, 1)]
    ortho.edit({"edit": edits})


def is_joined(world, ends, wide):
    """Whether a disc comes from one place to the other, by outlines grown by its radius; doors that are shut are opened, if nothing
    stands in the way of their leaves."""
    solids = [solid.outline for solid in world.in_the_way()] + world.walls
    leaves = []
    for door in world.doors.values():
        stands = door.status == "open" or not world.opens(door)
        leaves += door.outlines(None if stands else 1.0)
    floor = shapely.union_all(list(world.rooms.values()))
    pieces = shapely.get_parts(floor.difference(shapely.union_all([outline.buffer(wide) for outline in solids + leaves])))
    return any(all(piece.distance(Point(end[:2])) < 0.1 for end in ends) for piece in pieces)
