//! Building models as real authoring tools write them: one solid in every notation gives one prism; rooms that no wall
//! parts are joined; stairs lead from storey to storey; every element of the file is in the report.

use orthoframe_exchange::{self as exchange, Imported, OpeningKind, Options, Survey, What};
use orthoframe_map::{DoorStatus, Permeability};
use orthoframe_units::{Point, Source};

/// A STEP text in the making; numbers are in the file's unit.
struct Model {
    text: String,
    next: u32,
    /// Units of the file in a centimetre.
    unit: f64,
}

impl Model {
    /// A project with one building, placed and turned; `#10` is the building's placement.
    fn new(unit: &str, cm: f64) -> Self {
        let mut model = Self { text: String::new(), next: 100, unit: cm };
        model.text += "ISO-10303-21;\nHEADER;FILE_SCHEMA(('IFC4'));ENDSEC;\nDATA;\n";
        model.text += unit;
        model.text += "#2=IFCUNITASSIGNMENT((#1));\n#3=IFCPROJECT('p',$,'P',$,$,$,$,$,#2);\n";
        model
    }

    fn metres() -> Self {
        Self::new("#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n", 0.01)
    }

    fn add(&mut self, record: &str) -> u32 {
        self.next += 1;
        self.text += &format!("#{}={record};\n", self.next);
        self.next
    }

    fn numbers(&self, cm: &[f64]) -> String {
        let numbers: Vec<String> = cm.iter().map(|x| format!("{:.9}", x * self.unit)).collect();
        format!("({})", numbers.join(","))
    }

    fn point(&mut self, cm: &[f64]) -> u32 {
        let numbers = self.numbers(cm);
        self.add(&format!("IFCCARTESIANPOINT({numbers})"))
    }

    fn axis(&mut self, cm: [f64; 3], turn: f64) -> u32 {
        let at = self.point(&cm);
        let (sin, cos) = turn.to_radians().sin_cos();
        let z = self.add("IFCDIRECTION((0.,0.,1.))");
        let x = self.add(&format!("IFCDIRECTION(({cos:.12},{sin:.12},0.))"));
        self.add(&format!("IFCAXIS2PLACEMENT3D(#{at},#{z},#{x})"))
    }

    fn placement(&mut self, within: Option<u32>, cm: [f64; 3], turn: f64) -> u32 {
        let axis = self.axis(cm, turn);
        let within = within.map_or_else(|| "$".to_owned(), |id| format!("#{id}"));
        self.add(&format!("IFCLOCALPLACEMENT({within},#{axis})"))
    }

    fn storey(&mut self, name: &str, z: f64) -> (u32, u32) {
        let place = self.placement(None, [0.0, 0.0, z], 0.0);
        let z = z * self.unit;
        let storey = self.add(&format!(
            "IFCBUILDINGSTOREY('{name}',$,'{name}',$,$,#{place},$,$,.ELEMENT.,{z:.9})"
        ));
        (storey, place)
    }

    fn polyline(&mut self, ring: &[[f64; 2]]) -> u32 {
        let mut points: Vec<String> = ring.iter().map(|p| format!("#{}", self.point(p))).collect();
        points.push(points[0].clone());
        self.add(&format!("IFCPOLYLINE(({}))", points.join(",")))
    }

    fn extruded(&mut self, ring: &[[f64; 2]], z: f64, height: f64) -> u32 {
        let curve = self.polyline(ring);
        let profile = self.add(&format!("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#{curve})"));
        self.lifted(profile, z, height)
    }

    fn lifted(&mut self, profile: u32, z: f64, height: f64) -> u32 {
        let axis = self.axis([0.0, 0.0, z], 0.0);
        let up = self.add("IFCDIRECTION((0.,0.,1.))");
        let height = height * self.unit;
        self.add(&format!("IFCEXTRUDEDAREASOLID(#{profile},#{axis},#{up},{height:.9})"))
    }

