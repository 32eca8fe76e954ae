//! What can be wrong with a corridor file: every fault with its place.

use std::fmt;

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::units::{Bilingual, Source};

/// One fault of a corridor file.
#[derive(Debug, Clone, PartialEq, Eq, Error, Diagnostic)]
#[non_exhaustive]
pub enum CorridorFault {
    #[error("текст не читается как TOML: {message}")]
    #[diagnostic(code(corridor::syntax), help("образец: maps/corridor-paper4.toml"))]
    Syntax {
        message: String,
        #[label("здесь")]
        at: SourceSpan,
    },

    #[error("это не файл коридоров: текст начинается как JSON, а файл коридоров – TOML")]
    #[diagnostic(
        code(corridor::notation),
        help("образец: maps/corridor-paper4.toml; по карте ходят так: ortho corridor --map ФАЙЛ")
    )]
    Notation {
        #[label("здесь")]
        at: SourceSpan,
    },

    #[error("неизвестное поле «{field}»")]
    #[diagnostic(code(corridor::unknown_field), help("{hint}"))]
    UnknownField {
        field: String,
        hint: Bilingual,
        #[label("это поле")]
        at: SourceSpan,
    },

    #[error("не хватает поля «{field}»")]
    #[diagnostic(code(corridor::missing_field), help("{hint}"))]
    MissingField {
        field: &'static str,
        hint: Bilingual,
        #[label("здесь")]
        at: SourceSpan,
    },

    #[error("поле «{field}»: нужно {expected}")]
    #[diagnostic(code(corridor::wrong_value), help("исправьте значение"))]
    WrongValue {
        field: String,
        expected: Bilingual,
        #[label("это значение")]
        at: SourceSpan,
    },

    #[error("формат {found} неизвестен")]
    #[diagnostic(code(corridor::unknown_format), help("эта версия программы читает format = 1"))]
    UnknownFormat {
        found: i64,
        #[label("этот номер")]
        at: SourceSpan,
    },

    #[error("в описании нет ни одного коридора")]
    #[diagnostic(code(corridor::empty), help("добавьте [[corridor]] со списком along"))]
    Empty {
        #[label("здесь")]
        at: SourceSpan,
    },

    #[error("вершина {vertex} – и вход, и соединение коридоров")]
    #[diagnostic(
        code(corridor::room_and_junction),
        help("оставьте room с side или junction; у разных мест – разные номера вершин")
    )]
    RoomAndJunction {
        vertex: u32,
        #[label("здесь")]
        at: SourceSpan,
    },

    #[error("вход {vertex} уже стоит в другом месте")]
    #[diagnostic(
        code(corridor::repeated_entrance),
        help(
            "каждый вход описывается один раз; общей у двух коридоров бывает только вершина соединения"
        )
    )]
    RepeatedEntrance {
        vertex: u32,
        #[label("второй раз здесь")]
        at: SourceSpan,
        #[label("первый раз здесь")]
        first: SourceSpan,
    },

    #[error("у вершины {vertex} нигде не сказано, вход это или какое соединение коридоров")]
    #[diagnostic(
        code(corridor::undeclared_vertex),
        help("укажите room и side (вход) или junction (вид соединения) хотя бы в одном коридоре")
    )]
    UndeclaredVertex {
        vertex: u32,
        #[label("здесь")]
        at: SourceSpan,
    },

    #[error("вершина {vertex} стоит в списке дважды подряд")]
    #[diagnostic(
        code(corridor::vertex_meets_itself),
        help("уберите повторение; кольцо замыкает closed = true")
    )]
    VertexMeetsItself {
        vertex: u32,
        #[label("второй раз здесь")]
        at: SourceSpan,
    },

    #[error("дверь вершины {vertex} стоит прямо (ahead), но коридор за ней продолжается")]
    #[diagnostic(
        code(corridor::ahead_not_at_end),
        help("прямо бывает только дверь в торце тупика: первая или последняя в списке")
    )]
    AheadNotAtEnd {
        vertex: u32,
        #[label("эта сторона")]
        at: SourceSpan,
    },

    #[error("к соединению {vertex} не ведёт ни один участок этого коридора")]
    #[diagnostic(
        code(corridor::junction_without_approach),
        help(
            "вид соединения описывается так, как его видно с этого коридора: добавьте соседнюю вершину"
        )
    )]
    JunctionWithoutApproach {
        vertex: u32,
        #[label("здесь")]
        at: SourceSpan,
    },

    #[error("соединение {vertex}: вид «{kind}» не имеет пути {way}")]
    #[diagnostic(code(corridor::no_such_way), help("пути этого вида: {ways}"))]
    NoSuchWay {
        vertex: u32,
        kind: &'static str,
        way: &'static str,
        ways: String,
        #[label("этот путь")]
        at: SourceSpan,
    },

    #[error(
        "соединение {vertex}: соседа {neighbour} у него нет или к нему ведут несколько коридоров"
    )]
    #[diagnostic(code(corridor::no_such_neighbour), help("соседи по описанию: {neighbours}"))]
    NoSuchNeighbour {
        vertex: u32,
        neighbour: i64,
        neighbours: String,
        #[label("этот сосед")]
        at: SourceSpan,
    },

    #[error(
        "соединение {vertex}: вид «{kind}» требует коридоров: {wanted}, а описано: {found} (соседи {neighbours})"
    )]
    #[diagnostic(
        code(corridor::arms_disagree),
        help("исправьте вид, допишите коридор или отметьте пустой путь: blind = [\"right\"]")
    )]
    ArmsDisagree {
        vertex: u32,
        kind: &'static str,
        wanted: usize,
        found: usize,
        neighbours: String,
        #[label("этот вид")]
        at: SourceSpan,
    },

    #[error("соединение {vertex}: не ясно, какой коридор куда ведёт (соседи {neighbours})")]
    #[diagnostic(
        code(corridor::ambiguous_arms),
        help("назовите соседей, как их видно с этого коридора: straight = …, right = …, left = …")
    )]
    AmbiguousArms {
        vertex: u32,
        neighbours: String,
        #[label("это соединение")]
        at: SourceSpan,
    },

    #[error(
        "соединение {vertex}: здесь сказано «{said}», а по описанию другого коридора отсюда видно «{seen}»"
    )]
    #[diagnostic(
        code(corridor::junction_disagrees),
        help(
            "одно и то же соединение с разных сторон выглядит по-разному; исправьте одно из описаний"
        )
    )]
    JunctionDisagrees {
        vertex: u32,
        said: &'static str,
        seen: &'static str,
        #[label("это описание")]
        at: SourceSpan,
        #[label("другое описание")]
        first: SourceSpan,
    },

    #[error(
        "соединение {vertex}: путь {way} ведёт отсюда к «{said}», а по описанию другого коридора – к «{seen}»"
    )]
    #[diagnostic(code(corridor::way_disagrees), help("исправьте одно из описаний"))]
    WayDisagrees {
        vertex: u32,
        way: &'static str,
        said: Bilingual,
        seen: Bilingual,
        #[label("этот путь")]
        at: SourceSpan,
    },
}

impl CorridorFault {
    /// Byte offset at which the fault is shown.
    #[must_use]
    pub fn offset(&self) -> usize {
        self.labels().and_then(|mut labels| labels.next()).map_or(0, |label| label.offset())
    }
}

/// A corridor file that cannot be used, with all its faults in the order of the text.
#[derive(Debug, Clone, Error, Diagnostic)]
#[diagnostic(code(corridor::file), help("исправьте отмеченные места"))]
pub struct CorridorFileError {
    #[source_code]
    pub source_text: Source,
    #[related]
    pub faults: Vec<CorridorFault>,
}

/// A line per fault: `файл:строка:столбец: что не так`.
impl fmt::Display for CorridorFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "описание коридоров не принято, ошибок: {}", self.faults.len())?;
        for fault in &self.faults {
            let (line, column) = self.source_text.position(fault.offset());
            write!(f, "\n{}:{line}:{column}: {fault}", self.source_text.name())?;
        }
        Ok(())
    }
}
