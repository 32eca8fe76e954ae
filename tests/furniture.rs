//! Orders about what opens and shuts (fridges, drawers, boxes), and what is thrown away ends in a bin: judged by the
//! simulated truth and the relations that follow from it, not by what the mission says of itself.

use std::time::SystemTime;

use orthoframe::engine::{Progress, TaskAnswer, TaskEnding, Timestamp, change_now};
use orthoframe::{Engine, World};
use orthoframe_language::Language;
use orthoframe_map::{DoorStatus, Entity, stands};
use orthoframe_semantics::{Profile, RelationRules, derive};

/// A kitchen and a hall: a fridge, a drawer and a lidded box that are shut, an open bin and one with a lid.
const HOME: &str = r#"
format = 1
[domain]
key = "home"
name = "Home"
[robot]
radius = 22
height = 130
clearance = 3
speed = 50
start = "Post"
opens = true
[type]
object = [
  { name = "Стол", name_en = "table", traits = ["support"] },
  { name = "Чашка", name_en = "cup", traits = ["portable"] },
  { name = "Молоко", name_en = "milk", traits = ["portable"] },
  { name = "Ложка", name_en = "spoon", traits = ["portable"] },
  { name = "Мяч", name_en = "ball", traits = ["portable"] },
  { name = "Холодильник", name_en = "fridge", traits = ["container"] },
  { name = "Ящик", name_en = "drawer", traits = ["container"] },
  { name = "Коробка", name_en = "box", traits = ["portable", "container"] },
  { name = "Мусорное ведро", name_en = "bin", traits = ["container"] },
]
[orthoframe]
kitchen = { name = "Kitchen floor", height = 270, points = [[0, 0], [500, 0], [500, 150], [500, 250], [500, 400], [0, 400]], side.C = { permeability = "permeable" } }
hall = { name = "Hall floor", height = 270, points = [[0, 0], [300, 0], [300, 400], [0, 400], [0, 250], [0, 150]], side.E = { permeability = "permeable" } }
board = { name = "Board", rect = [120, 70], height = 75 }
cup = { name = "Cup body", regular = { corners = 12, radius = 4 }, height = 9 }
fridge = { name = "Fridge body", rect = [60, 60], height = 120, roof = "conditional" }
drawer = { name = "Drawer body", rect = [50, 45], height = 60, roof = "conditional" }
box = { name = "Box body", rect = [30, 30], height = 20, roof = "conditional" }
bin = { name = "Bin body", rect = [30, 30], height = 40, roof = "permeable" }
lidded = { name = "Lidded bin body", rect = [30, 30], height = 40, roof = "conditional" }
[object]
table = { name = "Table", type = "Стол", items = [{ id = "A", orthoframe = "board" }] }
cup = { name = "Cup", type = "Чашка", items = [{ id = "A", orthoframe = "cup" }] }
milk = { name = "Milk", type = "Молоко", items = [{ id = "A", orthoframe = "cup" }] }
spoon = { name = "Spoon", type = "Ложка", items = [{ id = "A", orthoframe = "cup" }] }
ball = { name = "Ball", type = "Мяч", items = [{ id = "A", orthoframe = "cup" }] }
fridge = { name = "Fridge", type = "Холодильник", items = [{ id = "A", orthoframe = "fridge" }] }
drawer = { name = "Drawer", type = "Ящик", items = [{ id = "A", orthoframe = "drawer" }] }
box = { name = "Box", type = "Коробка", items = [{ id = "A", orthoframe = "box" }] }
bin = { name = "Bin", type = "Мусорное ведро", items = [{ id = "A", orthoframe = "bin" }] }
lidded = { name = "Lidded bin", type = "Мусорное ведро", items = [{ id = "A", orthoframe = "lidded" }] }
[area.kitchen]
name = "Кухня"
name_en = "Kitchen"
items = [{ id = "A", orthoframe = "kitchen" }]
places = [{ name = "Post", at = [300, 200] }]
replicas = [
  { name = "Стол-1", name_en = "Table 1", object = "table", at = [20, 320] },
  { name = "Чашка-1", name_en = "Cup 1", object = "cup", at = [50, 340, 75], move_prob = 90 },
  { name = "Чашка-2", name_en = "Cup 2", object = "cup", at = [80, 340, 75], move_prob = 90 },
  { name = "Коробка-1", name_en = "Box 1", object = "box", at = [100, 345, 75], move_prob = 90, properties = { state = "closed" } },
  { name = "Мяч-1", name_en = "Ball 1", object = "ball", at = [115, 360, 75], move_prob = 90 },
  { name = "Холодильник-1", name_en = "Fridge 1", object = "fridge", at = [200, 330], properties = { state = "closed" } },
  { name = "Молоко-1", name_en = "Milk 1", object = "milk", at = [230, 360, 20], move_prob = 90 },
  { name = "Ящик-1", name_en = "Drawer 1", object = "drawer", at = [300, 340], properties = { state = "closed" } },
  { name = "Ложка-1", name_en = "Spoon 1", object = "spoon", at = [325, 360, 20], move_prob = 90 },
]
[area.hall]
name = "Зал"
name_en = "Hall"
items = [{ id = "A", orthoframe = "hall" }]
replicas = [
  { name = "Ведро-1", name_en = "Bin 1", object = "BIN", at = [200, 20] BINSTATE },
]
[map.home]
name = "Home"
items = [{ area = "kitchen" }, { area = "hall", at = [500, 0] }]
links = [{ from = "kitchen.C", to = "hall.E" }]
"#;

