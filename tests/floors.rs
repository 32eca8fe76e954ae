//! Small worlds built by hand, for tests and benches of geometry.

use std::collections::BTreeMap;
use std::sync::Arc;

use orthoframe_map::*;
use orthoframe_units::*;

/// Grows a world piece by piece; everything lies on Map 1.
pub(crate) struct Builder {
    pub(crate) world: World,
    next: u32,
}

/// What runs along a side of a room.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Opening {
    Passage,
    Door(DoorId),
}

pub(crate) fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// An item of an Area: corners, where it stands, and which of its sides are open.
pub(crate) type Part<'a> = (&'a [Point], Frame, &'a [(usize, Opening)]);

impl Builder {
    pub(crate) fn new() -> Self {
        let map = Map {
            id: MapId(1),
            key: "map".into(),
            name: "Карта".into(),
            name_en: "Map".into(),
            description: String::new(),
            map_type: None,
            frame: String::new(),
            items: vec![],
            links: vec![],
        };
        let domain = Domain {
            id: DomainId(1),
            key: "domain".into(),
            name: "Домейн".into(),
            name_en: "Domain".into(),
            description: String::new(),
            profile: Profile::Surveyed,
            maps: vec![DomainMap { map: MapId(1), frame: Frame::IDENTITY, is_base: true }],
            lifts: vec![],
        };
        let robot =
            RobotProfile { radius: Cm::of(25.0), clearance: Cm::ZERO, ..RobotProfile::default() };
        Self {
            world: World {
                domain,
                maps: [(MapId(1), map)].into_iter().collect(),
                robot,
                ..World::empty()
            },
            next: 1,
        }
    }

    fn id(&mut self) -> u32 {
        self.next += 1;
        self.next
    }

    pub(crate) fn orthoframe(
        &mut self,
        corners: &[Point],
        height: f64,
        side: impl Fn(usize) -> Permeability,
    ) -> OrFrId {
        let id = OrFrId(self.id());
        let n = corners.len();
        let base = (0..n)
            .map(|i| BaseVector {
                id: format!("S{i}"),
                start: corners[i],
                end: corners[(i + 1) % n],
                side_type: None,
                permeability: side(i),
                names: vec![],
                properties: Properties::new(),
            })
            .collect();
        self.world.orthoframes.insert(
            id,
            Orthoframe {
                id,
                key: format!("o{}", id.0),
                name: format!("О-{}", id.0),
                name_en: String::new(),
                description: String::new(),
                frame_type: None,
                shape: None,
                base,
                height: Cm::of(height),
                base_permeability: Permeability::Impermeable,
                roof_permeability: Permeability::Impermeable,
                roof_scale: 1.0,
                properties: Properties::new(),
            },
        );
        id
    }

    /// An Area from corners in its own frame; `open` names the sides that are passages or doors.
    pub(crate) fn area(
        &mut self,
        name: &str,
        corners: &[Point],
        frame: Frame,
        open: &[(usize, Opening)],
    ) -> AreaId {
        self.area_of(name, &[(corners, Frame::IDENTITY, open)], frame)
    }

