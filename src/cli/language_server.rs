//! `ortho language-server`: rule files under an editor, by the Language Server Protocol 3.17 over standard streams.
//!
//! For relations (`.dl`) and robot rules (`.strips`): faults and warnings as they are typed, what a name means with its
//! names in both languages (hover), where it is declared (definition), the names of a file, and names to complete.
//! Documents are sent whole. A rule file of one's own may use what `rules/relations.dl` declares, as in the program.

use std::collections::{BTreeMap, VecDeque};
use std::io::{self, BufRead, Read as _, Write};
use std::path::{Component, Path, PathBuf};

use miette::Diagnostic;
use serde_json::{Value, json};

use super::Answer;
use super::fault::Failure;
use crate::facts::{self, FilesError, Program};
use crate::semantics::STANDARD;
use crate::strips::{self, Scenario};
use crate::units::{InOrder as _, Source, name_key};

/// A message that is longer is none.
const MAX_MESSAGE: usize = 64 << 20;
/// A rule file beside the one that is open.
const MAX_FILE: u64 = 4 << 20;
/// A line of a message's head.
const MAX_LINE: u64 = 1 << 12;

pub(super) fn run() -> Result<Answer, Failure> {
    let (input, output) = (io::stdin().lock(), io::stdout().lock());
    let ended = Server::default()
        .serve(input, output)
        .map_err(|error| Failure::Output(error.to_string()))?;
    Ok(if ended { Answer::Yes } else { Answer::No })
}

/// A place that names something, whatever the language of the file.
struct Mark {
    range: std::ops::Range<usize>,
    name: String,
    /// As names are compared, with what the name is one of.
    key: (String, u8),
    declared: Option<String>,
    /// Nothing declares it here; what is said of it is what its first place says.
    is_first_mention: bool,
}

/// Where a name is declared.
struct Declared {
    /// The document's URI; empty for the program itself.
    place: String,
    text: String,
    mark: Mark,
}

/// A text in which a name is looked for.
struct Text {
    place: String,
    text: String,
    /// Of texts that name a thing and do not declare it, one that is included says most, then the document itself.
    rank: u8,
}

#[derive(Debug, Default)]
struct Server {
    /// Open documents by their URI.
    documents: BTreeMap<String, String>,
    is_shut_down: bool,
}

impl Server {
    /// Answers until `exit` or the end of the input; whether it was asked to shut down before.
    fn serve(mut self, mut input: impl BufRead, mut output: impl Write) -> io::Result<bool> {
        while let Some(message) = read(&mut input)? {
            let method = message["method"].as_str().unwrap_or_default();
            if method == "exit" {
                break;
            }
            let id = &message["id"];
            let params = &message["params"];
            if id.is_null() {
                if let Some(uri) = self.note(method, params) {
                    let diagnostics = self.diagnostics(&uri);
                    let params = json!({ "uri": uri, "diagnostics": diagnostics });
                    let told = json!({ "jsonrpc": "2.0", "method": "textDocument/publishDiagnostics", "params": params });
                    write(&mut output, &told)?;
                }
                continue;
            }
            let answer = match self.answer(method, params) {
                Some(result) => json!({ "jsonrpc": "2.0", "id": id, "result": result }),
                None => json!({
                    "jsonrpc": "2.0", "id": id,
                    "error": { "code": -32601, "message": format!("no method «{method}»") },
                }),
            };
            write(&mut output, &answer)?;
        }
        Ok(self.is_shut_down)
    }

    /// Takes a notification; gives the document whose faults may have changed.
    fn note(&mut self, method: &str, params: &Value) -> Option<String> {
        let document = &params["textDocument"];
        let uri = document["uri"].as_str()?.to_owned();
        match method {
            "textDocument/didOpen" => {
                self.documents.insert(uri.clone(), document["text"].as_str()?.to_owned());
            }
            "textDocument/didChange" => {
                let last = params["contentChanges"].as_array()?.last()?;
                self.documents.insert(uri.clone(), last["text"].as_str()?.to_owned());
            }
            "textDocument/didClose" => {
                self.documents.remove(&uri);
            }
            _ => return None,
        }
        Some(uri)
    }

    fn answer(&mut self, method: &str, params: &Value) -> Option<Value> {
        let uri = params["textDocument"]["uri"].as_str().unwrap_or_default();
        Some(match method {
            "initialize" => json!({
                "capabilities": {
                    "textDocumentSync": 1,
                    "hoverProvider": true,
                    "definitionProvider": true,
                    "documentSymbolProvider": true,
                    "documentFormattingProvider": true,
                    "completionProvider": {},
                },
                "serverInfo": { "name": "ortho", "version": env!("CARGO_PKG_VERSION") },
            }),
            "shutdown" => {
                self.is_shut_down = true;
                Value::Null
            }
            "textDocument/hover" => self.hover(uri, &params["position"]),
            "textDocument/definition" => self.definition(uri, &params["position"]),
            "textDocument/documentSymbol" => self.symbols(uri),
            "textDocument/completion" => self.completion(uri),
            "textDocument/formatting" => self.formatted(uri),
            _ => return None,
        })
    }

