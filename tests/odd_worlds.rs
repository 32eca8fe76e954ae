//! Odd worlds for tests of the floor: jigsaws whose pieces share corners or nearly do, rings, rows of rooms,
//! checkerboards, fans of needles, islands, screens end to end.

use orthoframe_geometry::Polygon;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floor_properties::Random;
use crate::floors::{Builder, Opening, Part, p, rectangle};

/// Displacements that nearly touch, touch or overlap by a hair, in cm.
const HAIRS: [f64; 9] = [0.0, 0.0, 0.0, 1e-9, 1e-6, 1e-4, 0.003, 0.02, 0.3];

pub(crate) fn pick<T: Copy>(random: &mut Random, of: &[T]) -> T {
    of[(random.unit() * of.len() as f64) as usize]
}

pub(crate) fn any_way(random: &mut Random) -> Vector {
    let (sin, cos) = random.between(0.0, std::f64::consts::TAU).sin_cos();
    Vector::new(cos, sin)
}

/// A world of the kind that the seed asks for, turned and moved as it asks for.
pub(crate) fn odd(seed: u64) -> Builder {
    let mut random = Random(seed.wrapping_mul(7919) + 31);
    let mut b = Builder::new();
    let radius = pick(&mut random, &[10.0, 17.0, 25.0, 31.7]);
    b.world.robot.radius = Cm::of(radius);
    b.world.robot.clearance = Cm::of(pick(&mut random, &[0.0, 0.0, 2.5]));
    match seed % 7 {
        0 => jigsaw(&mut b, &mut random),
        1 => ring(&mut b, &mut random),
        2 => row(&mut b, &mut random),
        3 => checkerboard(&mut b, &mut random),
        4 => fans(&mut b, &mut random),
        5 => islands(&mut b, &mut random),
        _ => screens(&mut b, &mut random),
    }
    // Every side has a name, so that what borders a Passframe can be asked for it.
    for orthoframe in b.world.orthoframes.values_mut() {
        let key = orthoframe.key.clone();
        orthoframe.base.iter_mut().for_each(|v| v.names = vec![format!("{key} {}", v.id)]);
    }
    match (random.unit() * 3.0) as u32 {
        0 => b,
        1 => b.moved(0.0, 0.0, random.between(0.0, 360.0)),
        _ => b.moved(1.0e6, -1.0e6, random.between(0.0, 360.0)),
    }
}

fn wide(b: &Builder) -> f64 {
    2.0 * (b.world.robot.radius.get() + b.world.robot.clearance.get())
}

/// The two parts of a convex polygon on both sides of a line, each drawn back from it.
pub(crate) fn cut(polygon: &[Point], at: Point, along: Vector, back: f64) -> [Vec<Point>; 2] {
    [1.0, -1.0].map(|sign| {
        let height = |q: &Point| sign * along.perp(&(q - at)) - back;
        let mut kept = Vec::new();
        for (i, a) in polygon.iter().enumerate() {
            let b = &polygon[(i + 1) % polygon.len()];
            let (from, to) = (height(a), height(b));
            if from >= 0.0 {
                kept.push(*a);
            }
            if from * to < 0.0 {
                kept.push(a + (b - a) * (from / (from - to)));
            }
        }
        kept
    })
}

/// A room cut into pieces by lines, some of them as wide as the robot; half of the pieces stand in it.
fn jigsaw(b: &mut Builder, random: &mut Random) {
    let area = b.area("Зал", &rectangle(640.0, 460.0), Frame::IDENTITY, &[]);
    let mut pieces = vec![rectangle(640.0, 460.0)];
    for _ in 0..4 {
        let back = if random.unit() < 0.5 {
            0.0
        } else {
            wide(b) / 2.0 + pick(random, &[0.0, 0.005, -0.03, 1.0, -1.0])
        };
        let (at, along) =
            (p(random.between(100.0, 540.0), random.between(80.0, 380.0)), any_way(random));
        pieces = pieces.iter().flat_map(|piece| cut(piece, at, along, back)).collect();
        pieces.retain(|piece| piece.len() > 2 && Polygon::new(piece.clone()).signed_area() > 1e-6);
    }
    for piece in pieces {
        if random.unit() < 0.55 {
            let off = any_way(random) * pick(random, &HAIRS);
            let object = b.object(&[(&piece, 0.0, 90.0)]);
            b.place_object(area, object, Frame::new(off.x, off.y, 0.0, Deg::ZERO));
        }
    }
}