    fn shape(&mut self, identifier: &str, items: &[u32]) -> u32 {
        let items: Vec<String> = items.iter().map(|id| format!("#{id}")).collect();
        let items = items.join(",");
        let shape = self.add(&format!("IFCSHAPEREPRESENTATION($,'{identifier}','x',({items}))"));
        self.add(&format!("IFCPRODUCTDEFINITIONSHAPE($,$,(#{shape}))"))
    }

    fn space(&mut self, storey: (u32, u32), name: &str, ring: &[[f64; 2]]) -> u32 {
        let place = self.placement(Some(storey.1), [0.0; 3], 0.0);
        let body = self.extruded(ring, 0.0, 270.0);
        let shape = self.shape("Body", &[body]);
        let space = self.add(&format!(
            "IFCSPACE('{name}',$,'{name}',$,$,#{place},#{shape},$,.ELEMENT.,.INTERNAL.,$)"
        ));
        self.add(&format!("IFCRELAGGREGATES('in-{name}',$,$,$,#{},(#{space}))", storey.0));
        space
    }

    fn element(&mut self, class: &str, id: &str, storey: (u32, u32), shape: Option<u32>) -> u32 {
        let place = self.placement(Some(storey.1), [0.0; 3], 0.0);
        let shape = shape.map_or_else(|| "$".to_owned(), |s| format!("#{s}"));
        let element = self.add(&format!("{class}('{id}',$,'Table',$,$,#{place},{shape},$)"));
        self.add(&format!(
            "IFCRELCONTAINEDINSPATIALSTRUCTURE('c-{id}',$,$,$,(#{element}),#{})",
            storey.0
        ));
        element
    }

    fn source(&self) -> Source {
        Source::new("model.ifc", format!("{}ENDSEC;\nEND-ISO-10303-21;\n", self.text))
    }

    fn read(&self) -> Survey {
        exchange::ifc::read(&self.source()).unwrap_or_else(|e| panic!("{e}\n{}", self.text))
    }

    fn imported(&self) -> Imported {
        let dir = tempfile::tempdir().expect("a folder");
        let path = dir.path().join("model.ifc");
        std::fs::write(&path, self.source().text()).expect("written");
        exchange::read(&path, &Options::default()).unwrap_or_else(|e| panic!("{e}"))
    }
}

fn rect(x: f64, y: f64, w: f64, d: f64) -> [[f64; 2]; 4] {
    [[x, y], [x + w, y], [x + w, y + d], [x, y + d]]
}

fn area(ring: &[Point]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    (ring.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>() / 2.0).abs()
}

