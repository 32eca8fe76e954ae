//! Everything that can go wrong, gathered from the folders below, and what a person asked that has no answer.

use miette::Diagnostic;
use thiserror::Error;

use crate::corridor::{CorridorError, CorridorFileError};
use crate::exchange::ImportError;
use crate::facts::{AskError, FilesError};
use crate::language::Language;
use crate::language::command::Misheard;
use crate::language::names::named;
use crate::map::{Entity, MapErrors, World};
use crate::meaning::LangFaults;
use crate::robot::MissionError;
use crate::semantics::RelationError;
use crate::store::StoreError;
use crate::strips::RuleFaults;
use crate::units::{Bilingual, English, Lengths, capitalized, is_input};
use crate::vectors::picture::PictureError;
use crate::vectors::read::LogError;

/// Why the engine could not do what it was asked.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum Error {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Map(#[from] MapErrors),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Import(#[from] Box<ImportError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Rules(#[from] RuleFaults),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Relations(#[from] RelationError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Language(#[from] Box<LangFaults>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Store(#[from] StoreError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Misheard(#[from] Misheard),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Corridor(#[from] CorridorError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    CorridorFile(#[from] CorridorFileError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Datalog(#[from] Box<FilesError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Query(#[from] Box<AskError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Log(#[from] Box<LogError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
    #[cfg(feature = "pictures")]
    #[error(transparent)]
    #[diagnostic(transparent)]
    Png(#[from] crate::draw::PngError),
    #[cfg(feature = "sqlite")]
    #[error(transparent)]
    #[diagnostic(transparent)]
    Sqlite(#[from] crate::exchange::SqliteError),
    #[cfg(feature = "recordings")]
    #[error(transparent)]
    #[diagnostic(transparent)]
    Recording(#[from] crate::recording::RecordingError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Vehicle(#[from] Box<crate::robot::Failure>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Mission(Box<MissionError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Request(#[from] RequestError),
}

impl From<ImportError> for Error {
    fn from(error: ImportError) -> Self {
        match error {
            ImportError::Map(faults) => Self::Map(faults),
            error => Self::Import(Box::new(error)),
        }
    }
}

impl From<MissionError> for Error {
    fn from(error: MissionError) -> Self {
        match error {
            MissionError::Rules(faults) => Self::Rules(faults),
            MissionError::Relations(error) => Self::Relations(error),
            error => Self::Mission(Box::new(error)),
        }
    }
}

/// A request that speaks of what is not there, or not clearly enough.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum RequestError {
    /// A number that a drawing cannot take.
    #[error("{what} = {value}, а нужно от {low} до {high}")]
    #[diagnostic(code(draw::out_of_range), help("задайте --{what} от {low} до {high}"))]
    OutOfRange { what: &'static str, value: f64, low: f64, high: f64 },
    /// A scan that the log does not have.
    #[error("скана {scan} нет, сканов {count}")]
    #[diagnostic(code(see::no_scan), help("сканы считаются с 1: --scan от 1 до {count}"))]
    NoScan { scan: usize, count: usize },
    /// A picture, where scans are needed.
    #[error("это картинка, а нужен журнал сканов")]
    #[diagnostic(
        code(locate::no_log),
        help("назовите журнал: CARMEN, строки дальностей или Breezy")
    )]
    NoLog,
    /// A scan that tells no odometry cannot be followed.
    #[error("у скана в строке {line} нет одометрии")]
    #[diagnostic(code(locate::no_odometry), help("уберите --follow: каждый скан сам по себе"))]
    NoOdometry { line: usize },
    /// A scan whose pose is to be taken from the log has none there.
    #[error("у скана в строке {line} нет позы")]
    #[diagnostic(
        code(locate::no_pose),
        help("уберите --posed: место будет найдено по карте; или возьмите журнал с позами")
    )]
    NoPose { line: usize },
    /// Scans cannot be laid beside one another.
    #[error("сканов {count}, и ни у одного нет позы: неизвестно, откуда что видно")]
    #[diagnostic(
        code(see::no_poses),
        help("постройте вещи одного скана (--scan 1 --models) или возьмите журнал с позами")
    )]
    NoPoses { count: usize },
    /// Built without pictures.
    #[error("эта сборка не умеет писать PNG")]
    #[diagnostic(code(draw::no_png), help("соберите с `--features pictures` или запишите SVG"))]
    NoPng,
    /// Several storeys, and one place to draw them.
    #[error("этажей {count}, у каждого свой лист")]
    #[diagnostic(
        code(draw::many_sheets),
        help(
            "назовите файл: -o plan.svg; следующие листы – plan-2.svg и дальше; или назовите этаж"
        )
    )]
    ManySheets { count: usize },
    /// A file that no drawing can become.
    #[error("«.{ending}»: рисунок пишется как SVG или PNG")]
    #[diagnostic(
        code(draw::format),
        help("назовите файл с концом .svg или .png, или добавьте --png")
    )]
    DrawingFormat { ending: String },
    /// There is nothing of which a plan could be drawn.
    #[error("в домейне нет ни одной карты")]
    #[diagnostic(code(engine::no_maps), help("нарисуйте объект: ortho draw object ИМЯ"))]
    NoMaps,
    /// The store holds no map yet.
    #[error("в хранилище «{store}» нет карты")]
    #[diagnostic(code(engine::no_map), help("импортируйте карту: ortho import maps/rb2.toml"))]
    NoMap { store: String },

    /// The history begins later.
    #[error("карты ещё не было: история начинается позже")]
    #[diagnostic(code(engine::before_the_map), help("когда что было: ortho history"))]
    BeforeTheMap,

    /// A fact that does not read as one.
    #[error("«{text}» не читается как факт")]
    #[diagnostic(
        code(engine::fact),
        help(
            "факт пишется как ОТНОШЕНИЕ(имя, имя), например НАХОДИТСЯ_СВЕРХУ_НА(Чашка-1, Стол-1)"
        )
    )]
    Fact { text: String },

    /// A name that nothing bears.
    #[error("на карте нет имени «{name}»")]
    #[diagnostic(code(engine::unknown_name))]
    UnknownName {
        name: String,
        #[help]
        help: Option<Bilingual>,
    },

    /// A name that several things bear, or that could be read in several ways.
    #[error("имя «{name}» можно понять по-разному: {candidates}")]
    #[diagnostic(code(engine::ambiguous_name), help("назовите одно из них полностью"))]
    AmbiguousName { name: String, candidates: Bilingual },

    /// A relation that the rules do not declare.
    #[error("нет отношения «{name}»")]
    #[diagnostic(code(engine::unknown_relation))]
    UnknownRelation {
        name: String,
        #[help]
        help: Option<Bilingual>,
    },

    /// A thing is not where an order says that it is.
    #[error("«{thing}» сейчас не там, где сказано: «{place}»")]
    #[diagnostic(code(engine::not_there), help("спросите «Где …?» и скажите, что имелось в виду"))]
    NotThere { thing: Bilingual, place: Bilingual },

    /// Something that is no place to go to, or from.
    #[error("«{name}» – не место, до которого можно доехать")]
    #[diagnostic(code(engine::not_a_place), help("назовите точку, помещение, дверь или вещь"))]
    NotAPlace { name: Bilingual },

    /// Two places on different maps.
    #[error("«{from}» и «{to}» находятся на разных картах")]
    #[diagnostic(code(engine::other_map), help("назовите места одного этажа"))]
    OtherMap { from: String, to: String },

    /// A pose outside of every Area.
    #[error("точка {at} не лежит ни в одном помещении карты «{map}»")]
    #[diagnostic(
        code(engine::nowhere),
        help("координаты – в системе карты, {}: карта занимает {extent}", Lengths::said().word(Language::Russian))
    )]
    Nowhere { at: String, map: Bilingual, extent: String },

    /// Coordinates that are none.
    #[error("«{text}» – не поза: {reason}")]
    #[diagnostic(code(engine::bad_pose), help("напишите X,Y или X,Y,КУРС, например 250,380,90"))]
    BadPose { text: String, reason: Bilingual },

    /// A text that is no report of a position.
    #[error("«{text}» не читается как доклад о положении, начиная с «{word}»")]
    #[diagnostic(
        code(engine::no_report),
        help("например: «Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.»")
    )]
    NoReport { text: String, word: String },

    /// A report of a position that the map does not bear out.
    #[error("такого места на карте нет: {reason}")]
    #[diagnostic(code(engine::no_such_place), help("слова понятны: сверьте имена с картой"))]
    NoSuchPlace { reason: Bilingual },

    /// Which of several maps is meant.
    #[error("в домейне несколько карт: {candidates}")]
    #[diagnostic(code(engine::which_map), help("назовите одну из них"))]
    WhichMap { candidates: Bilingual },

    /// A side of a thing on which the robot has no place to stand.
    #[error("«{name}»: с той стороны роботу негде встать")]
    #[diagnostic(
        code(engine::no_floor_there),
        help("назовите другую сторону: перед, за, слева или справа")
    )]
    NoFloorThere { name: Bilingual },

    /// A point that was told by its coordinates, where the robot does not fit.
    #[error("в точке {at} и возле неё робот не встанет")]
    #[diagnostic(code(engine::no_floor_at), help("выберите точку на свободном полу"))]
    NoFloorAt { at: String },

    /// A point that was told by its coordinates, where more than to go there was ordered.
    #[error("в точку {at} я могу только приехать")]
    #[diagnostic(
        code(engine::only_gone_to),
        help("чтобы что-то там положить, назовите вещь, помещение или место карты")
    )]
    OnlyGoneTo { at: String },

    /// Something that is to be put where nothing is put: under a bed.
    #[error(
        "«{name}»: кладу я на вещь, в вещь, рядом с ней или в помещение, но не под, не за, не перед и не сбоку"
    )]
    #[diagnostic(
        code(engine::not_put_there),
        help("скажите, на что, во что или в какое помещение положить")
    )]
    NotPutThere { name: Bilingual },

    /// The time of a way is asked for, and the map does not tell where it leads.
    #[error("карта не говорит, где это: {names}; сколько времени займёт путь, неизвестно")]
    #[diagnostic(
        code(plan::untimed),
        help(
            "назовите места и двери, как их знает карта (ortho plan --facts), или уберите --metric time"
        )
    )]
    Untimed { names: Bilingual },

    /// A map that tells of no place where the robot charges.
    #[error("на карте нет места для зарядки")]
    #[diagnostic(
        code(engine::no_charger),
        help(
            "место для зарядки – это место или вещь, в названии или типе которых есть «зарядка» или «charger»"
        )
    )]
    NoCharger,

    /// A map that does not tell where the robot begins.
    #[error("на карте не указано, где место робота")]
    #[diagnostic(code(engine::no_start), help("укажите start в разделе robot карты"))]
    NoStart,

    /// A lift was called where there is none.
    #[error("на этом этаже нет лифта")]
    #[diagnostic(code(engine::no_lift), help("лифты здания объявляются в разделе domain карты"))]
    NoLift,

    /// Something that is to be carried and is too large or stands fast.
    #[error("«{name}» робот не носит")]
    #[diagnostic(
        code(engine::not_portable),
        help("носить можно то, чей тип имеет признак portable")
    )]
    NotPortable { name: Bilingual },

    /// Something of which the map knows no inside: a table, or a bowl that it draws as a solid block.
    #[error("в «{name}» ничего не положить: места внутри карта не знает")]
    #[diagnostic(code(engine::not_hollow), help("скажите, на что положить"))]
    NotHollow { name: Bilingual },

    /// Something whose inside is behind doors that are shut.
    #[error("«{name}»: дверцы закрыты, а дверцы мебели робот не открывает")]
    #[diagnostic(
        code(engine::shut),
        help("откройте сами и скажите карте: ortho edit state ДВЕРЦА open")
    )]
    Shut { name: Bilingual },

    /// A thing that is behind doors that are shut.
    #[error("«{thing}» лежит в «{container}», а там закрыто, и дверцы мебели робот не открывает")]
    #[diagnostic(
        code(engine::shut_in),
        help("откройте сами и скажите карте: ortho edit state ДВЕРЦА open")
    )]
    ShutIn { thing: Bilingual, container: Bilingual },

    /// Nothing in a room can take a thing.
    #[error("«{area}»: «{thing}» там некуда положить")]
    #[diagnostic(code(engine::no_space), help("назовите, на что положить"))]
    NoSpace { thing: Bilingual, area: Bilingual },

    /// Something that is to be opened and is locked, as furniture is without a key of the robot's.
    #[error("«{name}» заперто, а ключа от мебели у робота нет")]
    #[diagnostic(
        code(engine::locked),
        help("откройте сами и скажите карте: ortho edit state ДВЕРЦА open")
    )]
    Locked { name: Bilingual },

    /// A task that waits was meant, and it is not said which.
    #[error("непонятно, какое задание: в очереди {waiting}")]
    #[diagnostic(
        code(engine::which_queued),
        help("назовите номер: «отмени 2»; «отмени всё» отменит все")
    )]
    WhichQueued { waiting: usize },

    /// Something is to be thrown away, and nothing is there for that.
    #[error("на карте нет, куда это выбросить: «{thing}»")]
    #[diagnostic(
        code(engine::no_bin),
        help("ведро для мусора – вещь, чей тип или его синоним так и называется")
    )]
    NoBin { thing: Bilingual },

    /// Something that is to be opened or shut and is no door between rooms.
    #[error("«{name}» – не дверь между помещениями, а других робот не открывает")]
    #[diagnostic(code(engine::not_a_door), help("двери карты: ortho relations --name СОЕДИНЯЕТ"))]
    NotADoor { name: Bilingual },

    /// A door that joins no two rooms of the map.
    #[error("«{name}» ведёт наружу, а робот пользуется только дверями между помещениями")]
    #[diagnostic(
        code(engine::leads_outside),
        help("двери карты: ortho relations --name СОЕДИНЯЕТ")
    )]
    LeadsOutside { name: Bilingual },

    /// A thing that is to be clean: rooms, and what bears things, are tidied.
    #[error("робот прибирает вещи, а не моет и не чистит: «{name}» остаётся как есть")]
    #[diagnostic(
        code(engine::not_cleaned),
        help("прибирают помещения и то, на чём лежат вещи: «Приберись на столе»")
    )]
    NotCleaned { name: Bilingual },

    /// A thing is to be cleared of what is kept on it.
    #[error("на «{name}» нет ничего, чьё место известно и не там: «{}»; куда это положить?", russian_names(things).join("», «"))]
    #[diagnostic(code(engine::kept_there), help("скажите, куда это положить"))]
    KeptThere { things: Vec<Bilingual>, name: Bilingual },

    /// Things are to be put away that lie where they are kept, each with that.
    #[error("{}", told_each(things, |thing, home| format!("«{thing}» лежит там, где и хранится: «{home}»")))]
    #[diagnostic(code(engine::at_home), help("скажите, куда это положить"))]
    AtHome { things: Vec<(Bilingual, Bilingual)> },

    /// Several things that are to be taken, and put nowhere.
    #[error("рука у робота одна, а взять велено несколько вещей: «{}»; куда их положить?", russian_names(things).join("», «"))]
    #[diagnostic(code(engine::one_hand), help("скажите, куда положить"))]
    OneHand { things: Vec<Bilingual> },

    /// Something that is to be switched and has no switch.
    #[error("«{name}» нельзя ни включить, ни выключить")]
    #[diagnostic(code(engine::not_a_device), help("прибор – то, чей тип имеет признак device"))]
    NotADevice { name: Bilingual },

    /// Nobody knows where some things belong.
    #[error("неизвестно, где место для «{}»", russian_names(things).join("», «"))]
    #[diagnostic(
        code(engine::homeless),
        help("скажите, куда положить, или дайте вещи свойство ХРАНИТСЯ_НА")
    )]
    Homeless { things: Vec<Bilingual> },

    /// The place where a thing is kept is not on the map.
    #[error("«{thing}» хранится на «{home}», а такой вещи на карте нет")]
    #[diagnostic(code(engine::no_home), help("исправьте свойство ХРАНИТСЯ_НА"))]
    NoHome { thing: Bilingual, home: String },

    /// A change of the map as it was.
    #[error("прошлое карты нельзя править")]
    #[diagnostic(
        code(engine::past),
        help("уберите --as-of; вернуть карту к прошлому: ortho as-of КОГДА --restore")
    )]
    PastIsPast,

    /// Something that is asked after as a thing and is none.
    #[error("«{name}» – не вещь")]
    #[diagnostic(code(engine::not_a_thing), help("вещи карты: ortho relations --name СОДЕРЖИТ"))]
    NotAThing { name: Bilingual },

    /// Something that is asked after as a room and is none.
    #[error("«{name}» – не помещение")]
    #[diagnostic(code(engine::not_an_area), help("назовите помещение карты"))]
    NotAnArea { name: Bilingual },

    /// A thing at a moment when the map did not have it.
    #[error("«{name}» тогда ещё не было на карте")]
    #[diagnostic(
        code(engine::not_yet),
        help("назовите более позднее время; история вещи: ortho find ИМЯ --story")
    )]
    NotYet { name: Bilingual },

    /// A thing of which nothing else is believed than the map says.
    #[error("«{name}»: поправки нет, вещь стоит там, где на карте")]
    #[diagnostic(code(engine::nothing_proposed), help("список поправок: ortho proposals"))]
    NothingProposed { name: Bilingual },

    /// The Map does not say where the robot is.
    #[error("неизвестно, где робот")]
    #[diagnostic(
        code(engine::robot_nowhere),
        help("назовите его место: ortho do … --from МЕСТО, или в карте: [robot] start = «точка»")
    )]
    RobotNowhere,

    /// A truth that stands something on the robot.
    #[error("на деле там, где стоит робот, находится «{thing}»")]
    #[diagnostic(
        code(engine::truth_on_robot),
        help("подвиньте вещь в файле --truth, или поставьте робота в другое место: --from МЕСТО")
    )]
    TruthOnRobot { thing: Bilingual },

    /// A directory of rule files that was named and is not there.
    #[error("каталога правил «{dir}» нет")]
    #[diagnostic(
        code(engine::no_rules),
        help(
            "укажите каталог с relations.dl или service-robot.strips либо уберите --rules: правила есть и в самой программе"
        )
    )]
    NoRules { dir: String },

    /// Rule files where others are to be written.
    #[error("здесь уже есть файлы правил: {files}")]
    #[diagnostic(
        code(engine::rules_there),
        help("назовите другой каталог, или перезапишите их: ortho rules --export КАТАЛОГ --force")
    )]
    RulesThere { files: String },

    /// A floor too large for a picture.
    #[error("этаж «{map}» не помещается в картинку из {limit} клеток")]
    #[diagnostic(code(engine::grid_too_large), help("возьмите клетку крупнее: --cell 10"))]
    GridTooLarge { map: Bilingual, limit: usize },

    /// A file that cannot be read or written.
    #[error("файл «{path}»: {reason}")]
    #[diagnostic(code(engine::file), help("проверьте путь и права доступа"))]
    File {
        path: String,
        reason: Bilingual,
        /// What was named is at fault, not the disk.
        is_input: bool,
    },
}