    /// The faults of a document; none of one that is closed.
    fn diagnostics(&self, uri: &str) -> Vec<Value> {
        let Some(text) = self.documents.get(uri) else { return Vec::new() };
        let path = path_of(uri);
        let source = Source::new(path.display().to_string(), text);
        match is_robot_rules(uri) {
            true => robot_faults(&source, &path),
            false => relation_faults(&source, &path),
        }
    }

    /// The name at a position, and where it is declared: in this document, in a file that it includes, in another open
    /// document, in a file beside it, or in the program itself. What nothing declares is what its first place says.
    fn named(&self, uri: &str, position: &Value) -> Option<(Mark, Option<Declared>)> {
        let text = self.documents.get(uri)?;
        let offset = offset_of(text, position)?;
        let within = |mark: &Mark| mark.range.start <= offset && offset <= mark.range.end;
        // The innermost of several.
        let at = marks(uri, text).into_iter().filter(within).min_by_key(|mark| mark.range.len())?;
        let is_it = |mark: &Mark| mark.key == at.key && mark.declared.is_some();
        let mut mentioned: Option<(u8, Declared)> = None;
        for Text { place, text, rank } in self.around(uri, text) {
            let Some(mark) = marks_of_kind(uri, &place, &text).into_iter().find(is_it) else {
                continue;
            };
            let is_first_mention = mark.is_first_mention;
            let found = Declared { place, text, mark };
            if !is_first_mention {
                return Some((at, Some(found)));
            }
            if mentioned.as_ref().is_none_or(|(known, _)| rank < *known) {
                mentioned = Some((rank, found));
            }
        }
        Some((at, mentioned.map(|(_, found)| found)))
    }

    /// The texts in which a document's names are looked for, in their order.
    fn around(&self, uri: &str, text: &str) -> Vec<Text> {
        const MOST: usize = 64;
        let mut found = vec![Text { place: uri.to_owned(), text: text.to_owned(), rank: 1 }];
        let path = path_of(uri);
        let is_file = uri.starts_with("file://");
        let mut known = vec![path.clone()];
        let mut take = |mut open: VecDeque<PathBuf>, rank: u8, found: &mut Vec<Text>| {
            while let Some(path) = open.pop_front().filter(|_| found.len() < MOST) {
                if known.contains(&path) {
                    continue;
                }
                known.push(path.clone());
                let opened = self.documents.iter().find(|(uri, _)| path_of(uri) == path);
                let text = opened.map(|(_, text)| text.clone()).or_else(|| {
                    let source = Source::read_within(&path, MAX_FILE).ok()?;
                    Some(source.text().to_owned())
                });
                let Some(text) = text else { continue };
                open.extend(included(&path, &text));
                let place = opened.map_or_else(|| uri_of(&path), |(uri, _)| uri.clone());
                found.push(Text { place, text, rank });
            }
        };
        if is_file {
            take(included(&path, text).into(), 0, &mut found);
        }
        take(self.documents.keys().map(|uri| path_of(uri)).collect(), 2, &mut found);
        if is_file {
            let beside = path.parent().and_then(|folder| std::fs::read_dir(folder).ok());
            let mut beside: Vec<PathBuf> =
                beside.into_iter().flatten().flatten().map(|entry| entry.path()).collect();
            beside.retain(|other| other.extension() == path.extension());
            beside.order();
            take(beside.into(), 2, &mut found);
        }
        if !is_robot_rules(uri) {
            found.push(Text { place: String::new(), text: STANDARD.to_string(), rank: 2 });
        }
        found
    }

    fn hover(&self, uri: &str, position: &Value) -> Value {
        let Some((at, Some(declared))) = self.named(uri, position) else { return Value::Null };
        let text = declared.mark.declared.unwrap_or_default();
        let value = format!("```\n{text}\n```");
        json!({
            "contents": { "kind": "markdown", "value": value },
            "range": range(&self.documents[uri], &at.range),
        })
    }

    fn definition(&self, uri: &str, position: &Value) -> Value {
        match self.named(uri, position) {
            Some((_, Some(Declared { place, text, mark }))) if !place.is_empty() => {
                json!({ "uri": place, "range": range(&text, &mark.range) })
            }
            _ => Value::Null,
        }
    }