/// Corners and faces of a box of 120 × 60 × 75 about the origin's corner.
const SIZE: [f64; 3] = [120.0, 60.0, 75.0];
const FACES: [[usize; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn corners() -> Vec<[f64; 3]> {
    let [w, d, h] = SIZE;
    [0.0, h].iter().flat_map(|&z| rect(0.0, 0.0, w, d).map(|[x, y]| [x, y, z])).collect()
}

fn faces(m: &mut Model) -> Vec<String> {
    let points: Vec<u32> = corners().iter().map(|c| m.point(c)).collect();
    let mut faces = Vec::new();
    for (k, face) in FACES.iter().enumerate() {
        let ring: Vec<String> = face.iter().map(|i| format!("#{}", points[*i])).collect();
        let ring = m.add(&format!("IFCPOLYLOOP(({}))", ring.join(",")));
        // Exporters do not care which way the faces of a surface model look.
        let sense = if k % 2 == 0 { "T" } else { "F" };
        let bound = m.add(&format!("IFCFACEOUTERBOUND(#{ring},.{sense}.)"));
        faces.push(format!("#{}", m.add(&format!("IFCFACE((#{bound}))"))));
    }
    faces
}

fn list(m: &Model) -> String {
    let points: Vec<String> = corners().iter().map(|c| m.numbers(c)).collect();
    format!("IFCCARTESIANPOINTLIST3D(({}))", points.join(","))
}

type Notation = (&'static str, fn(&mut Model) -> u32);

/// One box in every notation.
const NOTATIONS: &[Notation] = &[
    ("extruded polyline", |m| m.extruded(&rect(0.0, 0.0, SIZE[0], SIZE[1]), 0.0, SIZE[2])),
    ("extruded rectangle", |m| {
        let at = m.point(&[60.0, 30.0]);
        let at = m.add(&format!("IFCAXIS2PLACEMENT2D(#{at},$)"));
        let n = m.numbers(&SIZE);
        let n: Vec<&str> = n.trim_matches(['(', ')']).split(',').collect();
        let (x, y) = (n[0].to_owned(), n[1].to_owned());
        let profile = m.add(&format!("IFCRECTANGLEPROFILEDEF(.AREA.,$,#{at},{x},{y})"));
        m.lifted(profile, 0.0, SIZE[2])
    }),
    ("indexed polycurve", |m| {
        let ring: Vec<String> =
            rect(0.0, 0.0, SIZE[0], SIZE[1]).iter().map(|p| m.numbers(p)).collect();
        let list = m.add(&format!("IFCCARTESIANPOINTLIST2D(({}))", ring.join(",")));
        let curve = m.add(&format!(
            "IFCINDEXEDPOLYCURVE(#{list},(IFCLINEINDEX((1,2)),IFCLINEINDEX((2,3,4)),IFCLINEINDEX((4,1))),.F.)"
        ));
        let profile = m.add(&format!("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#{curve})"));
        m.lifted(profile, 0.0, SIZE[2])
    }),
    ("faceted brep", |m| {
        let faces = faces(m).join(",");
        let shell = m.add(&format!("IFCCLOSEDSHELL(({faces}))"));
        m.add(&format!("IFCFACETEDBREP(#{shell})"))
    }),
    ("face-based surface model", |m| {
        let faces = faces(m).join(",");
        let set = m.add(&format!("IFCCONNECTEDFACESET(({faces}))"));
        m.add(&format!("IFCFACEBASEDSURFACEMODEL((#{set}))"))
    }),
    ("shell-based surface model", |m| {
        let faces = faces(m);
        let one = m.add(&format!("IFCOPENSHELL(({}))", faces[..2].join(",")));
        let other = m.add(&format!("IFCOPENSHELL(({}))", faces[2..].join(",")));
        m.add(&format!("IFCSHELLBASEDSURFACEMODEL((#{one},#{other}))"))
    }),
    ("upright sheets alone", |m| {
        let faces = faces(m);
        let set = m.add(&format!("IFCCONNECTEDFACESET(({}))", faces[2..].join(",")));
        m.add(&format!("IFCFACEBASEDSURFACEMODEL((#{set}))"))
    }),
    ("triangulated face set", |m| {
        let list = list(m);
        let list = m.add(&list);
        let triangles: Vec<String> = FACES
            .iter()
            .flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]])
            .map(|t| format!("({},{},{})", t[0] + 1, t[1] + 1, t[2] + 1))
            .collect();
        m.add(&format!("IFCTRIANGULATEDFACESET(#{list},$,.T.,({}),$)", triangles.join(",")))
    }),
    ("polygonal face set", |m| {
        let list = list(m);
        let list = m.add(&list);
        let faces: Vec<String> = FACES
            .iter()
            .map(|f| format!("({},{},{},{})", f[0] + 1, f[1] + 1, f[2] + 1, f[3] + 1))
            .map(|f| format!("#{}", m.add(&format!("IFCINDEXEDPOLYGONALFACE({f})"))))
            .collect();
        m.add(&format!("IFCPOLYGONALFACESET(#{list},.T.,({}),$)", faces.join(",")))
    }),
    ("mapped and doubled", |m| {
        let half = rect(0.0, 0.0, SIZE[0] / 2.0, SIZE[1] / 2.0);
        let body = m.extruded(&half, 0.0, SIZE[2] / 2.0);
        let shape = m.add(&format!("IFCSHAPEREPRESENTATION($,'Body','x',(#{body}))"));
        let origin = m.axis([0.0; 3], 0.0);
        let map = m.add(&format!("IFCREPRESENTATIONMAP(#{origin},#{shape})"));
        let at = m.point(&[0.0, 0.0, 0.0]);
        let to = m.add(&format!("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#{at},2.,$)"));
        m.add(&format!("IFCMAPPEDITEM(#{map},#{to})"))
    }),
    ("mirrored map", |m| {
        let body = m.extruded(&rect(-SIZE[0], 0.0, SIZE[0], SIZE[1]), 0.0, SIZE[2]);
        let shape = m.add(&format!("IFCSHAPEREPRESENTATION($,'Body','x',(#{body}))"));
        let origin = m.axis([0.0; 3], 0.0);
        let map = m.add(&format!("IFCREPRESENTATIONMAP(#{origin},#{shape})"));
        let at = m.point(&[0.0, 0.0, 0.0]);
        let (x, y) = (m.add("IFCDIRECTION((-1.,0.,0.))"), m.add("IFCDIRECTION((0.,1.,0.))"));
        let to = m.add(&format!("IFCCARTESIANTRANSFORMATIONOPERATOR3D(#{x},#{y},#{at},1.,$)"));
        m.add(&format!("IFCMAPPEDITEM(#{map},#{to})"))
    }),
    ("clipped by half spaces", |m| {
        let mut body = m.extruded(&rect(0.0, 0.0, 300.0, SIZE[1]), 0.0, 200.0);
        for (at, normal) in
            [([SIZE[0], 0.0, 0.0], "(1.,0.,0.)"), ([0.0, 0.0, SIZE[2]], "(0.,0.,1.)")]
        {
            let at = m.point(&at);
            let z = m.add(&format!("IFCDIRECTION({normal})"));
            let x = m.add("IFCDIRECTION((0.,1.,0.))");
            let axis = m.add(&format!("IFCAXIS2PLACEMENT3D(#{at},#{z},#{x})"));
            let plane = m.add(&format!("IFCPLANE(#{axis})"));
            let half = m.add(&format!("IFCHALFSPACESOLID(#{plane},.F.)"));
            body = m.add(&format!("IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#{body},#{half})"));
        }
        body
    }),
    ("less another solid", |m| {
        let body = m.extruded(&rect(0.0, 0.0, 300.0, SIZE[1]), 0.0, SIZE[2]);
        let other = m.extruded(&rect(SIZE[0], -10.0, 300.0, 200.0), -5.0, 300.0);
        m.add(&format!("IFCBOOLEANRESULT(.DIFFERENCE.,#{body},#{other})"))
    }),
    ("block", |m| {
        let axis = m.axis([0.0; 3], 0.0);
        let n = m.numbers(&SIZE);
        let n = n.trim_matches(['(', ')']).to_owned();
        let block = m.add(&format!("IFCBLOCK(#{axis},{n})"));
        m.add(&format!("IFCCSGSOLID(#{block})"))
    }),
    ("bounding box", |m| {
        let at = m.point(&[0.0, 0.0, 0.0]);
        let n = m.numbers(&SIZE);
        let n = n.trim_matches(['(', ')']).to_owned();
        m.add(&format!("IFCBOUNDINGBOX(#{at},{n})"))
    }),
    ("advanced brep", |m| {
        let points: Vec<u32> = corners().iter().map(|c| m.point(c)).collect();
        let vertices: Vec<u32> =
            points.iter().map(|p| m.add(&format!("IFCVERTEXPOINT(#{p})"))).collect();
        let mut faces = Vec::new();
        for face in FACES {
            let mut edges = Vec::new();
            for k in 0..4 {
                let (a, b) = (vertices[face[k]], vertices[face[(k + 1) % 4]]);
                let edge = m.add(&format!("IFCEDGECURVE(#{a},#{b},$,.T.)"));
                edges.push(format!("#{}", m.add(&format!("IFCORIENTEDEDGE(*,*,#{edge},.T.)"))));
            }
            let ring = m.add(&format!("IFCEDGELOOP(({}))", edges.join(",")));
            let bound = m.add(&format!("IFCFACEOUTERBOUND(#{ring},.T.)"));
            let axis = m.axis([0.0; 3], 0.0);
            let plane = m.add(&format!("IFCPLANE(#{axis})"));
            faces.push(format!("#{}", m.add(&format!("IFCADVANCEDFACE((#{bound}),#{plane},.T.)"))));
        }
        let shell = m.add(&format!("IFCCLOSEDSHELL(({}))", faces.join(",")));
        m.add(&format!("IFCADVANCEDBREP(#{shell})"))
    }),
];

