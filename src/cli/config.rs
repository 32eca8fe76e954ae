//! `ortho.toml`: what need not be said with every command.
//!
//! An argument counts before a variable of the environment, that before the file, and the file before what is usual.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, ColorChoice, CommandFactory, FromArgMatches};
use serde::Deserialize;

use crate::units::{Language, Lengths, Source};

use super::args::{Arguments, Lang};
use super::config_error::ConfigError;
use super::lengths::in_centimetres;

/// What the file says.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Config {
    language: Option<Word>,
    store: Option<PathBuf>,
    rules: Option<PathBuf>,
    vehicle: Option<Vehicle>,
    user: Option<String>,
    color: Option<Color>,
    units: Option<Units>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Units {
    Cm,
    M,
}

/// `ru` or `en`.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Word {
    Ru,
    En,
}

impl From<Word> for Lang {
    fn from(word: Word) -> Self {
        match word {
            Word::Ru => Self::Ru,
            Word::En => Self::En,
        }
    }
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Color {
    Auto,
    Always,
    Never,
}

/// An address that was looked at.
#[derive(Debug, Deserialize)]
#[serde(try_from = "String")]
struct Vehicle(String);

impl TryFrom<String> for Vehicle {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        super::vehicle::wheels(&text).map(|_| Self(text))
    }
}

/// So large a file of settings is none.
const LARGEST: u64 = 1 << 20;
const NAME: &str = "ortho.toml";

/// The arguments of this call, with what the settings say where they say nothing; and why a file of settings that was
/// named, or found, cannot be used.
pub(super) fn arguments() -> (Arguments, Option<Box<ConfigError>>) {
    let usual = Lang::of_locale();
    // Help, and faults of arguments, are told before the arguments are read, in the colours that the settings want.
    let named = said("config").map(PathBuf::from).or_else(|| set("ORTHO_CONFIG"));
    let Some(path) = named.or_else(found) else {
        return (Arguments::parse_whole(Arguments::command(), usual), None);
    };
    match Config::read(&path) {
        Ok(config) => {
            let usual = config.language.map(Lang::from).or(usual);
            (Arguments::parse_whole(config.laid_under(Arguments::command(), &path), usual), None)
        }
        Err(error) => (Arguments::parse_whole(Arguments::command(), usual), Some(Box::new(error))),
    }
}

/// What an option is given among the arguments, before these are read.
fn said(option: &str) -> Option<OsString> {
    let option = format!("--{option}");
    let mut words = std::env::args_os().skip(1).take_while(|word| word != "--");
    while let Some(word) = words.next() {
        if word == *option {
            return words.next();
        }
        let text = word.to_str().and_then(|word| word.strip_prefix(&option)?.strip_prefix('='));
        if let Some(value) = text {
            return Some(value.into());
        }
    }
    None
}

/// A path of the environment.
fn set(name: &str) -> Option<PathBuf> {
    std::env::var_os(name).filter(|path| !path.is_empty()).map(PathBuf::from)
}

/// The file of this folder, else the user's own.
fn found() -> Option<PathBuf> {
    let own = || {
        let home = || set("HOME").map(|home| home.join(".config"));
        Some(set("XDG_CONFIG_HOME").or_else(home)?.join("ortho").join(NAME))
    };
    [Some(PathBuf::from(NAME)), own()].into_iter().flatten().find(|path| path.is_file())
}

impl Arguments {
    /// Where neither they nor what is usual tell the language, it is that of what was said with the command.
    fn parse_whole(command: clap::Command, usual: Option<Lang>) -> Self {
        let usually = command.get_arguments().find(|arg| arg.get_id() == "color");
        let usually = usually.and_then(|arg| arg.get_default_values().first());
        let colour = said("color").or_else(|| usually.map(OsString::from));
        let command = command.color(match colour.as_ref().and_then(|word| word.to_str()) {
            Some("always") => ColorChoice::Always,
            Some("never") => ColorChoice::Never,
            _ => ColorChoice::Auto,
        });
        let read = |unit| {
            let words = in_centimetres(&command, std::env::args_os(), unit);
            let matches: ArgMatches = command.clone().get_matches_from(words);
            let mut read = Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
            let is_told = matches.value_source("lang") != Some(ValueSource::DefaultValue);
            if let (false, None, Some(said)) = (is_told, usual, read.command.words()) {
                read.common.lang = Language::of(said).pick(Lang::Ru, Lang::En);
            }
            read
        };
        // In which unit the lengths are is itself an argument.
        let read_in_cm = read(Lengths::Cm);
        match read_in_cm.common.units {
            Lengths::Cm => read_in_cm,
            unit => read(unit),
        }
    }
}

impl Config {
    fn read(path: &Path) -> Result<Self, ConfigError> {
        let text = crate::units::read_text(path, LARGEST).map_err(|error| {
            ConfigError::Unreadable { path: path.display().to_string(), reason: (&error).into() }
        })?;
        toml::from_str(&text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            ConfigError::Syntax {
                what: error.message().to_owned(),
                at: (span.start, span.end - span.start).into(),
                text: Source::new(path.display().to_string(), text.clone()),
            }
        })
    }

    /// The command line with other defaults. Paths count from the folder of the file.
    fn laid_under(self, command: clap::Command, file: &Path) -> clap::Command {
        let here = file.parent().unwrap_or(Path::new(""));
        let path = |path: PathBuf| here.join(path).into_os_string().into_string().ok();
        let language = self.language.map(|word| Lang::from(word).pick("ru", "en").to_owned());
        let color = self.color.map(|color| match color {
            Color::Auto => "auto".to_owned(),
            Color::Always => "always".to_owned(),
            Color::Never => "never".to_owned(),
        });
        let units = self.units.map(|units| match units {
            Units::Cm => "cm".to_owned(),
            Units::M => "m".to_owned(),
        });
        let told = [
            ("lang", language),
            ("units", units),
            ("store", self.store.and_then(path)),
            ("rules", self.rules.and_then(path)),
            ("user", self.user),
            ("color", color),
        ];
        let usual = |command: clap::Command, name: &'static str, value: String| {
            command.mut_arg(name, |arg| arg.default_value(value).hide_default_value(true))
        };
        let command = told.into_iter().fold(command, |command, (name, value)| match value {
            Some(value) => usual(command, name, value),
            None => command,
        });
        match self.vehicle {
            Some(Vehicle(at)) => command.mut_subcommand("do", |order| usual(order, "vehicle", at)),
            None => command,
        }
    }
}