    fn symbols(&self, uri: &str) -> Value {
        const KINDS: [u8; 8] = [12, 5, 2, 10, 5, 12, 6, 13];
        let Some(text) = self.documents.get(uri) else { return json!([]) };
        let declared = marks(uri, text).into_iter().filter(|mark| mark.declared.is_some());
        let symbols = declared.map(|mark| {
            let range = range(text, &mark.range);
            let kind = KINDS[usize::from(mark.key.1) % KINDS.len()];
            json!({ "name": mark.name, "kind": kind, "range": range, "selectionRange": range })
        });
        symbols.collect()
    }

    fn completion(&self, uri: &str) -> Value {
        let mut names: BTreeMap<String, String> = BTreeMap::new();
        let mut take = |marks: Vec<Mark>| {
            for mark in marks {
                if let Some(declared) = mark.declared {
                    names.insert(mark.name, declared.lines().last().unwrap_or_default().to_owned());
                }
            }
        };
        let Some(text) = self.documents.get(uri) else { return json!([]) };
        for Text { place, text, .. } in self.around(uri, text) {
            take(marks_of_kind(uri, &place, &text));
        }
        names.into_iter().map(|(name, told)| json!({ "label": name, "detail": told })).collect()
    }

    /// One edit of the whole text; robot rules have no usual form.
    fn formatted(&self, uri: &str) -> Value {
        let Some(text) = self.documents.get(uri).filter(|_| !is_robot_rules(uri)) else {
            return json!([]);
        };
        let formatted = facts::format_rules(text);
        match formatted == *text {
            true => json!([]),
            false => json!([{ "range": range(text, &(0..text.len())), "newText": formatted }]),
        }
    }
}

fn is_robot_rules(uri: &str) -> bool {
    uri.ends_with(".strips")
}

fn marks(uri: &str, text: &str) -> Vec<Mark> {
    let source = Source::new(uri, text);
    if is_robot_rules(uri) {
        let marks = strips::outline(&source).into_iter().map(|mark| Mark {
            range: mark.range,
            name: mark.name,
            key: (mark.key, 4 + mark.means as u8),
            declared: mark.declared,
            is_first_mention: mark.is_first_mention,
        });
        return marks.collect();
    }
    let marks = facts::outline(&source).into_iter().map(|mark| {
        // `g.edge` is what its component declares.
        let own = mark.name.rsplit('.').next().unwrap_or(&mark.name);
        Mark {
            range: mark.range,
            key: (name_key(own), mark.means as u8),
            name: mark.name,
            declared: mark.declared,
            is_first_mention: false,
        }
    });
    marks.collect()
}

/// The marks of another document, if it is of the same kind as this one.
fn marks_of_kind(uri: &str, other: &str, text: &str) -> Vec<Mark> {
    match is_robot_rules(uri) == is_robot_rules(other) {
        true => marks(other, text),
        false => Vec::new(),
    }
}

fn relation_faults(source: &Source, path: &Path) -> Vec<Value> {
    let alone = Program::parse_at(source, path);
    let found = match &alone {
        Ok(program) => program.warnings().to_vec(),
        Err(FilesError::Program(faults)) => faults.files.clone(),
        Err(other) => return vec![diagnostic(source.text(), &(0..0), other, &other.to_string())],
    };
    let names_unknown = |fault: &facts::RuleError| {
        matches!(
            fault,
            facts::RuleError::UnknownRelation { .. } | facts::RuleError::UnknownType { .. }
        )
    };
    let mut files = found;
    // What the program declares need not be declared again; a text that declares it itself stands alone.
    if files.iter().flat_map(|file| &file.faults).any(names_unknown) {
        let both = [Source::new("rules/relations.dl", *STANDARD), source.clone()];
        files = match Program::parse_all(&both) {
            Ok(program) => program.warnings().to_vec(),
            Err(faults) => faults.files,
        };
    }
    let own = files.iter().filter(|file| file.source.name() == source.name());
    let faults = own.flat_map(|file| &file.faults);
    faults
        .map(|fault| {
            let span = fault.span();
            let range = span.offset()..span.offset() + span.len();
            diagnostic(source.text(), &range, fault, &fault.to_string())
        })
        .collect()
}

fn robot_faults(source: &Source, path: &Path) -> Vec<Value> {
    let (scenario, faults) = Scenario::parse_whole(source, path);
    let warnings = scenario.warnings.iter().chain(&faults);
    let own =
        warnings.filter(|fault| fault.position().is_none_or(|(name, _, _)| name == source.name()));
    own.map(|fault| {
        let label = fault.labels().and_then(|mut labels| labels.next());
        let range = label.map_or(0..0, |label| label.offset()..label.offset() + label.len());
        diagnostic(source.text(), &range, fault, &fault.error.to_string())
    })
    .collect()
}