#[test]
fn a_box_is_the_same_box_in_every_notation_and_unit() {
    let feet = "#4=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#5=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(0.3048),#4);\n\
                #1=IFCCONVERSIONBASEDUNIT(#6,.LENGTHUNIT.,'FOOT',#5);\n";
    let units = [
        ("#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n", 0.01),
        ("#1=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n", 10.0),
        (feet, 1.0 / 30.48),
    ];
    for (unit, cm) in units {
        let mut m = Model::new(unit, cm);
        let storey = m.storey("1", 300.0);
        m.space(storey, "hall", &rect(-500.0, -500.0, 1000.0, 1000.0));
        for (name, body) in NOTATIONS {
            let item = body(&mut m);
            let shape = m.shape("Body", &[item]);
            let outer = m.placement(Some(storey.1), [100.0, 50.0, 0.0], 90.0);
            let place = m.placement(Some(outer), [20.0, 0.0, 10.0], -60.0);
            m.add(&format!("IFCFURNISHINGELEMENT('{name}',$,'{name}',$,$,#{place},#{shape},$)"));
        }
        let survey = m.read();
        let things = &survey.levels[0].things;
        assert_eq!(things.len(), NOTATIONS.len(), "{:?}", survey.told);
        for thing in things {
            let (name, parts) = (&thing.source, &survey.kinds[thing.kind].parts);
            let [part] = &parts[..] else { panic!("{name}: {parts:?}") };
            let whole = area(&part.outline);
            assert!((whole - SIZE[0] * SIZE[1]).abs() < 2.0, "{name}: {whole} {:?}", part.outline);
            assert!((part.height.get() - SIZE[2]).abs() < 0.02, "{name}: {:?}", part.height);
            assert!((thing.z.get() - 10.0).abs() < 0.02, "{name}: {:?}", thing.z);
            // The corner at the thing's origin, and the place that two placements in one another make.
            let least = part.outline.iter().map(|p| p.coords.norm()).fold(f64::INFINITY, f64::min);
            assert!(least < 0.05, "{name}: {:?}", part.outline);
            assert!((thing.at - Point::new(100.0, 70.0)).norm() < 0.02, "{name}: {:?}", thing.at);
            assert!((thing.angle.get() - 30.0).abs() < 1e-3, "{name}: {:?}", thing.angle);
        }
        assert!(survey.told.is_empty(), "{:?}", survey.told);
    }
}