#[derive(Clone, Copy, PartialEq)]
enum Bin {
    Open,
    Lidded,
    Locked,
    None,
}

fn text(bin: Bin, opens: bool) -> String {
    let (object, state) = match bin {
        Bin::Open => ("bin", ""),
        Bin::Lidded => ("lidded", ", properties = { state = \"closed\" }"),
        Bin::Locked | Bin::None => ("cup", ""),
    };
    let mut text = HOME.replace("BINSTATE", state).replace("\"BIN\"", &format!("{object:?}"));
    if bin == Bin::Locked {
        text = text.replace(
            "at = [200, 330], properties = { state = \"closed\" }",
            "at = [200, 330], properties = { state = \"locked\" }",
        );
    }
    if !opens {
        text = text.replace("opens = true", "opens = false");
    }
    text
}

struct House {
    engine: Engine,
    _dir: tempfile::TempDir,
}

impl House {
    fn of(text: &str) -> Self {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("home.toml");
        std::fs::write(&file, text).unwrap();
        let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
        engine.import(&file, &change_now("test", "survey")).unwrap_or_else(|e| panic!("{e:?}"));
        Self { engine, _dir: dir }
    }

    /// Carries out an order in a truth that is as the robot believes; how that truth is then.
    fn order(&mut self, order: &str) -> Result<(TaskAnswer, World), String> {
        let said = |error: &orthoframe::engine::Error| error.say(Language::of(order));
        let commands = self.engine.understand(order).map_err(|e| said(&e))?;
        let mut truth = self.engine.world_now().unwrap().clone();
        let mut moved = false;
        let mut tell = |progress: &Progress<'_>| moved |= matches!(progress, Progress::Moved(_));
        let mut robot = self.engine.simulator(Some(truth.clone())).unwrap();
        let answer = self.engine.carry_out_with(
            &commands,
            &mut robot,
            &mut tell,
            &orthoframe_units::Stop::new(),
        );
        match answer {
            Ok(answer) => {
                truth = robot.into_truth();
                let at: Timestamp = SystemTime::now().into();
                self.engine.remember(&answer, at).unwrap();
                Ok((answer, truth))
            }
            Err(error) => {
                assert!(!moved, "{order}: refused after it had moved");
                Err(said(&error))
            }
        }
    }

