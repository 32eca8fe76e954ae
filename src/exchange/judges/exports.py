"""Reads what `ortho export` and `--tree` write by programs of another make: python3 exports.py ORTHO, in the repository's root.

Surfaces by trimesh, pictures by Pillow, YAML by PyYAML, route graphs by networkx, behaviour trees by BehaviorTree.CPP."""

import json
import math
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

try:
    import behaviortreepy
    import networkx
    import numpy
    import trimesh
    import yaml
    from PIL import Image
except ImportError as missing:
    print(missing)
    sys.exit(77)

ORTHO = sys.argv[1]
HERE = Path(tempfile.mkdtemp())


def run(*arguments):
    done = subprocess.run([ORTHO, *arguments], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, (arguments, done.returncode, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def store(name, file):
    path = str(HERE / name)
    run("--store", path, "import", str(file))
    return path


def area(ring):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) / 2


def a_surface_is_the_free_floor(at):
    """As large as the rooms less what the robot cannot cover, flat, facing upwards, its groups not overlapping."""
    file = HERE / "floor.obj"
    run("--store", at, "export", "--mesh", str(file))
    mesh = trimesh.load(file, force="mesh", process=False)
    assert len(mesh.faces) > 50 and (mesh.face_normals[:, 2] > 0.999).all(), mesh
    rooms = json.loads(geojson(at))
    floor = sum(area(ring[0][:-1]) for ring in polygons(rooms, "unit"))
    assert 0.3 * floor < mesh.area < floor, (mesh.area, floor)
    heights = {round(float(z), 3) for z in mesh.vertices[:, 2]}
    levels = {f["properties"]["elevation"] for f in rooms["features"] if f["feature_type"] == "level"}
    assert heights >= {round(z, 3) for z in levels}, (heights, levels)
    # No two triangles share a middle that lies in both.
    flat = [mesh.vertices[face] for face in mesh.faces]
    for no, face in enumerate(flat):
        middle = face.mean(axis=0)
        held = [k for k, other in enumerate(flat) if abs(other[0][2] - middle[2]) < 1e-6 and within(middle, other)]
        assert held == [no], (no, held)
    return mesh


def within(point, triangle):
    side = [(b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) for a, b in zip(triangle, numpy.roll(triangle, -1, axis=0))]
    return all(s > 1e-9 for s in side)


def geojson(at):
    file = HERE / "map.geojson"
    run("--store", at, "export", "--geojson", str(file))
    return file.read_text()


def polygons(collection, kind):
    for feature in collection["features"]:
        if feature["feature_type"] == kind:
            geometry = feature["geometry"]
            yield from [geometry["coordinates"]] if geometry["type"] == "Polygon" else geometry["coordinates"]


def picture(file):
    """Metres of the lower left corner, of a cell, and the values, the lowest row first."""
    sheet = yaml.safe_load(file.read_text())
    pixels = numpy.array(Image.open(file.parent / sheet["image"]))[::-1]
    return sheet, sheet["origin"], sheet["resolution"], pixels


def value_at(grid, x, y):
    _, (x0, y0, _), cell, pixels = grid
    return int(pixels[int((y - y0) / cell), int((x - x0) / cell)])


ZONES = """
[zone.wet]
name = "Мокрый пол"
kind = "closed"
points = [[20, 20], [80, 20], [80, 60], [20, 60]]

[zone.slow]
name = "Тихий ход"
kind = "slow"
speed = 25
points = [[150, 150], [230, 150], [230, 230], [150, 230]]

[zone.later]
name = "Потом"
kind = "keep-out"
points = [[100, 100], [140, 100], [140, 140], [100, 140]]
from = "2999-01-01T00:00Z"
"""


def zones_are_masks():
    file = HERE / "zoned.toml"
    file.write_text(Path("maps/rb2.toml").read_text() + ZONES)
    at = store("zoned", file)
    out = HERE / "masks"
    run("--store", at, "export", "--masks", str(out))
    kinds = {}
    for params in sorted(out.glob("*.params.yaml")):
        loaded = yaml.safe_load(params.read_text())
        info = next(v["ros__parameters"] for k, v in loaded.items() if k.endswith("costmap_filter_info_server"))
        mask = next(v["ros__parameters"] for k, v in loaded.items() if k.endswith("filter_mask_server"))
        assert info["mask_topic"] == mask["topic_name"]
        kinds[info["type"]] = (info, picture(out / mask["yaml_filename"]))
    assert sorted(kinds) == [0, 2], kinds
    keep_out, slow = kinds[0][1], kinds[2][1]
    for grid in (keep_out, slow):
        # As map_server reads mode raw: the grey is the value.
        assert grid[0]["mode"] == "raw" and grid[3].max() <= 100
    middle = lambda zone: [sum(p[a] for p in zone) / 400 for a in (0, 1)]
    wet, quiet, later = (middle(z) for z in ([[20, 20], [80, 20], [80, 60], [20, 60]], [[150, 150], [230, 150], [230, 230], [150, 230]], [[100, 100], [140, 100], [140, 140], [100, 140]]))
    assert value_at(keep_out, *wet) == 100 and value_at(keep_out, *quiet) == 0 and value_at(keep_out, *later) == 0
    info = kinds[2][0]
    limit = info["base"] + info["multiplier"] * value_at(slow, *quiet)
    assert math.isclose(limit, 0.25, abs_tol=1e-9), limit
    assert value_at(slow, *wet) == 0
    # The shut floor is as large as the zone.
    cell = keep_out[2]
    assert abs((keep_out[3] == 100).sum() * cell * cell - 0.6 * 0.4) < 0.03


def a_laser_meets_what_stands_at_its_height(at):
    out = HERE / "ros"
    run("--store", at, "export", "--ros", str(out), "--laser", "20", "--cell", "2")
    for sheet in out.glob("*-laser.yaml"):
        low = picture(sheet)
        assert low[0]["mode"] == "trinary" and set(numpy.unique(low[3])) <= {0, 205, 254}
        seen = 0
        for feature in json.loads(geojson(at))["features"]:
            if feature["feature_type"] != "fixture" or feature["geometry"]["type"] != "Polygon":
                continue
            bottom = feature["properties"]["min_height"]
            top = bottom + feature["properties"]["height"]
            ring = feature["geometry"]["coordinates"][0][:-1]
            x, y = (sum(p[a] for p in ring) / len(ring) for a in (0, 1))
            if len(ring) == 4 and bottom <= 0.2 < top and abs(area(ring)) > 0.01:
                assert value_at(low, x, y) == 0, feature["properties"]["name"]
                seen += 1
        assert seen >= 3, seen


def a_route_graph_leads_everywhere(at, storeys):
    file = HERE / "graph.geojson"
    run("--store", at, "export", "--nav2", str(file))
    collection = json.loads(file.read_text())
    graph, ids = networkx.DiGraph(), []
    for feature in collection["features"]:
        p, geometry = feature["properties"], feature["geometry"]
        ids.append(p["id"])
        if geometry["type"] == "Point":
            graph.add_node(p["id"], frame=p["frame"], at=geometry["coordinates"], **p.get("metadata", {}))
        else:
            graph.add_edge(p["startid"], p["endid"], cost=p["cost"], line=geometry["coordinates"][0], **p.get("metadata", {}))
    assert len(ids) == len(set(ids)) and set(graph.nodes) <= set(ids)
    for a, b, edge in graph.edges(data=True):
        assert edge["line"] == [graph.nodes[a]["at"], graph.nodes[b]["at"]]
        if "lift" not in edge:
            assert graph.nodes[a]["frame"] == graph.nodes[b]["frame"]
            assert abs(edge["cost"] - math.dist(*edge["line"])) < 1e-4
    assert networkx.is_strongly_connected(graph), [len(c) for c in networkx.strongly_connected_components(graph)]
    assert len({frame for _, frame in graph.nodes(data="frame")}) == storeys
    rides = [edge for *_, edge in graph.edges(data=True) if "lift" in edge]
    assert bool(rides) == (storeys > 1) and all(edge["seconds"] > 0 for edge in rides)
    return graph


def a_plan_is_a_behaviour_tree(at):
    file = HERE / "plan.xml"
    told = run("--store", at, "--json", "do", "Принеси лекарство", "--reset", "--tree", str(file))
    plan = json.loads(told.splitlines()[0])
    assert plan["event"] == "planned"
    root = xml.parse(file).getroot()
    assert root.tag == "root" and root.get("BTCPP_format") == "4"
    trees = root.findall("BehaviorTree")
    assert [tree.get("ID") for tree in trees] == [root.get("main_tree_to_execute")]
    sequence = trees[0].find("Sequence")
    words = [step["do_en"] for steps in plan["steps"] for step in steps]
    assert [s.get("name").split(". ", 1)[1] for s in sequence] == words
    # Every port is declared in the model; IDs and ports are names that BehaviorTree.CPP allows.
    model = {a.get("ID"): {p.get("name") for p in a} for a in root.find("TreeNodesModel")}
    actions = list(trees[0].iter("Action"))
    for action in actions:
        ports = set(action.attrib) - {"ID"}
        assert ports <= model[action.get("ID")], action.attrib
        assert all(re.fullmatch("[A-Za-z][A-Za-z0-9_]*", name) for name in ports | {action.get("ID")})
        assert not ports & {"name", "ID"}
    # The library itself runs it. Its Python side cannot declare ports, of which alone it then complains.
    done = []
    factory = behaviortreepy.BehaviorTreeFactory()
    for name in model:
        factory.register_simple_action(name, lambda node, name=name: done.append(name) or behaviortreepy.NodeStatus.SUCCESS)
    try:
        factory.create_tree_from_text(file.read_text())
        raise AssertionError("it was to ask for the ports")
    except RuntimeError as asked:
        assert "providedPorts" in str(asked), asked
    for action in actions:
        for port in set(action.attrib) - {"ID"}:
            del action.attrib[port]
    tree = factory.create_tree_from_text(xml.tostring(root, encoding="unicode"))
    assert tree.tick_while_running() == behaviortreepy.NodeStatus.SUCCESS
    assert done == [action.get("ID") for action in actions], done
    print(f"behaviour tree: {len(actions)} actions in {len(words)} directives")


flat = store("flat", "maps/rb2.toml")
house = store("house", "maps/two-storeys.toml")
mesh = a_surface_is_the_free_floor(flat)
print(f"surface: {len(mesh.faces)} triangles, {mesh.area:.2f} m²")
a_surface_is_the_free_floor(house)
zones_are_masks()
a_laser_meets_what_stands_at_its_height(flat)
a_route_graph_leads_everywhere(flat, 1)
graph = a_route_graph_leads_everywhere(house, 2)
print(f"route graph of two storeys: {graph.number_of_nodes()} nodes, {graph.number_of_edges()} edges")
a_plan_is_a_behaviour_tree(flat)
print("exports are read by others")