#[test]
fn a_room_of_faces_is_a_room() {
    let mut m = Model::metres();
    let storey = m.storey("1", 0.0);
    for (k, (name, body)) in NOTATIONS.iter().enumerate() {
        let item = body(&mut m);
        let shape = m.shape("Body", &[item]);
        let place = m.placement(Some(storey.1), [200.0 * k as f64, 0.0, 0.0], 0.0);
        let room = m.add(&format!(
            "IFCSPACE('{name}',$,'{k}',$,$,#{place},#{shape},$,.ELEMENT.,.INTERNAL.,$)"
        ));
        m.add(&format!("IFCRELAGGREGATES('a{k}',$,$,$,#{},(#{room}))", storey.0));
    }
    let survey = m.read();
    assert_eq!(survey.levels[0].rooms.len(), NOTATIONS.len(), "{:?}", survey.told);
    for (k, room) in survey.levels[0].rooms.iter().enumerate() {
        let whole = area(&room.outline);
        assert!((whole - SIZE[0] * SIZE[1]).abs() < 2.0, "{}: {whole}", room.source);
        assert_eq!(room.height.map(|h| h.get().round()), Some(SIZE[2]), "{}", room.source);
        let left = room.outline.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
        assert!((left - 200.0 * k as f64).abs() < 0.01, "{}: {left}", room.source);
    }
}