    fn done(&mut self, text: &str) -> World {
        let (answer, truth) = self.order(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!(answer.ending.is_done(), "{text}: {:?}", answer.ending);
        truth
    }
}

fn status(world: &World, name: &str) -> Option<DoorStatus> {
    let found = world.find(name).into_iter();
    let id = found.filter_map(|e| if let Entity::Replica(id) = e { Some(id) } else { None }).next();
    stands(world, world.replicas.get(&id?)?)
}

fn is_inside(world: &World, thing: &str, around: &str) -> bool {
    let relations = derive(world, &RelationRules::standard(), Profile::Surveyed).unwrap();
    relations.holds("INSIDE", &[thing, around])
}

#[test]
fn furniture_is_opened_and_shut_on_order_and_stays_so() {
    for (open, shut, thing) in [
        ("Открой холодильник", "Закрой холодильник", "Холодильник-1"),
        ("Open the fridge", "Close the fridge", "Холодильник-1"),
        ("Открой ящик", "Закрой Ящик-1", "Ящик-1"),
        ("Open the drawer", "Shut the drawer", "Ящик-1"),
        ("Открой коробку", "Закрой коробку", "Коробка-1"),
        ("Open the box", "Close the box", "Коробка-1"),
    ] {
        let mut house = House::of(&text(Bin::Open, true));
        assert_eq!(status(&house.done(open), thing), Some(DoorStatus::Open), "{open}");
        // What it left is what it finds: the next order begins there.
        let now = house.engine.world_now().unwrap().clone();
        assert_eq!(status(&now, thing), Some(DoorStatus::Open), "{open}");
        let (again, _) = house.order(open).unwrap();
        assert!(matches!(again.ending, TaskEnding::AlreadyTrue), "{open}: {:?}", again.ending);
        assert_eq!(status(&house.done(shut), thing), Some(DoorStatus::Closed), "{shut}");
        let now = house.engine.world_now().unwrap().clone();
        assert_eq!(status(&now, thing), Some(DoorStatus::Closed), "{shut}");
    }
}

#[test]
fn what_cannot_be_opened_is_told_before_the_drive() {
    for (order, told) in [
        ("Открой холодильник", "других робот не открывает"),
        ("Open the drawer", "the robot opens and shuts no others"),
        ("Put Cup 1 into the fridge", "does not open doors of furniture"),
        ("Выброси Молоко-1", "дверцы мебели робот не открывает"),
    ] {
        let said = House::of(&text(Bin::Open, false)).order(order).unwrap_err();
        assert!(said.contains(told), "{order}: {said}");
    }
    for (order, told) in [
        ("Открой холодильник", "заперто"),
        ("Open the fridge", "is locked"),
        ("Throw away Cup 1", "nothing into which to throw"),
        ("Выброси Чашку-1", "нет, куда это выбросить"),
    ] {
        let said = House::of(&text(Bin::Locked, true)).order(order).unwrap_err();
        assert!(said.contains(told), "{order}: {said}");
    }
    let said = House::of(&text(Bin::Lidded, false)).order("Throw away Cup 1").unwrap_err();
    assert!(said.contains("does not open doors of furniture"), "{said}");
    assert!(House::of(&text(Bin::None, true)).order("Dispose of Cup 1").is_err());
}

/// A survey that draws of a fridge only its shelves and its roof, as convex pieces of a mesh are: what is told to be shut is
/// shut for what is put in and for what is taken out, and opens only for who opens such things.
#[test]
fn what_is_drawn_without_sides_and_told_shut_is_shut_both_ways() {
    let drawn = |text: &str| {
        text.replace(
            "fridge = { name = \"Fridge body\", rect = [60, 60], height = 120, roof = \"conditional\" }",
            "fridge = { name = \"Fridge body\", rect = [60, 60], height = 120, base = \"permeable\", \
             roof = \"permeable\", side.A = { permeability = \"permeable\" }, \
             side.B = { permeability = \"permeable\" }, side.C = { permeability = \"permeable\" }, \
             side.D = { permeability = \"permeable\" } }\n\
             plate = { name = \"Plate\", rect = [60, 60], height = 2 }",
        )
        .replace(
            "items = [{ id = \"A\", orthoframe = \"fridge\" }]",
            "items = [{ id = \"A\", orthoframe = \"fridge\" }, { id = \"B\", orthoframe = \"plate\", \
             at = [0, 0, 18] }, { id = \"C\", orthoframe = \"plate\", at = [0, 0, 118] }], \
             links = [{ from = \"A.roof\", to = \"B.base\", rel = [0, 0, -102] }, \
             { from = \"A.roof\", to = \"C.base\", rel = [0, 0, -2] }]",
        )
    };
    for (order, thing) in [
        ("Положи Чашку-1 в холодильник", "Чашка-1"),
        ("Put Cup 2 into the fridge", "Чашка-2"),
        ("Принеси молоко", "Молоко-1"),
        ("Bring me the milk", "Молоко-1"),
    ] {
        let said = House::of(&drawn(&text(Bin::Open, false))).order(order).unwrap_err();
        let told = ["дверцы мебели робот не открывает", "not open doors of furniture"];
        assert!(told.iter().any(|told| said.contains(told)), "{order}: {said}");
        let mut house = House::of(&drawn(&text(Bin::Open, true)));
        let before = is_inside(house.engine.world_now().unwrap(), thing, "Холодильник-1");
        let truth = house.done(order);
        assert_eq!(is_inside(&truth, thing, "Холодильник-1"), !before, "{order}");
        assert_eq!(status(&truth, "Холодильник-1"), Some(DoorStatus::Closed), "{order}");
        let opened = text(Bin::Open, false).replace(
            "at = [200, 330], properties = { state = \"closed\" }",
            "at = [200, 330], properties = { state = \"open\" }",
        );
        House::of(&drawn(&opened)).done(order);
    }
}

#[test]
fn what_is_in_drawers_and_boxes_is_taken_out_and_they_are_shut_again() {
    for (order, thing, around) in [
        ("Принеси молоко", "Молоко-1", "Холодильник-1"),
        ("Bring me the spoon", "Ложка-1", "Ящик-1"),
        ("Принеси мяч", "Мяч-1", "Коробка-1"),
        ("Put Ball 1 on Table 1", "Мяч-1", "Коробка-1"),
    ] {
        let mut house = House::of(&text(Bin::Open, true));
        let before = house.engine.world_now().unwrap().clone();
        assert!(is_inside(&before, thing, around), "{order}");
        let truth = house.done(order);
        assert_eq!(status(&truth, around), Some(DoorStatus::Closed), "{order}");
        assert!(!is_inside(&truth, thing, around), "{order}");
    }
}

#[test]
fn what_is_put_into_shut_things_goes_in_and_they_are_shut_again() {
    for (order, thing, around) in [
        ("Положи Чашку-1 в холодильник", "Чашка-1", "Холодильник-1"),
        ("Put Cup 2 into the drawer", "Чашка-2", "Ящик-1"),
    ] {
        let truth = House::of(&text(Bin::Open, true)).done(order);
        assert!(is_inside(&truth, thing, around), "{order}");
        assert_eq!(status(&truth, around), Some(DoorStatus::Closed), "{order}");
    }
}

#[test]
fn what_is_thrown_away_ends_in_a_bin() {
    for bin in [Bin::Open, Bin::Lidded] {
        for (order, thing) in [
            ("Выброси Чашку-1", "Чашка-1"),
            ("Выкинь Чашку-2 со стола", "Чашка-2"),
            ("Throw away Cup 1", "Чашка-1"),
            ("Throw Cup 2 away", "Чашка-2"),
            ("Get rid of Milk 1", "Молоко-1"),
            ("Throw Cup 1 into the bin", "Чашка-1"),
            ("Выброси мяч", "Мяч-1"),
        ] {
            let mut house = House::of(&text(bin, true));
            let truth = house.done(order);
            assert!(is_inside(&truth, thing, "Ведро-1"), "{order}");
            for shut in ["Холодильник-1", "Коробка-1", "Ящик-1"] {
                assert_eq!(status(&truth, shut), Some(DoorStatus::Closed), "{order}: {shut}");
            }
            if bin == Bin::Lidded {
                assert_eq!(status(&truth, "Ведро-1"), Some(DoorStatus::Closed), "{order}");
            }
            // It stays there: it is no disorder, and nothing is left to do.
            if !order.contains("into") {
                let (again, _) =
                    house.order(order.strip_suffix(" со стола").unwrap_or(order)).unwrap();
                assert!(
                    matches!(again.ending, TaskEnding::AlreadyTrue),
                    "{order}: {:?}",
                    again.ending
                );
            }
            let (_, tidied) = house.order("Наведи порядок").unwrap();
            assert!(is_inside(&tidied, thing, "Ведро-1"), "{order}");
        }
    }
}
