//! What can be wrong with a map, and where: [`MapError`], the [`Spot`] in the model, and [`MapErrors`], all of a file.
//!
//! A fault knows its place as a path into the model; the reader of a file turns that into a place in the text.

use std::fmt;

use miette::{
    Diagnostic, LabeledSpan, MietteError, Severity, SourceCode, SourceSpan, SpanContents,
};
use thiserror::Error;

use crate::units::{Bilingual, Cm, Source};

mod english;
mod spot;

pub use english::EnglishMapErrors;
pub use spot::{Record, Spot, Step};

pub(super) const COORDINATE: (&str, &str) = ("координата", "a coordinate");
pub(super) const WITHIN: (&str, &str) = ("в пределах ±100 км", "within ±100 km");
pub(super) const MORE_THAN_0: (&str, &str) = ("больше 0", "more than 0");

/// A map that cannot be read, or that contradicts itself. Points are `(x, y)` in cm.
#[derive(Debug, Clone, PartialEq, Error, Diagnostic)]
#[non_exhaustive]
pub enum MapError {
    /// The file cannot be opened or is no text.
    #[error("файл «{path}» не читается: {message}")]
    #[diagnostic(
        code(map::unreadable),
        help("проверьте путь к файлу; карта - текст в кодировке UTF-8")
    )]
    Unreadable { path: String, message: Bilingual },
    /// Larger than any building needs.
    #[error("файл карты слишком велик: {bytes} байт при пределе {limit}")]
    #[diagnostic(code(map::too_large), help("разделите карту на несколько файлов"))]
    TooLarge { bytes: u64, limit: u64 },
    /// Nothing but blanks and comments.
    #[error("файл карты пуст")]
    #[diagnostic(
        code(map::empty),
        help("карта начинается строкой `format = 1`; образец - maps/rb2.toml")
    )]
    Empty,
    /// The notation itself is broken.
    #[error("ошибка записи {format}: {message}")]
    #[diagnostic(code(map::syntax), help("исправьте запись в этом месте; образец - maps/rb2.toml"))]
    Syntax { format: &'static str, message: Bilingual },
    /// Written for another version.
    #[error("неизвестная версия формата: {found}")]
    #[diagnostic(code(map::format), help("эта программа читает карты версии 1: `format = 1`"))]
    Format { found: String },
    /// A key that the format does not have.
    #[error("неизвестное поле «{field}»{}", perhaps(.nearest))]
    #[diagnostic(code(map::unknown_field), help("здесь могут стоять поля: {expected}"))]
    UnknownField { field: String, nearest: Option<String>, expected: String },
    /// A key that the format requires.
    #[error("не хватает поля «{field}»")]
    #[diagnostic(code(map::missing_field), help("добавьте поле «{field}»"))]
    MissingField { field: &'static str },
    /// A text where a number belongs, and the like.
    #[error("{found}, а нужно: {expected}")]
    #[diagnostic(code(map::wrong_kind), help("замените значение; нужно: {expected}"))]
    WrongKind { found: Bilingual, expected: Bilingual },
    /// None of the words that may stand here.
    #[error("неизвестное слово «{word}»{}", perhaps(.nearest))]
    #[diagnostic(code(map::unknown_word), help("здесь может стоять одно из слов: {expected}"))]
    UnknownWord { word: String, nearest: Option<String>, expected: String },
    /// A value of the right kind that makes no sense.
    #[error("негодное значение: {message}")]
    #[diagnostic(code(map::bad_value), help("исправьте значение"))]
    BadValue { message: Bilingual },
    /// A number out of its range.
    #[error("{what} = {value}, а нужно {range}")]
    #[diagnostic(code(map::out_of_range), help("задайте {what} {range}"))]
    OutOfRange { what: Bilingual, value: f64, range: Bilingual },
    /// A name that nothing bears.
    #[error("{what} «{name}» не существует{}", perhaps(.nearest))]
    #[diagnostic(code(map::unknown_reference), help("исправьте имя или опишите: {what} «{name}»"))]
    UnknownReference { what: Bilingual, name: String, nearest: Option<String> },
    /// A name that several things bear, or that could be read in several ways.
    #[error("имя «{name}» можно понять по-разному: {candidates}")]
    #[diagnostic(code(map::ambiguous_name), help("назовите одно из них полностью"))]
    AmbiguousName { name: String, candidates: String },
    /// "A.roof" and its like, misspelt.
    #[error("ссылка «{text}» непонятна")]
    #[diagnostic(code(map::bad_reference), help("запишите ссылку как {wanted}"))]
    BadReference { text: String, wanted: Bilingual },
    /// Two records of one kind with one id.
    #[error("{what}: номер {id} дан дважды")]
    #[diagnostic(code(map::duplicate_id), help("уберите поле id или дайте другой номер"))]
    DuplicateId { what: Bilingual, id: u32 },
    /// An id from another world.
    #[error("{owner}: ссылка на {what} с номером {id}, которого нет")]
    #[diagnostic(code(map::dangling_id), help("добавьте недостающую запись или уберите ссылку"))]
    DanglingId { owner: Bilingual, what: Bilingual, id: u32 },
    /// One name for two things.
    #[error("имя «{name}» носят двое: {first} и {second}")]
    #[diagnostic(code(map::duplicate_name), help("дайте каждому своё имя, например «{}-2»", name.trim()))]
    DuplicateName { name: String, first: Bilingual, second: Bilingual },
    /// A record without a name.
    #[error("{what} без имени")]
    #[diagnostic(code(map::no_name), help("дайте имя в поле name"))]
    NoName { what: Bilingual },
    /// A handle that references could not tell from something else.
    #[error("{owner}: негодное обозначение «{id}»")]
    #[diagnostic(
        code(map::bad_id),
        help("обозначение не пусто, не содержит точки и не равно base, roof, база, потолок")
    )]
    BadId { owner: Bilingual, id: String },
    /// Two parts or sides with one id.
    #[error("{owner}: обозначение «{id}» дано дважды")]
    #[diagnostic(code(map::duplicate_part), help("обозначения частей и сторон не повторяются"))]
    DuplicatePart { owner: Bilingual, id: String },

    /// A zone that is none: nowhere, never, or with an outline that crosses itself.
    #[error("{owner}: {message}")]
    #[diagnostic(code(map::bad_zone), help("исправьте зону; как её записать: docs/map.md"))]
    BadZone { owner: Bilingual, message: Bilingual },

    /// None or several of the ways to give a base.
    #[error("Ортофрейм «{name}»: База задана {count} способами вместо одного")]
    #[diagnostic(code(map::base_form), help("оставьте одно из полей rect, regular, points, sides"))]
    BaseForm { name: String, count: usize },
    /// Fewer than three vectors.
    #[error("Ортофрейм «{name}»: векторов Базы {count}, а нужно не меньше трёх")]
    #[diagnostic(
        code(map::base_too_short),
        help("опишите замкнутый многоугольник хотя бы из трёх сторон")
    )]
    BaseTooShort { name: String, count: usize },
    /// A vector of no length.
    #[error("Ортофрейм «{name}»: вектор {side} нулевой длины в точке {at}")]
    #[diagnostic(
        code(map::base_zero_length),
        help("уберите вектор {side} или раздвиньте его концы")
    )]
    BaseZeroLength { name: String, side: String, at: String },
    /// A vector does not begin where the one before it ends.
    #[error(
        "Ортофрейм «{name}»: База не связна: вектор {side} кончается в {end}, а следующий за ним {next} начинается в {start}"
    )]
    #[diagnostic(code(map::base_not_connected), help("начните вектор {next} в точке {end}"))]
    BaseNotConnected { name: String, side: String, end: String, next: String, start: String },
    /// The last vector does not return to the first.
    #[error(
        "Ортофрейм «{name}»: База не замкнута: последний вектор {side} кончается в {end}, а первый вектор {next} начинается в {start}"
    )]
    #[diagnostic(code(map::base_not_closed), help("кончите вектор {side} в точке {start}"))]
    BaseNotClosed { name: String, side: String, end: String, next: String, start: String },
    /// Two vectors cross or touch.
    #[error(
        "Ортофрейм «{name}»: База пересекает сама себя: векторы {side} и {other} встречаются в {at}"
    )]
    #[diagnostic(
        code(map::base_crosses_itself),
        help("переставьте углы так, чтобы стороны не встречались")
    )]
    BaseCrossesItself { name: String, side: String, other: String, at: String },
    /// Clockwise.
    #[error("Ортофрейм «{name}»: векторы Базы идут по часовой стрелке")]
    #[diagnostic(
        code(map::base_clockwise),
        help("запишите углы против часовой стрелки или добавьте `reverse = true`")
    )]
    BaseClockwise { name: String },
    /// All corners on one line.
    #[error("Ортофрейм «{name}»: площадь Базы равна нулю")]
    #[diagnostic(code(map::base_no_area), help("углы Базы лежат на одной прямой: раздвиньте их"))]
    BaseNoArea { name: String },
    /// Below the ground.
    #[error("Ортофрейм «{name}»: высота {height} отрицательна")]
    #[diagnostic(
        code(map::negative_height),
        help("высота - расстояние от Базы до Потолка, 0 или больше")
    )]
    NegativeHeight { name: String, height: Cm },

    /// Nothing in it.
    #[error("{owner}: нет ни одной части")]
    #[diagnostic(code(map::no_items), help("перечислите части в поле items"))]
    NoItems { owner: Bilingual },
    /// None or several base items.
    #[error("{owner}: базовых частей {count}, а нужна одна")]
    #[diagnostic(code(map::base_item_count), help("отметьте `base = true` ровно одну часть"))]
    BaseItemCount { owner: Bilingual, count: usize },
    /// The base item stands off the origin.
    #[error(
        "{owner}: ни один угол базовой части «{item}» не стоит в начале координат; ближайший - {nearest}"
    )]
    #[diagnostic(
        code(map::base_item_off_origin),
        help(
            "сдвиньте часть так, чтобы её угол попал в [0, 0]; карта с чужими координатами называет их в поле frame"
        )
    )]
    BaseItemOffOrigin { owner: Bilingual, item: String, nearest: String },
    /// An id of an item that the group does not have.
    #[error("{owner}: части «{item}» нет")]
    #[diagnostic(code(map::unknown_item), help("есть части: {known}"))]
    UnknownItem { owner: Bilingual, item: String, known: String },
    /// An id of a side that the Orthoframe does not have.
    #[error("{owner}: у части «{item}» нет стороны «{side}»")]
    #[diagnostic(code(map::unknown_side), help("есть стороны: {known}"))]
    UnknownSide { owner: Bilingual, item: String, side: String, known: String },
    /// A horizontal face bound to a vertical one.
    #[error("{owner}: связь {link} соединяет горизонтальную грань с боковой")]
    #[diagnostic(code(map::link_faces), help("связывают Потолок с Базой или сторону со стороной"))]
    LinkFaces { owner: Bilingual, link: String },
    /// A link and the positions say different things.
    #[error(
        "{owner}: связь {link} и положения противоречат: по связи {claimed}, по положениям {found}"
    )]
    #[diagnostic(
        code(map::link_contradicts),
        help("исправьте положение (at, angle) одной из частей или смещение (rel, angle) связи")
    )]
    LinkContradicts { owner: Bilingual, link: String, claimed: Bilingual, found: Bilingual },
    /// A passage bound to a narrower one.
    #[error("{owner}: связь {link} соединяет проёмы разной ширины: {length} и {other}")]
    #[diagnostic(
        code(map::link_length),
        help("проницаемые и условно проницаемые стороны равны по длине")
    )]
    LinkLength { owner: Bilingual, link: String, length: Cm, other: Cm },
    /// A door bound to a wall.
    #[error("{owner}: связь {link} соединяет грани разной проницаемости")]
    #[diagnostic(
        code(map::link_permeability),
        help("сделайте обе стороны проницаемыми или обе непроницаемыми")
    )]
    LinkPermeability { owner: Bilingual, link: String },
    /// A passage that does not lie on the passage that it is bound to.
    #[error("{owner}: проёмы связи {link} не совпадают: между ними {distance}")]
    #[diagnostic(
        code(map::link_apart),
        help("совместите стороны: их концы должны лежать в одних точках")
    )]
    LinkApart { owner: Bilingual, link: String, distance: Cm },
    /// Two parts of an Area, or two solid parts of an Object, lie in one another.
    #[error("{owner}: части «{item}» и «{other}» накладываются, например в точке {at}")]
    #[diagnostic(
        code(map::items_overlap),
        help("раздвиньте части: они могут только соприкасаться")
    )]
    ItemsOverlap { owner: Bilingual, item: String, other: String, at: String },
    /// A part that nothing holds.
    #[error("{owner}: часть «{item}» не связана с остальными")]
    #[diagnostic(
        code(map::items_apart),
        help("добавьте связь в links или придвиньте часть вплотную")
    )]
    ItemsApart { owner: Bilingual, item: String },

    /// Two rooms in one place.
    #[error("{map}: помещения «{area}» и «{other}» накладываются, например в точке {at}")]
    #[diagnostic(code(map::areas_overlap), help("сдвиньте одно из помещений"))]
    AreasOverlap { map: Bilingual, area: String, other: String, at: String },
    /// A room bound to no other.
    #[error("{map}: помещение «{area}» не связано с остальными")]
    #[diagnostic(
        code(map::areas_apart),
        help("свяжите одну из его сторон с соседней в поле links карты")
    )]
    AreasApart { map: Bilingual, area: String },
    /// A room that stands in two places.
    #[error("помещение «{area}» поставлено на карты дважды")]
    #[diagnostic(code(map::area_twice), help("каждое помещение стоит на одной карте, один раз"))]
    AreaTwice { area: String },
    /// A room that stands nowhere.
    #[error("помещение «{area}» не стоит ни на одной карте")]
    #[diagnostic(code(map::area_nowhere), severity(Warning), help("добавьте его в items карты"))]
    AreaNowhere { area: String },
    /// A floor that the building does not hold, or holds twice.
    #[error("карта «{map}» стоит в домейне {count} раз, а нужно один")]
    #[diagnostic(
        code(map::domain_maps),
        help("перечислите каждую карту один раз в поле maps домейна")
    )]
    DomainMaps { map: String, count: usize },
    /// A lift within one floor.
    #[error("лифт «{lift}» не соединяет помещений разных карт")]
    #[diagnostic(code(map::lift_stops), help("перечислите в stops помещения хотя бы двух карт"))]
    LiftStops { lift: String },

    /// A door in a solid wall, or leaves in an open passage.
    #[error(
        "{owner}: дверь «{door}» навешена на сторону {side}, которая для неё не годится: {why}"
    )]
    #[diagnostic(
        code(map::door_on_wrong_side),
        help(
            "дверь вешают на условно проницаемую сторону (permeability = \"conditional\"), проход - на проницаемую"
        )
    )]
    DoorOnWrongSide { owner: Bilingual, door: String, side: String, why: Bilingual },
    /// A doorway in which no door hangs.
    #[error("{owner}: на условно проницаемой стороне {side} нет двери")]
    #[diagnostic(
        code(map::side_without_door),
        help("навесьте дверь в поле doors или измените permeability")
    )]
    SideWithoutDoor { owner: Bilingual, side: String },
    /// Two doors in one doorway.
    #[error("{owner}: на стороне {side} две двери")]
    #[diagnostic(code(map::side_two_doors), help("оставьте на стороне одну дверь"))]
    SideTwoDoors { owner: Bilingual, side: String },
    /// A door that does not fit.
    #[error("{owner}: дверь «{door}» шириной {width} не входит в сторону {side} длиной {length}")]
    #[diagnostic(code(map::door_too_wide), help("сделайте дверь не шире стороны"))]
    DoorTooWide { owner: Bilingual, door: String, width: Cm, side: String, length: Cm },
    /// A door higher than its wall.
    #[error("{owner}: дверь «{door}» высотой {height} выше стороны {side} высотой {wall}")]
    #[diagnostic(code(map::door_too_high), help("сделайте дверь не выше помещения"))]
    DoorTooHigh { owner: Bilingual, door: String, height: Cm, side: String, wall: Cm },
    /// A door that hangs nowhere.
    #[error("дверь «{door}» нигде не навешена")]
    #[diagnostic(
        code(map::door_unused),
        severity(Warning),
        help("укажите её в поле doors помещения или объекта")
    )]
    DoorUnused { door: String },
    /// A door between three rooms.
    #[error("дверь «{door}» навешена {count} раза; дверь соединяет не больше двух помещений")]
    #[diagnostic(code(map::door_mounts), help("заведите для каждого проёма свою дверь"))]
    DoorMounts { door: String, count: usize },
    /// The two sides of a door lie apart.
    #[error(
        "дверь «{door}»: стороны {side} и {other}, на которых она навешена, не совпадают на карте"
    )]
    #[diagnostic(
        code(map::door_apart),
        help("дверь соединяет стороны, которые связаны в links карты")
    )]
    DoorApart { door: String, side: String, other: String },
    /// Leaves that open into both rooms, or into none.
    #[error("дверь «{door}»: оба помещения говорят, что она открывается {way}")]
    #[diagnostic(
        code(map::door_direction),
        help("для одного помещения opens = \"inside\", для другого \"outside\"")
    )]
    DoorDirection { door: String, way: Bilingual },
    /// No leaves, or leaves in a passage.
    #[error("дверь «{door}»: {why}")]
    #[diagnostic(
        code(map::door_leaves),
        help("двери нужна хотя бы одна створка в leaves, проходу - ни одной")
    )]
    DoorLeaves { door: String, why: Bilingual },
    /// Leaves that do not fill the door.
    #[error("дверь «{door}»: доли створок в сумме дают {sum}, а не 1")]
    #[diagnostic(code(map::leaf_shares), help("доли (share) всех створок в сумме равны 1"))]
    LeafShares { door: String, sum: f64 },
    /// A passage that is closed, a closed door that stands open.
    #[error("дверь «{door}»: раскрытие {opening} % не вяжется с состоянием «{status}»")]
    #[diagnostic(
        code(map::door_state),
        help("у закрытой и запертой двери раскрытие 0, у проёма без створок - 100")
    )]
    DoorState { door: String, opening: f64, status: Bilingual },

    /// A thing that stands in another room.
    #[error("«{replica}» стоит вне своего помещения «{area}»: его середина в точке {at}")]
    #[diagnostic(
        code(map::replica_outside),
        help("исправьте at или перенесите экземпляр в другое помещение")
    )]
    ReplicaOutside { replica: String, area: String, at: String },
    /// A thing that sticks through a wall.
    #[error("«{replica}» выступает за стены помещения «{area}» на {by}, до точки {at}")]
    #[diagnostic(
        code(map::replica_through_wall),
        severity(Warning),
        help("отодвиньте экземпляр от стены")
    )]
    ReplicaThroughWall { replica: String, area: String, by: Cm, at: String },
    /// A thing above the ceiling or below the floor.
    #[error(
        "«{replica}» занимает высоты от {bottom} до {top}, а помещение «{area}» - от {floor} до {ceiling}"
    )]
    #[diagnostic(
        code(map::replica_height),
        severity(Warning),
        help("исправьте третью координату at")
    )]
    ReplicaHeight { replica: String, area: String, bottom: Cm, top: Cm, floor: Cm, ceiling: Cm },
    /// A place in another room.
    #[error("место «{place}» лежит вне своего помещения «{area}»")]
    #[diagnostic(
        code(map::place_outside),
        help("исправьте at или перенесите место в другое помещение")
    )]
    PlaceOutside { place: String, area: String },

    /// A robot's footprint that is no convex polygon round its centre, or that its radius does not cover.
    #[error("контур робота: {reason}")]
    #[diagnostic(
        code(map::bad_footprint),
        help(
            "перечислите углы выпуклого контура против часовой стрелки, [вперёд, влево] от центра, в см"
        )
    )]
    BadFootprint { reason: Bilingual },

    /// Two solid things in one place.
    #[error("«{thing}» и «{other}» находятся друг в друге, например в точке {at}")]
    #[diagnostic(
        code(map::things_overlap),
        severity(Warning),
        help("раздвиньте их: исправьте at у одной из них")
    )]
    ThingsOverlap { thing: String, other: String, at: String },
    /// A thing that nothing holds.
    #[error("«{thing}» висит в воздухе: {height} над {over}, и ни стена, ни потолок её не держат")]
    #[diagnostic(
        code(map::thing_hovers),
        severity(Warning),
        help("исправьте третью координату at, или поставьте под вещь то, на чём она стоит")
    )]
    ThingHovers { thing: String, over: Bilingual, height: Cm },
    /// Things that leave too little of a doorway.
    #[error("в проёме «{door}» шириной {width} стоит {things}: свободно {free}")]
    #[diagnostic(
        code(map::doorway_barred),
        severity(Warning),
        help("отодвиньте от проёма то, что названо, или исправьте место двери")
    )]
    DoorwayBarred { door: String, things: Bilingual, free: Cm, width: Cm },
    /// A place where the robot cannot stand.
    #[error("место «{place}» лежит под «{thing}»: там роботу не встать")]
    #[diagnostic(
        code(map::place_under),
        severity(Warning),
        help("перенесите место туда, где пол свободен")
    )]
    PlaceUnder { place: String, thing: String },
    /// A property that must name something of the map and names nothing.
    #[error("{property} называет «{name}», а такого на карте нет ({what}){}", perhaps(.nearest))]
    #[diagnostic(
        code(map::names_nothing),
        severity(Warning),
        help("исправьте имя, или опишите на карте то, что названо")
    )]
    NamesNothing { property: String, what: Bilingual, name: String, nearest: Option<String> },
    /// A state that the program does not understand.
    #[error("{property} = «{value}»: такого состояния программа не знает")]
    #[diagnostic(
        code(map::unknown_state),
        severity(Warning),
        help("напишите {wanted}; что ещё сказать о состоянии, пишут в своём свойстве")
    )]
    UnknownState { property: String, value: String, wanted: Bilingual },
    /// A trait that neither the program nor a rule reads.
    #[error("тип «{owner}»: признака «{word}» не знают ни программа, ни правила{}", perhaps(.nearest))]
    #[diagnostic(
        code(map::unknown_trait),
        severity(Warning),
        help("известны признаки: {known}; свой признак должен стоять в файле правил")
    )]
    UnknownTrait { owner: String, word: String, nearest: Option<String>, known: String },
    /// A size that fits if it is taken for metres.
    #[error("{what}: размер {size} - не метры ли это?")]
    #[diagnostic(
        code(map::metres),
        severity(Warning),
        help("длины на карте - в сантиметрах; если это метры, напишите {wanted}")
    )]
    Metres { what: Bilingual, size: String, wanted: String },
    /// The rest of the warnings of one sort.
    #[error("и ещё таких же предупреждений: {count} ({kind})")]
    #[diagnostic(
        code(map::more_alike),
        severity(Warning),
        help("исправьте показанные и проверьте карту снова")
    )]
    MoreAlike { count: usize, kind: String },

    /// An edit file that says nothing.
    #[error("в файле правок ничего нет")]
    #[diagnostic(
        code(map::no_edits),
        help(
            "опишите новое, как в файле карты, или шаг: [[edit]] move = \"Стул-1\", to = [120, 80]"
        )
    )]
    NoEdits,
    /// A step of an edit file that does nothing that is known.
    #[error("неизвестное действие «{found}»{}", perhaps(.nearest))]
    #[diagnostic(code(map::unknown_verb), help("шаг правки начинается одним из слов: {expected}"))]
    UnknownVerb { found: String, nearest: Option<String>, expected: String },
    /// A new record under a name that is taken.
    #[error("{what} «{name}» уже есть на карте")]
    #[diagnostic(
        code(map::already_there),
        help(
            "дайте новому другое имя; то, что есть, меняют шаги [[edit]]: move, turn, set, rename, remove"
        )
    )]
    AlreadyThere { what: Bilingual, name: String },
    /// Something is to be removed that other things are made of, or stand by.
    #[error("{what} «{name}» ещё нужен: {by}")]
    #[diagnostic(code(map::still_used), help("сначала уберите то, что названо"))]
    StillUsed { what: Bilingual, name: String, by: Bilingual },
    /// A door that hangs nowhere, or not there.
    #[error("дверь «{door}» там не навешена")]
    #[diagnostic(code(map::not_bound), help("уберите этот шаг или исправьте from"))]
    NotBound { door: String },
    /// A link that is not there.
    #[error("связи {link} нет")]
    #[diagnostic(code(map::not_linked), help("уберите этот шаг или исправьте концы связи"))]
    NotLinked { link: String },
    /// A link of a room that stands on no map.
    #[error("помещение «{area}» ещё не стоит ни на одной карте")]
    #[diagnostic(
        code(map::area_nowhere_yet),
        help("сначала поставьте его: [[edit]] stand = \"{area}\", map = …, at = [x, y]")
    )]
    AreaNowhereYet { area: String },

    /// A truth in which another building stands than the one that the robot knows.
    #[error("{what}: {how}")]
    #[diagnostic(
        code(map::other_building),
        help(
            "истина – то же здание: двери открыты или заперты, вещи сдвинуты, убраны, добавлены; если изменилось здание, правьте карту: ortho edit"
        )
    )]
    OtherBuilding { what: Bilingual, how: Bilingual },
    /// A truth that moves what the robot holds, or a person from it.
    #[error("«{name}» у робота или у того, кому он это отдал, и на карте сейчас не стоит")]
    #[diagnostic(
        code(map::carried),
        help("уберите правку этой вещи, или начните сначала: ortho do … --reset")
    )]
    Carried { name: String },
    /// More faults than anyone reads.
    #[error("и ещё ошибок: {count}")]
    #[diagnostic(code(map::more), help("исправьте показанные и проверьте карту снова"))]
    More { count: usize },
}