#[test]
fn doors_of_which_the_file_tells_no_state_stand_open() {
    let mut m = Model::metres();
    let storey = m.storey("1", 0.0);
    m.space(storey, "a", &rect(0.0, 0.0, 400.0, 300.0));
    m.space(storey, "b", &rect(410.0, 0.0, 400.0, 300.0));
    let place = m.placement(Some(storey.1), [405.0, 100.0, 0.0], 90.0);
    m.add(&format!("IFCDOOR('d',$,'D',$,$,#{place},$,$,2.1,0.9,.DOOR.,.SINGLE_SWING_LEFT.,$)"));
    let world = m.imported().world;
    let states: Vec<DoorStatus> = world.doors.values().map(|d| d.state.status).collect();
    assert_eq!(states, [DoorStatus::Open]);
}

/// Two rooms side by side, their virtual boundary told in one of the ways that exporters have.
fn open_plan(told: fn(&mut Model, u32, u32)) -> Survey {
    let mut m = Model::metres();
    let storey = m.storey("1", 0.0);
    let living = m.space(storey, "living", &rect(0.0, 0.0, 500.0, 400.0));
    let kitchen = m.space(storey, "kitchen", &rect(500.0, 0.0, 300.0, 300.0));
    m.space(storey, "bath", &rect(0.0, 410.0, 300.0, 300.0));
    told(&mut m, living, kitchen);
    m.read()
}

fn surface(m: &mut Model) -> u32 {
    let at = m.point(&[500.0, 0.0, 0.0]);
    let z = m.add("IFCDIRECTION((1.,0.,0.))");
    let x = m.add("IFCDIRECTION((0.,1.,0.))");
    let axis = m.add(&format!("IFCAXIS2PLACEMENT3D(#{at},#{z},#{x})"));
    let plane = m.add(&format!("IFCPLANE(#{axis})"));
    let curve = m.polyline(&rect(0.0, 0.0, 300.0, 270.0));
    let surface = m.add(&format!("IFCCURVEBOUNDEDPLANE(#{plane},#{curve},())"));
    m.add(&format!("IFCCONNECTIONSURFACEGEOMETRY(#{surface},$)"))
}

