//! [`Failure`]: a vehicle that can be asked nothing more, and what it did to be held so.

use miette::Diagnostic;
use thiserror::Error;

use crate::units::{Bilingual, InEnglish, Language, Lengths, Pose};

/// Why a vehicle is of no more use. What it had done and told before stays known.
#[derive(Debug, Clone, PartialEq, Error, Diagnostic)]
#[non_exhaustive]
pub enum Failure {
    /// There is no way to speak with it.
    #[error("нет связи с роботом «{address}»: {why}")]
    #[diagnostic(
        code(vehicle::no_connection),
        help(
            "проверьте, что программа робота есть и запускается, или что по этому адресу её ждут"
        )
    )]
    NoConnection { address: String, why: String },
    /// The connection ended: the vehicle died, or the line was cut.
    #[error("связь с роботом прервалась на «{asked}»")]
    #[diagnostic(code(vehicle::lost), help("посмотрите, что написала программа робота"))]
    Lost { asked: &'static str },
    /// It kept silent longer than the caller waits, or an order took longer than any may.
    #[error("робот не ответил на «{asked}» за {seconds} с")]
    #[diagnostic(
        code(vehicle::timed_out),
        help(
            "у каждого приказа должен быть ответ, а пока он исполняется – сообщения о пути; см. docs/vehicle.md"
        )
    )]
    TimedOut { asked: &'static str, seconds: f64 },
    /// It said what the protocol does not know.
    #[error("робот ответил на «{asked}» тем, чего нет в протоколе: {why}: «{said}»")]
    #[diagnostic(code(vehicle::rubbish), help("сообщения описаны в docs/vehicle.md"))]
    Rubbish { asked: &'static str, said: String, why: Bilingual },
    /// It speaks another version of the protocol.
    #[error("робот говорит по протоколу версии {theirs}, а нужна версия {ours}")]
    #[diagnostic(code(vehicle::version), help("версии протокола описаны в docs/vehicle.md"))]
    Version { theirs: u32, ours: u32 },
    /// It says that it is where it was not sent.
    #[error(
        "робот сообщил, что он в {}: это в {} от пути, по которому он послан",
        at(pose),
        Lengths::said().told(*off, 0, Language::Russian)
    )]
    #[diagnostic(
        code(vehicle::off_the_way),
        help("поза должна быть в системе координат карты, в сантиметрах")
    )]
    OffTheWay { pose: Pose, off: f64 },
    /// It says that it faces another way than it was told to.
    #[error("робот сообщил, что он в {}: курс отличается от заданного на {off:.0}°", at(pose))]
    #[diagnostic(
        code(vehicle::wrong_heading),
        help("курс отсчитывается в градусах против часовой стрелки от оси x карты")
    )]
    WrongHeading { pose: Pose, off: f64 },
    /// It says that it is on another storey than it was sent to.
    #[error("робот сообщил, что он на другой карте, чем та, по которой он послан")]
    #[diagnostic(code(vehicle::wrong_map), help("карту меняет только поездка на лифте"))]
    WrongMap,
    /// It says that it is where there is no room.
    #[error("робот сообщил, что он в {}: там на карте нет помещения", at(pose))]
    #[diagnostic(
        code(vehicle::off_the_map),
        help("поза должна быть в системе координат карты, в сантиметрах")
    )]
    OffTheMap { pose: Pose },
    /// Its pose or its clock is no number, or its clock went back.
    #[error("робот сообщил позу или время, которых не бывает")]
    #[diagnostic(code(vehicle::no_number), help("числа должны быть конечными, время не убывает"))]
    NoNumber,
    /// It says itself that it can do no more.
    #[error("робот отказал: {text}")]
    #[diagnostic(code(vehicle::own_fault), help("посмотрите, что написала программа робота"))]
    OwnFault { text: String },
    /// It does not know where it is.
    #[error("робот не знает, где он: {why}")]
    #[diagnostic(
        code(vehicle::nowhere),
        help("скажите, где он стоит (--from), или отвезите его туда, где больше видно")
    )]
    Nowhere { why: Bilingual },
    /// What it sees changes with each look, so that no plan lasts.
    #[error("робот каждый раз видит мир иначе: одно и то же – по-разному, {times} раз")]
    #[diagnostic(code(vehicle::restless), help("проверьте, что робот сообщает о виденном"))]
    Restless { times: usize },
}

/// «(120; 85)», a point of the Map in cm.
fn at(pose: &Pose) -> String {
    let [x, y] = [pose.at.x, pose.at.y].map(|at| Lengths::said().number(at, 0));
    format!("({x}; {y})")
}

impl InEnglish for Failure {
    fn english(&self) -> String {
        match self {
            Self::NoConnection { address, why } => {
                format!("there is no connection to the robot \"{address}\": {why}")
            }
            Self::Lost { asked } => {
                format!("the connection to the robot was lost at \"{asked}\"")
            }
            Self::TimedOut { asked, seconds } => {
                format!("the robot did not answer \"{asked}\" within {seconds} s")
            }
            Self::Rubbish { asked, said, why } => format!(
                "the robot answered \"{asked}\" with what the protocol does not know: {}: \"{said}\"",
                why.say(Language::English)
            ),
            Self::Version { theirs, ours } => {
                format!(
                    "the robot speaks version {theirs} of the protocol, version {ours} is wanted"
                )
            }
            Self::OffTheWay { pose, off } => format!(
                "the robot says that it is at {}: {} off the way on which it was sent",
                at(pose),
                Lengths::said().told(*off, 0, Language::English)
            ),
            Self::WrongHeading { pose, off } => format!(
                "the robot says that it is at {}: it faces {off:.0}° away from where it was told to",
                at(pose)
            ),
            Self::WrongMap => {
                "the robot says that it is on another map than that on which it was sent".to_owned()
            }
            Self::OffTheMap { pose } => {
                format!("the robot says that it is at {}: the map has no room there", at(pose))
            }
            Self::NoNumber => "the robot told a pose or a time that cannot be".to_owned(),
            Self::OwnFault { text } => format!("the robot failed: {text}"),
            Self::Nowhere { why } => {
                format!("the robot does not know where it is: {}", why.say(Language::English))
            }
            Self::Restless { times } => {
                format!("the robot saw the same thing otherwise each time, {times} times")
            }
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::NoConnection { .. } => {
                "see that the robot's program is there and starts, or that it waits at this address"
            }
            Self::Lost { .. } | Self::OwnFault { .. } => "see what the robot's program wrote",
            Self::TimedOut { .. } => {
                "each order wants an answer, and messages of the way while it is under way; see docs/vehicle.md"
            }
            Self::Rubbish { .. } => "docs/vehicle.md describes the messages",
            Self::Version { .. } => "docs/vehicle.md describes the versions of the protocol",
            Self::OffTheWay { .. } | Self::OffTheMap { .. } => {
                "a pose is in the frame of the map, in centimetres"
            }
            Self::WrongHeading { .. } => {
                "a heading is in degrees counter-clockwise from the x axis of the map"
            }
            Self::WrongMap => "only a ride in a lift changes the map",
            Self::NoNumber => "numbers are finite, and time does not go back",
            Self::Nowhere { .. } => {
                "say where it stands (--from), or bring it to where there is more to see"
            }
            Self::Restless { .. } => "see what the robot says that it saw",
        };
        Some(help.to_owned())
    }

    fn english_labels(&self) -> [&'static str; 2] {
        ["", ""]
    }
}

impl Failure {
    /// What happened, in a language.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        match language {
            Language::Russian => self.to_string(),
            Language::English => self.english(),
        }
    }
}