fn diagnostic(
    text: &str,
    at: &std::ops::Range<usize>,
    fault: &dyn Diagnostic,
    told: &str,
) -> Value {
    let is_warning = fault.severity() == Some(miette::Severity::Warning);
    let message = match fault.help() {
        Some(help) => format!("{told}\n{help}"),
        None => told.to_owned(),
    };
    json!({
        "range": range(text, at),
        "severity": if is_warning { 2 } else { 1 },
        "code": fault.code().map(|code| code.to_string()),
        "source": "ortho",
        "message": message,
    })
}

/// Bytes of a text as the protocol counts: lines, and UTF-16 units within a line.
fn range(text: &str, bytes: &std::ops::Range<usize>) -> Value {
    let position = |offset: usize| {
        let mut end = offset.min(text.len());
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        let before = &text[..end];
        let line = before.matches('\n').count();
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        json!({ "line": line, "character": before[start..].encode_utf16().count() })
    };
    json!({ "start": position(bytes.start), "end": position(bytes.end) })
}

/// The byte of a position; none beyond the text.
fn offset_of(text: &str, position: &Value) -> Option<usize> {
    let line = usize::try_from(position["line"].as_u64()?).ok()?;
    let mut units = position["character"].as_u64()?;
    let start = match line {
        0 => 0,
        _ => text.match_indices('\n').nth(line - 1)?.0 + 1,
    };
    let mut offset = start;
    for letter in text[start..].chars().take_while(|letter| *letter != '\n') {
        if units == 0 {
            break;
        }
        units = units.saturating_sub(letter.len_utf16() as u64);
        offset += letter.len_utf8();
    }
    Some(offset)
}

/// `file:///home/a%20b/c.dl` to its path; any other URI as it stands.
fn path_of(uri: &str) -> PathBuf {
    let Some(path) = uri.strip_prefix("file://") else { return uri.into() };
    let mut bytes = Vec::with_capacity(path.len());
    let mut rest = path.as_bytes();
    while let Some((byte, behind)) = rest.split_first() {
        let digits = behind.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        let code = digits.filter(|_| *byte == b'%');
        let code = code.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(code.unwrap_or(*byte));
        rest = if code.is_some() { &behind[2..] } else { behind };
    }
    String::from_utf8_lossy(&bytes).into_owned().into()
}

/// The path as a URI; what no URI holds is written by its bytes.
fn uri_of(path: &Path) -> String {
    let mut uri = "file://".to_owned();
    for byte in path.to_string_lossy().bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => {
                uri.push(char::from(byte));
            }
            other => uri.push_str(&format!("%{other:02X}")),
        }
    }
    uri
}

/// The files that a rule text includes, seen from its folder.
fn included(path: &Path, text: &str) -> Vec<PathBuf> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let named = text.lines().filter_map(|line| {
        let line = line.trim();
        let quoted = |rest: &str| rest.split('"').nth(1).map(str::to_owned);
        let relations = line.strip_prefix(".include").or_else(|| line.strip_prefix("#include"));
        let robot = line.strip_prefix("Включить:").or_else(|| line.strip_prefix("Include:"));
        let robot =
            robot.and_then(|rest| rest.split(';').next()).map(|name| name.trim().to_owned());
        relations.and_then(quoted).or(robot)
    });
    named.map(|name| lexically(&folder.join(name))).collect()
}

/// The path without `.` and `..`, so that equal files have equal paths.
fn lexically(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.file_name().is_some() => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

/// A message: its head says how long its JSON is. None at the end of the input.
fn read(input: &mut impl BufRead) -> io::Result<Option<Value>> {
    let mut length = None;
    loop {
        let mut line = String::new();
        if input.by_ref().take(MAX_LINE).read_line(&mut line)? == 0 {
            return Ok(None);
        }
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse::<usize>().ok();
        }
    }
    let length = length.filter(|length| *length <= MAX_MESSAGE).ok_or_else(|| {
        io::Error::new(io::ErrorKind::InvalidData, "a message without a sensible Content-Length")
    })?;
    let mut bytes = vec![0; length];
    input.read_exact(&mut bytes)?;
    // What is no JSON asks for nothing.
    Ok(Some(serde_json::from_slice(&bytes).unwrap_or(Value::Null)))
}

fn write(output: &mut impl Write, message: &Value) -> io::Result<()> {
    let text = message.to_string();
    write!(output, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    output.flush()
}
