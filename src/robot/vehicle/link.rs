//! Where a vehicle is to be had: from a program that is started, or at an address that is called.

use std::fmt;
use std::net::{Shutdown, TcpStream};
use std::process::Child;
use std::str::FromStr;
use std::time::{Duration, Instant};

use crate::units::{Bilingual, said, word};

/// Where a vehicle is to be had: `cmd:PROGRAM ARGUMENT …` or `tcp:HOST:PORT`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Address {
    /// A program that speaks the protocol on its standard streams, and its arguments.
    Program(Vec<String>),
    Tcp(String),
}

impl FromStr for Address {
    type Err = Bilingual;

    /// Words of a command are parted by blanks; what stands in quotation marks, single or double, is one word.
    fn from_str(text: &str) -> Result<Self, Bilingual> {
        if let Some(command) = text.strip_prefix("cmd:") {
            let words = words_of(command).ok_or(word!("a-quotation-mark-is-not-closed"))?;
            return match words.is_empty() {
                true => Err(said!("a-command-is-wanted-behind-cmd")),
                false => Ok(Self::Program(words)),
            };
        }
        match text.strip_prefix("tcp:") {
            Some(address) if address.contains(':') => Ok(Self::Tcp(address.to_owned())),
            Some(_) => Err(said!("tcp-host-port-is-wanted")),
            None => Err(said!("cmd-or-tcp-is-wanted")),
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Program(words) => write!(f, "cmd:{}", words.join(" ")),
            Self::Tcp(address) => write!(f, "tcp:{address}"),
        }
    }
}

/// None where a quotation mark is not closed.
fn words_of(text: &str) -> Option<Vec<String>> {
    let (mut words, mut word, mut quote) = (Vec::new(), None::<String>, None);
    for c in text.chars() {
        match quote {
            Some(mark) if c == mark => quote = None,
            None if c == '"' || c == '\'' => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            None if c.is_whitespace() => words.extend(word.take()),
            _ => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    quote.is_none().then_some(words)
}

/// What ends when nobody speaks with the vehicle any more.
#[derive(Debug)]
pub(super) enum Link {
    Program(Child),
    Tcp(TcpStream),
}

/// So long a program may take to end once its input has ended.
const FAREWELL: Duration = Duration::from_secs(1);

impl Drop for Link {
    fn drop(&mut self) {
        match self {
            // Its input ends with the writing thread; what does not end by that is ended.
            Self::Program(child) => {
                let asked = Instant::now();
                while asked.elapsed() < FAREWELL {
                    if !matches!(child.try_wait(), Ok(None)) {
                        return;
                    }
                    std::thread::sleep(Duration::from_millis(5));
                }
                let _already_gone = child.kill();
                let _reaped = child.wait();
            }
            Self::Tcp(stream) => {
                let _already_gone = stream.shutdown(Shutdown::Both);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Address;

    #[test]
    fn an_address_is_read() {
        let read = |text: &str| text.parse::<Address>();
        let program = |words: &[&str]| {
            Ok(Address::Program(words.iter().map(|word| (*word).to_owned()).collect()))
        };
        assert_eq!(read("cmd:robot --at 3"), program(&["robot", "--at", "3"]));
        assert_eq!(read("cmd:\"my robot\" 'a b'c ''"), program(&["my robot", "a bc", ""]));
        assert_eq!(read("tcp:localhost:4000"), Ok(Address::Tcp("localhost:4000".to_owned())));
        for wrong in ["cmd:", "cmd:  ", "cmd:\"a", "tcp:4000", "robot", ""] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