fn perhaps(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|name| format!("; может быть, «{name}»?")).unwrap_or_default()
}

/// One fault with its places: in the model, and in the text when it was read from one.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    pub error: MapError,
    /// The first is where to look; a contradiction names a second.
    pub spots: Vec<Spot>,
    /// Bytes of the text, likewise.
    pub spans: Vec<SourceSpan>,
}

impl Fault {
    pub(super) fn new(error: MapError, spots: Vec<Spot>) -> Self {
        Self { error, spots, spans: Vec::new() }
    }

    /// A warning lets the map be used.
    #[must_use]
    pub fn is_warning(&self) -> bool {
        self.error.severity() == Some(Severity::Warning)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl std::error::Error for Fault {}

impl Diagnostic for Fault {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.code()
    }
    fn severity(&self) -> Option<Severity> {
        self.error.severity()
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.help()
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = |(i, span): (usize, &SourceSpan)| {
            let words = if i == 0 { "здесь" } else { "и здесь" };
            LabeledSpan::new_with_span(Some(words.to_owned()), *span)
        };
        (!self.spans.is_empty()).then(|| Box::new(self.spans.iter().enumerate().map(label)) as _)
    }
}

/// Every fault of a map file, with the file.
#[derive(Debug, Clone)]
pub struct MapErrors {
    pub source: Option<Source>,
    /// Errors and warnings, in the order of the text.
    pub faults: Vec<Fault>,
}

impl MapErrors {
    pub fn of(error: MapError) -> Self {
        Self { source: None, faults: vec![Fault::new(error, Vec::new())] }
    }

