//! Recast (its Rust port, at cells of 5 cm) and polyanya on the same floors.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use orthoframe_geometry::{FloorPlan, Region, Scene};
use orthoframe_map::Permeability;
use orthoframe_units::{MapId, Point};
use polyanya::{Coords, Mesh, Triangulation};
use rerecast::{
    Aabb3d, AreaType, BuildContoursFlags, DetailNavmesh, HeightfieldBuilder, PolygonNavmesh,
    TriMesh,
};

use crate::generated::Generated;

/// A triangle in metres, y upwards; corners counter-clockwise from above.
type Triangle = [[f32; 3]; 3];

pub(crate) fn metres(p: Point, height: f64) -> [f32; 3] {
    // Recast's z grows towards the viewer: mirrored, so that floors look up.
    [p.x as f32 / 100.0, height as f32 / 100.0, -p.y as f32 / 100.0]
}

/// Floors, things as boxes without bottoms, and walls without thickness, open where doors are.
pub(crate) fn triangles(floor: &Generated) -> Vec<Triangle> {
    const WALL: f64 = 200.0;
    let scene = Scene::of(&floor.builder.world, MapId(1));
    let mut found = Vec::new();
    let cap = |found: &mut Vec<Triangle>, corners: &[Point], height: f64| {
        // All shapes are convex, or have their notches in one straight line.
        for i in 1..corners.len() - 1 {
            let at = [corners[0], corners[i], corners[i + 1]];
            found.push(at.map(|c| metres(c, height)));
        }
    };
    let wall = |found: &mut Vec<Triangle>, a: Point, b: Point, height: f64| {
        let corners = [metres(a, 0.0), metres(b, 0.0), metres(b, height), metres(a, height)];
        found.push([corners[0], corners[1], corners[2]]);
        found.push([corners[0], corners[2], corners[3]]);
    };
    for area in scene.areas.values() {
        for prism in &area.prisms {
            cap(&mut found, &prism.polygon.corners, prism.bottom);
            for (side, (a, b)) in prism.sides.iter().zip(prism.polygon.edges()) {
                if side.permeability == Permeability::Impermeable {
                    wall(&mut found, a, b, WALL);
                }
            }
        }
    }
    for replica in scene.replicas.values() {
        for prism in &replica.prisms {
            cap(&mut found, &prism.polygon.corners, prism.top);
            prism.polygon.edges().for_each(|(a, b)| wall(&mut found, a, b, prism.top));
        }
    }
    found
}

/// Cells are 5 cm wide and high.
const CELL: f32 = 0.05;
/// Beyond this many cells a floor is built in tiles, as Recast's 16-bit numbers ask for.
const LARGEST: f32 = 2600.0;
const TILE: f32 = 512.0;

/// What is kept of a tile: its polygons, and their heights if asked for.
pub(crate) type Tile = (PolygonNavmesh, Option<DetailNavmesh>);

/// Builds the navigation mesh, tile by tile where it is large.
pub(crate) fn recast(triangles: &[Triangle], radius: f64, with_detail: bool) -> Vec<Tile> {
    let corners = || triangles.iter().flatten();
    let low = [0, 2].map(|k| corners().map(|c| c[k]).fold(f32::INFINITY, f32::min));
    let high = [0, 2].map(|k| corners().map(|c| c[k]).fold(f32::NEG_INFINITY, f32::max));
    let walkable_radius = (radius as f32 / 100.0 / CELL).ceil() as u16;
    let border = walkable_radius + 3;
    let size = (high[0] - low[0]).max(high[1] - low[1]) / CELL;
    if size <= LARGEST {
        let whole = tile(triangles.iter(), low, high, walkable_radius, 0, with_detail);
        return whole.into_iter().collect();
    }
    let step = TILE * CELL;
    let pad = f32::from(border) * CELL;
    let columns = ((high[0] - low[0]) / step).ceil() as usize;
    let rows = ((high[1] - low[1]) / step).ceil() as usize;
    // Each tile is given the triangles that reach into it.
    let mut by_tile: Vec<Vec<u32>> = vec![Vec::new(); columns * rows];
    for (number, triangle) in (0..).zip(triangles) {
        let span = |k: usize, axis: usize, count: usize| {
            let least = triangle.iter().map(|c| c[axis]).fold(f32::INFINITY, f32::min);
            let most = triangle.iter().map(|c| c[axis]).fold(f32::NEG_INFINITY, f32::max);
            let place = |v: f32| (((v - low[k]) / step) as usize).min(count - 1);
            place((least - pad).max(low[k]))..=place(most + pad)
        };
        for row in span(1, 2, rows) {
            for column in span(0, 0, columns) {
                by_tile[row * columns + column].push(number);
            }
        }
    }
    let mut tiles = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let from = [low[0] + column as f32 * step, low[1] + row as f32 * step];
            let numbers = &by_tile[row * columns + column];
            tiles.extend(tile(
                numbers.iter().map(|&n| &triangles[n as usize]),
                from.map(|v| v - pad),
                from.map(|v| v + step + pad),
                walkable_radius,
                border,
                with_detail,
            ));
        }
    }
    tiles
}

