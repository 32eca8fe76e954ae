//! What can be wrong with a log.

use std::fmt;

use miette::{Diagnostic, SourceSpan};
use orthoframe_units::Source;
use thiserror::Error;

use crate::scan::SensorError;

/// One fault of a log, at its place.
#[derive(Debug, Clone, PartialEq, Error, Diagnostic)]
#[non_exhaustive]
pub enum LogFault {
    #[error("формат журнала не узнан")]
    #[diagnostic(
        code(vectors::log_unknown),
        help(
            "ожидается журнал CARMEN (FLASER, ROBOTLASER1), таблица дальностей с заголовком или строки чисел BreezySLAM"
        )
    )]
    Unknown {
        #[label("первая строка")]
        at: SourceSpan,
    },

    #[error("в журнале нет ни одного скана")]
    #[diagnostic(
        code(vectors::log_empty),
        help("сканы – это строки FLASER, ROBOTLASER1 или RAWLASER1")
    )]
    Empty {
        #[label("журнал начинается здесь")]
        at: SourceSpan,
    },

    #[error("«{found}» – не число")]
    #[diagnostic(
        code(vectors::log_not_number),
        help(
            "здесь стоит число, дробная часть – после точки; между «;» и табуляциями годится и запятая"
        )
    )]
    NotNumber {
        found: String,
        #[label("это слово")]
        at: SourceSpan,
    },

    #[error("«{found}» – не место")]
    #[diagnostic(
        code(vectors::log_no_place),
        help("координата позы – конечное число, меньше 10⁷ м или рад")
    )]
    NoPlace {
        found: String,
        #[label("это число")]
        at: SourceSpan,
    },

    #[error("число лучей «{found}» невозможно")]
    #[diagnostic(code(vectors::log_beams), help("целое число от 0 до 65536"))]
    Beams {
        found: String,
        #[label("число лучей")]
        at: SourceSpan,
    },

    #[error("{count} лучей: какое поле зрения, журнал не говорит")]
    #[diagnostic(
        code(vectors::log_field),
        help("укажите шаг в градусах строкой «PARAM laser_front_laser_resolution 0.25»")
    )]
    Field {
        count: usize,
        #[label("эта строка")]
        at: SourceSpan,
    },

    #[error("строка обрывается: есть слов {found}, нужно {needed}")]
    #[diagnostic(code(vectors::log_cut), help("допишите строку или удалите её"))]
    CutOff {
        found: usize,
        needed: usize,
        #[label("здесь конец строки")]
        at: SourceSpan,
    },

    #[error("в строке слов {found}, а должно быть {needed}")]
    #[diagnostic(
        code(vectors::log_too_long),
        help("лишнее удалите; слились две строки – разделите их")
    )]
    TooLong {
        found: usize,
        needed: usize,
        #[label("отсюда лишнее")]
        at: SourceSpan,
    },

    #[error("«{found}» – не сообщение журнала")]
    #[diagnostic(
        code(vectors::log_no_message),
        help("строка журнала CARMEN начинается именем сообщения; обрывок строки удалите")
    )]
    NoMessage {
        found: String,
        #[label("начало строки")]
        at: SourceSpan,
    },

    #[error("столбец «{column}» назван дважды")]
    #[diagnostic(code(vectors::log_column_twice), help("оставьте один из двух"))]
    Twice {
        column: String,
        #[label("второй раз")]
        at: SourceSpan,
    },

    #[error("единица столбца «{found}» не узнана")]
    #[diagnostic(
        code(vectors::log_unit),
        help("длины – m, cm или mm, углы – rad или deg, время – s, ms, us или ns")
    )]
    Unit {
        found: String,
        #[label("этот столбец")]
        at: SourceSpan,
    },

    #[error("в заголовке нет столбца «{column}»")]
    #[diagnostic(
        code(vectors::log_heading),
        help(
            "заголовок: angle_min, angle_increment, range_min, range_max, затем ranges0, ranges1, …; угол в рад, длина в м"
        )
    )]
    NoColumn {
        column: String,
        #[label("заголовок")]
        at: SourceSpan,
    },

    #[error("датчик невозможен: {fault}")]
    #[diagnostic(code(vectors::log_sensor), help("исправьте углы и дальности этой строки"))]
    Sensor {
        fault: SensorError,
        #[label("эта строка")]
        at: SourceSpan,
    },
}

impl LogFault {
    /// Byte offset at which the fault is shown.
    #[must_use]
    pub fn offset(&self) -> usize {
        self.labels().and_then(|mut labels| labels.next()).map_or(0, |label| label.offset())
    }
}

/// A log with faults, in the order of the text.
#[derive(Debug, Clone, Error, Diagnostic)]
#[diagnostic(code(vectors::log), help("остальные строки прочитаны"))]
pub struct LogError {
    #[source_code]
    pub source_text: Source,
    #[related]
    pub faults: Vec<LogFault>,
    /// Further faults that are only counted.
    pub more: usize,
}

/// A line per fault: `файл:строка:столбец: что не так`.
impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "журнал прочитан не весь, ошибок: {}", self.faults.len() + self.more)?;
        for fault in &self.faults {
            let (line, column) = self.source_text.position(fault.offset());
            write!(f, "\n{}:{line}:{column}: {fault}", self.source_text.name())?;
        }
        Ok(())
    }
}