/// A corridor that runs in a ring, of as many items as it has corners, with things across its walls.
fn ring(b: &mut Builder, random: &mut Random) {
    let count = 3 + (random.unit() * 6.0) as usize;
    let (inner, outer) = (random.between(90.0, 160.0), random.between(230.0, 380.0));
    let at = |k: usize, r: f64| {
        let (sin, cos) = (k as f64 * std::f64::consts::TAU / count as f64).sin_cos();
        p(r * cos, r * sin)
    };
    let blocks: Vec<Vec<Point>> = (0..count)
        .map(|k| {
            vec![at(k, inner), at(k, outer), at((k + 1) % count, outer), at((k + 1) % count, inner)]
        })
        .collect();
    let open = [(0, Opening::Passage), (2, Opening::Passage)];
    // One wall between two items in some.
    let shut = [(0, Opening::Passage)];
    let is_shut = random.unit() < 0.4;
    let parts: Vec<Part<'_>> = blocks
        .iter()
        .enumerate()
        .map(|(k, c)| {
            (&c[..], Frame::IDENTITY, if k == 0 && is_shut { &shut[..] } else { &open[..] })
        })
        .collect();
    let area = b.area_of("Кольцо", &parts, Frame::IDENTITY);
    for _ in 0..(random.unit() * 6.0) as usize {
        let place = Point::origin() + any_way(random) * random.between(inner, outer);
        let (w, d) = (random.between(5.0, 90.0), random.between(5.0, 60.0));
        b.put(area, place.x, place.y, w, d, random.between(0.0, 360.0), 90.0);
    }
}

/// Rooms in a row with doors of all kinds between them, hardly wider or narrower than the robot.
fn row(b: &mut Builder, random: &mut Random) {
    let gap = pick(random, &[0.0, 9.0, 40.0]);
    let (depth, low) = (random.between(200.0, 300.0), random.between(0.0, 60.0));
    let mut last: Option<(AreaId, DoorId)> = None;
    let mut x = 0.0;
    for k in 0..3 {
        let length = random.between(130.0, 320.0);
        let kind = pick(random, &[DoorKind::Hinged, DoorKind::Sliding, DoorKind::Passage]);
        let spare = pick(random, &[0.0, 0.01, -0.1, 3.0, 20.0, 60.0]);
        let width = (wide(b) + spare).min(depth - low - 5.0);
        let opening = pick(random, &[100.0, 100.0, 100.0, 60.0]);
        let state = DoorState { opening, ..DoorState::OPEN };
        let door = b.door(kind, width, state);
        let (mut corners, mut open) = (vec![p(0.0, 0.0), p(length, 0.0)], Vec::new());
        if k < 2 {
            corners.extend([p(length, low), p(length, low + width)]);
            open.push((corners.len() - 2, Opening::Door(door)));
        }
        corners.extend([p(length, depth), p(0.0, depth)]);
        if let Some((_, before)) = last {
            let width = b.world.doors[&before].width.get();
            corners.extend([p(0.0, low + width), p(0.0, low)]);
            open.push((corners.len() - 2, Opening::Door(before)));
        }
        corners.dedup();
        let area = b.area("Комната", &corners, Frame::new(x, 0.0, 0.0, Deg::ZERO), &open);
        if let Some((before, _)) = last {
            let mounts = |a: AreaId| b.world.areas[&a].doors.clone();
            let (one, other) = (mounts(before), mounts(area));
            let side = |m: &DoorMount| m.side[1..].parse().expect("sides are numbered");
            let shared = other.last().expect("the door just mounted");
            let same = one.iter().find(|m| m.door == shared.door).expect("its other side");
            let (s, t) = (side(same), side(shared));
            b.link(before, s, area, t);
            let mounted = &mut b.world.areas.get_mut(&area).expect("just made").doors;
            mounted
                .iter_mut()
                .filter(|m| m.door == shared.door)
                .for_each(|m| m.opens = OpensTo::Outside);
        }
        for _ in 0..(random.unit() * 4.0) as usize {
            let at = p(random.between(-20.0, length), random.between(-20.0, depth));
            let (w, d) = (random.between(3.0, 80.0), random.between(3.0, 50.0));
            b.put(area, at.x, at.y, w, d, random.between(0.0, 360.0), 90.0);
        }
        last = (k < 2).then_some((area, door));
        x += length + gap;
    }
}

/// Boxes on a lattice that the robot just fits into, touching in sides and corners.
fn checkerboard(b: &mut Builder, random: &mut Random) {
    let pitch = wide(b);
    let (columns, rows) = (4 + (random.unit() * 5.0) as usize, 4 + (random.unit() * 4.0) as usize);
    let room = rectangle(columns as f64 * pitch, rows as f64 * pitch);
    let area = b.area("Зал", &room, Frame::IDENTITY, &[]);
    let share = random.between(0.15, 0.5);
    for i in 0..columns {
        for j in 0..rows {
            if random.unit() < share {
                let hair = if random.unit() < 0.2 { pick(random, &HAIRS) } else { 0.0 };
                b.put(area, i as f64 * pitch + hair, j as f64 * pitch, pitch, pitch, 0.0, 90.0);
            }
        }
    }
}