impl Error {
    /// Whether all that an order lacks is whither something goes.
    pub(super) fn asks_whither(&self) -> bool {
        match self {
            Self::Misheard(misheard) => misheard.asks_whither(),
            Self::Request(request) => matches!(
                request,
                RequestError::KeptThere { .. }
                    | RequestError::AtHome { .. }
                    | RequestError::OneHand { .. }
            ),
            _ => false,
        }
    }

    /// The fault as English tells it, with its places and remedies.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Map(faults) => Box::new(faults.in_english()),
            Self::Import(error) => match error.as_ref() {
                ImportError::Map(faults) => Box::new(faults.in_english()),
                error => Box::new(English(error)),
            },
            Self::Rules(faults) => Box::new(faults.in_english()),
            Self::Relations(error) => error.in_english(),
            Self::Language(faults) => Box::new(faults.in_english()),
            Self::Store(error) => Box::new(English(error)),
            Self::Misheard(error) => Box::new(English(error)),
            Self::Corridor(error) => Box::new(English(error)),
            Self::CorridorFile(error) => Box::new(error.in_english()),
            Self::Datalog(error) => error.in_english(),
            Self::Query(error) => error.in_english(),
            Self::Log(error) => Box::new(error.in_english()),
            Self::Picture(error) => Box::new(English(error)),
            #[cfg(feature = "pictures")]
            Self::Png(error) => Box::new(English(error)),
            #[cfg(feature = "sqlite")]
            Self::Sqlite(error) => Box::new(English(error)),
            #[cfg(feature = "recordings")]
            Self::Recording(error) => Box::new(English(error)),
            Self::Vehicle(error) => Box::new(English(error.as_ref())),
            Self::Mission(error) => error.in_english(),
            Self::Request(error) => Box::new(English(error)),
        }
    }

    /// The fault as a sentence of a language.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        match (language, self) {
            (_, Self::Misheard(misheard)) => misheard.say(language),
            (Language::Russian, _) => capitalized(&self.to_string()),
            (Language::English, _) => sentence(&self.in_english().to_string()),
        }
    }

    /// The input is at fault, not the program or the disk.
    #[must_use]
    pub fn is_input(&self) -> bool {
        match self {
            Self::Map(_)
            | Self::Import(_)
            | Self::Rules(_)
            | Self::Relations(_)
            | Self::Language(_)
            | Self::Query(_)
            | Self::Misheard(_)
            | Self::Mission(_)
            | Self::Corridor(_)
            | Self::CorridorFile(_)
            | Self::Log(_)
            | Self::Picture(_) => true,
            Self::Datalog(error) => match error.as_ref() {
                FilesError::File { cause, .. } => is_input(cause.kind()),
                _ => true,
            },
            Self::Request(RequestError::File { is_input, .. }) => *is_input,
            Self::Request(_) => true,
            #[cfg(feature = "pictures")]
            Self::Png(_) => true,
            #[cfg(feature = "sqlite")]
            Self::Sqlite(error) => error.is_input(),
            Self::Store(error) => error.is_input(),
            #[cfg(feature = "recordings")]
            Self::Recording(error) => error.is_input(),
            Self::Vehicle(_) => false,
        }
    }
}

/// The names of what is on the map.
pub(super) fn both(world: &World, entity: Entity) -> Bilingual {
    Bilingual::new(world.name(entity).to_owned(), named(world, entity).english())
}

/// What the map calls so, in both languages; what it does not know goes by the same name in both.
pub(super) fn in_both(world: &World, name: &str) -> Bilingual {
    match world.find(name).first() {
        Some(entity) => both(world, *entity),
        None => name.to_owned().into(),
    }
}

fn russian_names(names: &[Bilingual]) -> Vec<&str> {
    names.iter().map(|name| name.say(Language::Russian)).collect()
}

fn told_each(
    things: &[(Bilingual, Bilingual)],
    told: impl Fn(&Bilingual, &Bilingual) -> String,
) -> String {
    things.iter().map(|(thing, home)| told(thing, home)).collect::<Vec<_>>().join("; ")
}

fn sentence(told: &str) -> String {
    let stop = if told.ends_with(['.', '?', '!']) { "" } else { "." };
    format!("{}{stop}", capitalized(told))
}