#[test]
fn where_only_a_virtual_boundary_parts_two_rooms_there_is_a_passage() {
    let ways: [fn(&mut Model, u32, u32); 3] = [
        // Revit's: both rooms tell the surface, no element makes it.
        |m, living, kitchen| {
            for (k, room) in [living, kitchen].into_iter().enumerate() {
                let at = surface(m);
                m.add(&format!(
                    "IFCRELSPACEBOUNDARY('b{k}',$,'1stLevel',$,#{room},$,#{at},.VIRTUAL.,.INTERNAL.)"
                ));
            }
        },
        // ArchiCAD's: a virtual element between them, each with a piece of the surface.
        |m, living, kitchen| {
            let element = m.add("IFCVIRTUALELEMENT('v',$,$,$,$,$,$,$)");
            for (k, room) in [living, kitchen].into_iter().enumerate() {
                let at = surface(m);
                m.add(&format!(
                    "IFCRELSPACEBOUNDARY2NDLEVEL('b{k}',$,'2ndLevel',$,#{room},#{element},#{at},.VIRTUAL.,.INTERNAL.,$,$)"
                ));
            }
        },
        // The least: two rooms share an element that is nowhere.
        |m, living, kitchen| {
            let element = m.add("IFCVIRTUALELEMENT('v',$,$,$,$,$,$,$)");
            for (k, room) in [living, kitchen].into_iter().enumerate() {
                m.add(&format!(
                    "IFCRELSPACEBOUNDARY('b{k}',$,$,$,#{room},#{element},$,.VIRTUAL.,.INTERNAL.)"
                ));
            }
        },
    ];
    for told in ways {
        let survey = open_plan(told);
        let [passage] = &survey.levels[0].openings[..] else {
            panic!("{:?}", survey.levels[0].openings)
        };
        assert_eq!(passage.what, OpeningKind::Passage);
        assert_eq!(passage.rooms, Some([Some(0), Some(1)]));
        let width = (passage.jambs[1] - passage.jambs[0]).norm();
        assert!((width - 300.0).abs() < 1.0, "{width}");
        assert!(passage.jambs.iter().all(|p| (p.x - 500.0).abs() < 1.0));
    }
    // A physical one is a wall, and one that is told of one room only is no way to another.
    let survey = open_plan(|m, living, kitchen| {
        let at = surface(m);
        m.add(&format!(
            "IFCRELSPACEBOUNDARY('b',$,'1stLevel',$,#{living},$,#{at},.PHYSICAL.,.INTERNAL.)"
        ));
        m.add(&format!("IFCRELSPACEBOUNDARY('c',$,$,$,#{kitchen},$,$,.VIRTUAL.,.INTERNAL.)"));
    });
    assert!(survey.levels[0].openings.is_empty());
}

/// A flight of 14 steps along +x from (0, 0), 100 wide, up to 280.
fn flight(m: &mut Model) -> Vec<u32> {
    let step = |k: i32| (f64::from(k) * 25.0, f64::from(k) * 20.0);
    (0..14).map(|k| m.extruded(&rect(step(k).0, 0.0, 25.0, 100.0), step(k).1, 20.0)).collect()
}

#[test]
fn stairs_lead_from_storey_to_storey() {
    let mut m = Model::metres();
    let (below, above) = (m.storey("1", 0.0), m.storey("2", 280.0));
    for storey in [below, above] {
        let name = if storey == below { "hall" } else { "landing" };
        m.space(storey, name, &rect(-200.0, -50.0, 800.0, 400.0));
    }
    let steps = flight(&mut m);
    let shape = m.shape("Body", &steps);
    let place = m.placement(Some(below.1), [0.0, 50.0, 0.0], 0.0);
    let whole = m.add("IFCSTAIR('stair',$,'Stair:Residential:1',$,$,$,$,$,.STRAIGHT_RUN_STAIR.)");
    let run =
        m.add(&format!("IFCSTAIRFLIGHT('run',$,'Run 1',$,$,#{place},#{shape},$,14,14,0.2,0.25)"));
    let rail = m.element("IFCRAILING", "rail", below, None);
    m.add(&format!("IFCRELAGGREGATES('r',$,$,$,#{whole},(#{run},#{rail}))"));
    m.add(&format!("IFCRELCONTAINEDINSPATIALSTRUCTURE('c',$,$,$,(#{whole}),#{})", below.0));
    let survey = m.read();
    let [lift] = &survey.lifts[..] else { panic!("{:?} {:?}", survey.lifts, survey.told) };
    assert_eq!((lift.name.as_str(), lift.stops.len()), ("Stair", 2));
    for (k, (level, room)) in lift.stops.iter().enumerate() {
        let storey = &survey.levels[*level];
        assert_eq!(storey.rooms[*room].kind, "stairs");
        assert!((area(&storey.rooms[*room].outline) - 35_000.0).abs() < 10.0);
        let [way] = &storey.openings[..] else { panic!("{:?}", storey.openings) };
        // Below one steps on it at its foot, above at its head.
        let x = if k == 0 { 0.0 } else { 350.0 };
        assert!(way.jambs.iter().all(|p| (p.x - x).abs() < 0.1), "{k}: {:?}", way.jambs);
    }
    let imported = m.imported();
    let world = &imported.world;
    let [(_, stops)] = &world.domain.lifts[..] else { panic!("{:?}", world.domain.lifts) };
    assert!(stops.iter().all(|s| world.area_has_trait(s.area, "stairs")), "{}", imported.report);
    let joined: Vec<usize> = world.doors.keys().map(|&d| world.door_areas(d).len()).collect();
    assert_eq!(joined, [2, 2], "{}", imported.report);
    assert_eq!(imported.report.counts[&What::Lift].taken, 1);
}