/// Recast's own sequence of steps, with the settings of its demonstration.
fn tile<'a>(
    triangles: impl Iterator<Item = &'a Triangle>,
    low: [f32; 2],
    high: [f32; 2],
    walkable_radius: u16,
    border: u16,
    with_detail: bool,
) -> Option<Tile> {
    let mut mesh = TriMesh::default();
    for triangle in triangles {
        let first = mesh.vertices.len() as u32;
        triangle.iter().for_each(|&corner| mesh.vertices.push(corner.into()));
        mesh.indices.push([first, first + 1, first + 2].into());
        mesh.area_types.push(AreaType::NOT_WALKABLE);
    }
    mesh.mark_walkable_triangles(45.0_f32.to_radians());
    let centre = [(low[0] + high[0]) / 2.0, 1.5, (low[1] + high[1]) / 2.0];
    let half = [(high[0] - low[0]) / 2.0, 1.6, (high[1] - low[1]) / 2.0];
    let aabb = Aabb3d::new(centre, half);
    let (height, climb) = ((1.2 / CELL).ceil() as u16, (0.02 / CELL) as u16);
    let mut field = HeightfieldBuilder { aabb, cell_size: CELL, cell_height: CELL }
        .build()
        .expect("the floor is not too large");
    field.rasterize_triangles(&mesh, climb).expect("triangles within");
    field.filter_low_hanging_walkable_obstacles(climb);
    field.filter_ledge_spans(height, climb);
    field.filter_walkable_low_height_spans(height);
    let mut compact = field.into_compact(height, climb).expect("few layers");
    compact.erode_walkable_area(walkable_radius);
    compact.build_distance_field();
    compact.build_regions(border, 64, 400).expect("regions");
    let contours = compact.build_contours(1.3, walkable_radius * 8, BuildContoursFlags::default());
    // The port refuses a contour here and there on the rims of tiles; such a tile costs what it costs up to there.
    let polygons = contours.into_polygon_mesh(6).ok()?;
    let detail = with_detail.then(|| DetailNavmesh::new(&polygons, &compact, 6.0 * CELL, CELL));
    Some((polygons, detail.and_then(Result::ok)))
}

/// A piece of the plane: its outline, then its holes.
pub(crate) type Outline = Vec<Vec<[f64; 2]>>;

/// Where the robot's centre may be, over all rooms together.
pub(crate) fn outlines(plan: &FloorPlan) -> Vec<Outline> {
    // Rooms meet on the lines of their doorways; a hair's breadth welds them.
    let weld = |d: &orthoframe_geometry::Opening| {
        let (a, b) = d.line();
        let along = (b - a).normalize();
        let across = nalgebra::Vector2::new(-along.y, along.x) * 0.02;
        let inset = along * (plan.reach() + 0.01);
        let (a, b) = (a + inset, b - inset);
        [a - across, b - across, b + across, a + across].map(|p| [p.x, p.y]).to_vec()
    };
    let regions: Vec<Region> = plan.fragments().flat_map(|f| f.centre()).collect();
    let mut contours: Vec<Vec<[f64; 2]>> = regions
        .iter()
        .flat_map(Region::contours)
        .map(|c| c.corners.iter().map(|p| [p.x, p.y]).collect())
        .collect();
    contours.extend(plan.doorways().iter().map(|doorway| weld(doorway)));
    contours.overlay(&Vec::<Vec<[f64; 2]>>::new(), OverlayRule::Subject, FillRule::NonZero)
}

/// A mesh for each piece, merged as its documentation advises.
pub(crate) fn polyanya(outlines: &[Outline]) -> Vec<Mesh> {
    let mesh = |outline: &Outline| {
        let ring = |c: &Vec<[f64; 2]>| {
            c.iter().map(|p| [p[0] as f32, p[1] as f32].into()).collect::<Vec<_>>()
        };
        let mut triangulation = Triangulation::from_outer_edges(&ring(&outline[0]));
        triangulation.add_obstacles(outline[1..].iter().map(ring));
        let mut mesh = triangulation.as_navmesh();
        while mesh.merge_polygons() {}
        mesh.bake();
        mesh
    };
    outlines.iter().map(mesh).collect()
}

pub(crate) fn way(mesh: &Mesh, from: Point, to: Point) -> Option<f64> {
    let place = |p: Point| Coords::on_mesh([p.x as f32, p.y as f32].into());
    mesh.path(place(from), place(to)).map(|path| f64::from(path.length))
}