/// Needles that share their tips, slivers in corners, big boards on small feet.
fn fans(b: &mut Builder, random: &mut Random) {
    let area = b.area("Зал", &rectangle(600.0, 480.0), Frame::IDENTITY, &[]);
    for _ in 0..3 {
        let tip = pick(random, &[p(0.0, 0.0), p(600.0, 200.0), p(300.0, 240.0), p(222.2, 111.1)]);
        for _ in 0..4 {
            let (way, length) = (any_way(random), random.between(40.0, 260.0));
            let thin = pick(random, &[1e-4, 1e-3, 0.01, 0.03, 0.2, 5.0]);
            let end = tip + way * length;
            let across = Vector::new(-way.y, way.x) * thin;
            let object = b.object(&[(&[tip, end - across, end + across], 0.0, 90.0)]);
            b.place_object(area, object, Frame::IDENTITY);
        }
    }
    // A pyramid on its tip, wider above than anything expects.
    let object = b.object(&[(&rectangle(60.0, 60.0), 0.0, 90.0)]);
    let base = b.world.objects[&object].items[0].orthoframe;
    b.world.orthoframes.get_mut(&base).expect("just made").roof_scale = random.between(0.0, 9.0);
    let (x, y) = (random.between(-300.0, 500.0), random.between(-300.0, 400.0));
    b.place_object(area, object, Frame::new(x, y, 0.0, Deg::of(random.between(0.0, 90.0))));
}

/// Rings within rings, each with a gap about as wide as the robot, or none.
fn islands(b: &mut Builder, random: &mut Random) {
    let area = b.area("Зал", &rectangle(700.0, 700.0), Frame::IDENTITY, &[]);
    let mut half = random.between(280.0, 330.0);
    while half > 40.0 {
        let (thick, turn) = (random.between(1.0, 15.0), Deg::of(random.between(0.0, 90.0)));
        let gap = (wide(b) + pick(random, &[0.0, 0.005, -0.03, 4.0, -400.0])).max(0.0);
        let long = 2.0 * half;
        let sides: [Vec<Point>; 5] = [
            (0.0, 0.0, (long - gap) / 2.0, thick),
            ((long + gap) / 2.0, 0.0, (long - gap) / 2.0, thick),
            (0.0, 0.0, thick, long),
            (long - thick, 0.0, thick, long),
            (0.0, long - thick, long, thick),
        ]
        .map(|(x, y, w, d)| {
            rectangle(w, d).iter().map(|c| c + Vector::new(x - half, y - half)).collect()
        });
        let parts: Vec<(&[Point], f64, f64)> = sides.iter().map(|s| (&s[..], 0.0, 90.0)).collect();
        let object = b.object(&parts);
        b.place_object(area, object, Frame::new(350.0, 350.0, 0.0, turn));
        half = half / 1.45 - thick - wide(b) * pick(random, &[0.5, 1.0, 0.3]);
    }
}

/// Screens without thickness, end to end or nearly; some twice.
fn screens(b: &mut Builder, random: &mut Random) {
    let area = b.area("Зал", &rectangle(660.0, 500.0), Frame::IDENTITY, &[]);
    for _ in 0..4 {
        let mut at = p(random.between(-20.0, 660.0), random.between(-20.0, 500.0));
        for _ in 0..4 {
            let turn = random.between(0.0, 360.0);
            let length = random.between(5.0, 160.0);
            let (sin, cos) = turn.to_radians().sin_cos();
            let thick = pick(random, &[0.0, 0.0, 1e-5, 0.015]);
            let copies = if random.unit() < 0.2 { 2 } else { 1 };
            for _ in 0..copies {
                b.put(area, at.x, at.y, length, thick, turn, 90.0);
            }
            at += Vector::new(cos, sin) * (length + pick(random, &HAIRS));
        }
    }
}

/// A world and its mirror image in the map's y-axis.
pub(crate) fn mirrored(b: &Builder) -> World {
    let mut world = b.world.clone();
    let flip = |f: &Frame| Frame::new(-f.x.get(), f.y.get(), f.z.get(), Deg::of(-f.angle.get()));
    for orthoframe in world.orthoframes.values_mut() {
        orthoframe.base.reverse();
        for v in &mut orthoframe.base {
            (v.start, v.end) = (p(-v.end.x, v.end.y), p(-v.start.x, v.start.y));
        }
    }
    let items = world.areas.values_mut().flat_map(|a| &mut a.items);
    items
        .chain(world.objects.values_mut().flat_map(|o| &mut o.items))
        .for_each(|i| i.frame = flip(&i.frame));
    world.replicas.values_mut().for_each(|r| r.frame = flip(&r.frame));
    for item in world.maps.values_mut().flat_map(|m| &mut m.items) {
        item.frame = flip(&item.frame);
    }
    for leaf in world.doors.values_mut().flat_map(|d| &mut d.leaves) {
        leaf.hinge = match leaf.hinge {
            HingeSide::Left => HingeSide::Right,
            HingeSide::Right => HingeSide::Left,
        };
    }
    world
}