    /// An Area of several items.
    pub(crate) fn area_of(&mut self, name: &str, parts: &[Part<'_>], frame: Frame) -> AreaId {
        let id = AreaId(self.id());
        let mut items = Vec::new();
        let mut doors = Vec::new();
        for (k, (corners, item_frame, open)) in parts.iter().enumerate() {
            let kind = |i: usize| match open.iter().find(|o| o.0 == i) {
                None => Permeability::Impermeable,
                Some((_, Opening::Passage)) => Permeability::Permeable,
                Some((_, Opening::Door(_))) => Permeability::Conditional,
            };
            let orthoframe = self.orthoframe(corners, 270.0, kind);
            let item = format!("I{k}");
            for (i, opening) in open.iter() {
                if let Opening::Door(door) = opening {
                    doors.push(DoorMount {
                        item: item.clone(),
                        side: format!("S{i}"),
                        door: *door,
                        opens: OpensTo::Inside,
                    });
                }
            }
            items.push(Item { id: item, orthoframe, frame: *item_frame, is_base: k == 0 });
        }
        self.world.areas.insert(
            id,
            Area {
                id,
                key: name.to_owned(),
                name: name.to_owned(),
                name_en: String::new(),
                description: String::new(),
                area_type: None,
                items,
                links: vec![],
                doors,
                properties: Properties::new(),
                forms: Forms::new(),
            },
        );
        let map = self.world.maps.get_mut(&MapId(1)).unwrap();
        let is_base = map.items.is_empty();
        map.items.push(MapItem { area: id, frame, is_base });
        id
    }

    pub(crate) fn link(&mut self, a: AreaId, side_a: usize, b: AreaId, side_b: usize) {
        let side = |i: usize| SideRef { item: "I0".into(), side: format!("S{i}") };
        self.world.maps.get_mut(&MapId(1)).unwrap().links.push(Arc::new(MapLink {
            area: a,
            side: side(side_a),
            to_area: b,
            to_side: side(side_b),
            rel_x: Cm::ZERO,
            rel_y: Cm::ZERO,
            rel_z: Cm::ZERO,
            rel_a: Deg::ZERO,
        }));
    }

    pub(crate) fn door(&mut self, kind: DoorKind, width: f64, state: DoorState) -> DoorId {
        let max_open = if kind == DoorKind::Hinged { 90.0 } else { 100.0 };
        let leaf =
            DoorLeaf { hinge: HingeSide::Right, share: 1.0, thickness: Cm::of(4.0), max_open };
        self.door_with(kind, width, state, vec![leaf])
    }

    pub(crate) fn door_with(
        &mut self,
        kind: DoorKind,
        width: f64,
        state: DoorState,
        leaves: Vec<DoorLeaf>,
    ) -> DoorId {
        let id = DoorId(self.id());
        self.world.doors.insert(
            id,
            Door {
                id,
                key: format!("d{}", id.0),
                name: format!("Дверь-{}", id.0),
                name_en: String::new(),
                door_type: None,
                kind,
                width: Cm::of(width),
                height: Cm::of(200.0),
                leaves,
                state,
                properties: Properties::new(),
                forms: Forms::new(),
            },
        );
        id
    }

    pub(crate) fn object(&mut self, parts: &[(&[Point], f64, f64)]) -> ObjectId {
        let id = ObjectId(self.id());
        let items = parts
            .iter()
            .enumerate()
            .map(|(k, (corners, bottom, height))| Item {
                id: format!("I{k}"),
                orthoframe: self.orthoframe(corners, *height, |_| Permeability::Impermeable),
                frame: Frame::new(0.0, 0.0, *bottom, Deg::ZERO),
                is_base: k == 0,
            })
            .collect();
        self.world.objects.insert(
            id,
            Object {
                id,
                key: format!("k{}", id.0),
                name: format!("Объект-{}", id.0),
                name_en: String::new(),
                description: String::new(),
                object_type: None,
                items,
                links: vec![],
                front: None,
                back: None,
                doors: vec![],
                properties: Properties::new(),
            },
        );
        id
    }

    pub(crate) fn place_object(
        &mut self,
        area: AreaId,
        object: ObjectId,
        frame: Frame,
    ) -> ReplicaId {
        let id = ReplicaId(self.id());
        self.world.replicas.insert(
            id,
            Replica {
                id,
                area,
                object,
                name: format!("Вещь-{}", id.0),
                name_en: String::new(),
                frame,
                move_prob: 0,
                properties: Properties::new(),
                door_states: BTreeMap::new(),
                forms: Forms::new(),
            },
        );
        id
    }

    /// A box of `w` × `d` × `height` on the floor, its corner at `(x, y)` of the Area, turned about it.
    #[expect(
        clippy::too_many_arguments,
        reason = "a table of boxes reads best with one line a box"
    )]
    pub(crate) fn put(
        &mut self,
        area: AreaId,
        x: f64,
        y: f64,
        w: f64,
        d: f64,
        turn: f64,
        height: f64,
    ) -> ReplicaId {
        let object = self.object(&[(&rectangle(w, d), 0.0, height)]);
        self.place_object(area, object, Frame::new(x, y, 0.0, Deg::of(turn)))
    }

    /// The world turned about the origin and moved.
    pub(crate) fn moved(mut self, x: f64, y: f64, turn: f64) -> Self {
        let outer = Frame::new(x, y, 0.0, Deg::of(turn));
        for item in &mut self.world.maps.get_mut(&MapId(1)).unwrap().items {
            item.frame = outer.compose(&item.frame);
        }
        self
    }
}

pub(crate) fn rectangle(w: f64, d: f64) -> Vec<Point> {
    vec![p(0.0, 0.0), p(w, 0.0), p(w, d), p(0.0, d)]
}

/// Two rooms of 400 × 300 side by side, a door of 90 between them, `gap` of wall.
///
/// ```text
///  +--------+ +--------+
///  |        | |        |
///  |  one   D D  two   |     the door at y = 100..190; side 2 of one, side 4 of two
///  |        | |        |
///  +--------+ +--------+
/// ```
pub(crate) fn two_rooms(
    gap: f64,
    kind: DoorKind,
    state: DoorState,
) -> (Builder, AreaId, AreaId, DoorId) {
    let mut b = Builder::new();
    let door = b.door(kind, 90.0, state);
    let one = b.area(
        "Комната-1",
        &[p(0., 0.), p(400., 0.), p(400., 100.), p(400., 190.), p(400., 300.), p(0., 300.)],
        Frame::IDENTITY,
        &[(2, Opening::Door(door))],
    );
    let two = b.area(
        "Комната-2",
        &[p(0., 0.), p(400., 0.), p(400., 300.), p(0., 300.), p(0., 190.), p(0., 100.)],
        Frame::new(400.0 + gap, 0.0, 0.0, Deg::ZERO),
        &[(4, Opening::Door(door))],
    );
    // Each Area mounts the door; it swings into the first.
    b.world.areas.get_mut(&two).unwrap().doors[0].opens = OpensTo::Outside;
    b.link(one, 2, two, 4);
    (b, one, two, door)
}