    pub fn errors(&self) -> impl Iterator<Item = &Fault> + '_ {
        self.faults.iter().filter(|fault| !fault.is_warning())
    }

    pub fn warnings(&self) -> impl Iterator<Item = &Fault> + '_ {
        self.faults.iter().filter(|fault| fault.is_warning())
    }

    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.errors().next().is_some()
    }

    /// Line and character column of a fault's first place, from 1.
    #[must_use]
    pub fn position(&self, fault: &Fault) -> Option<(usize, usize)> {
        Some(self.source.as_ref()?.position(fault.spans.first()?.offset()))
    }
}

impl fmt::Display for MapErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (errors, warnings) = (self.errors().count(), self.warnings().count());
        match &self.source {
            Some(source) => write!(f, "карта «{}»: ", source.name())?,
            None => write!(f, "карта: ")?,
        }
        write!(f, "ошибок {errors}, предупреждений {warnings}")
    }
}

impl std::error::Error for MapErrors {}

/// The text, for excerpts beside the faults.
impl SourceCode for MapErrors {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let source = self.source.as_ref().ok_or(MietteError::OutOfBounds)?;
        source.read_span(span, lines_before, lines_after)
    }
}

impl Diagnostic for MapErrors {
    fn severity(&self) -> Option<Severity> {
        Some(if self.has_errors() { Severity::Error } else { Severity::Warning })
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|_| self as _)
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.faults.iter().map(|fault| fault as _)))
    }
}