#[test]
fn every_element_of_the_file_is_in_the_report() {
    let mut m = Model::metres();
    let storey = m.storey("1", 0.0);
    let attic = m.storey("2", 300.0);
    m.space(storey, "hall", &rect(-200.0, -200.0, 1200.0, 1200.0));
    let place = m.placement(Some(storey.1), [0.0; 3], 0.0);
    m.add(&format!("IFCSPACE('void',$,'v',$,$,#{place},$,$,.ELEMENT.,.INTERNAL.,$)"));
    let body = |m: &mut Model, x: f64, y: f64| {
        let item = m.extruded(&rect(x, y, 40.0, 40.0), 0.0, 80.0);
        Some(m.shape("Body", &[item]))
    };
    let within = body(&mut m, 100.0, 100.0);
    m.element("IFCFURNISHINGELEMENT", "chair", storey, within);
    let sink = body(&mut m, 300.0, 100.0);
    m.element("IFCFLOWTERMINAL", "sink", storey, sink);
    // A thing without a body stands where it is placed, as its word is usually large.
    m.element("IFCFURNISHINGELEMENT", "bodiless", storey, None);
    let outside = body(&mut m, 5000.0, 0.0);
    m.element("IFCFURNISHINGELEMENT", "outside", storey, outside);
    let aloft = body(&mut m, 100.0, 300.0);
    m.element("IFCFURNISHINGELEMENT", "aloft", attic, aloft);
    let free = body(&mut m, 500.0, 500.0);
    m.element("IFCCOLUMN", "free", storey, free);
    let walled = body(&mut m, 1005.0, 500.0);
    m.element("IFCCOLUMN", "walled", storey, walled);
    m.element("IFCSTAIR", "nowhere", storey, None);
    for k in 0..3 {
        m.add(&format!("IFCWALLSTANDARDCASE('w{k}',$,$,$,$,$,$,$)"));
    }
    m.add("IFCSLAB('s',$,$,$,$,$,$,$,.FLOOR.)");
    m.add("IFCDOOR('d',$,$,$,$,$,$,$,$,$)");
    let Imported { world, report, .. } = m.imported();
    let count = |what| report.counts.get(&what).map_or((0, 0), |c| (c.taken, c.found));
    assert_eq!(count(What::Room), (1, 2), "{report}");
    assert_eq!(count(What::Level), (1, 2), "{report}");
    assert_eq!(count(What::Thing), (4, 7), "{report}");
    assert_eq!(count(What::Door), (0, 1), "{report}");
    assert_eq!(count(What::Lift), (0, 1), "{report}");
    assert_eq!(count(What::Record), (0, 4), "{report}");
    let tall = world.orthoframes.values().filter(|o| o.height.get() > 0.0);
    let solid = tall.filter(|o| o.roof_permeability == Permeability::Impermeable).count();
    assert!(solid >= 4, "{report}");
    let told = report.to_string();
    for id in ["void", "bodiless", "outside", "aloft", "nowhere", "IFCWALLSTANDARDCASE", "IFCSLAB"]
    {
        assert!(told.contains(&format!("«{id}»")), "{id} is not told:\n{told}");
    }
}
