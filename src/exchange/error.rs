//! Why a foreign file gives no [`Survey`](super::Survey).

use miette::{Diagnostic, SourceSpan};
use thiserror::Error;

use crate::units::{Bilingual, Source};

/// A foreign file that cannot be read. What can be mended or left out is no error but a [`Remark`](super::Remark).
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum ReadError {
    /// The file system refused.
    #[error("«{path}» не читается: {reason}")]
    #[diagnostic(code(exchange::unreadable), help("проверьте путь и права доступа"))]
    Unreadable { path: String, reason: Bilingual },

    /// More bytes than any building takes.
    #[error("файл занимает {bytes} байт, предел – {limit}")]
    #[diagnostic(code(exchange::too_large), help("разделите здание на несколько файлов"))]
    TooLarge { bytes: u64, limit: u64 },

    /// Bytes that are no text.
    #[error("«{name}» – не текст: байт {at} равен {byte:#04x}")]
    #[diagnostic(
        code(exchange::not_text),
        help("нужен текстовый файл в UTF-8, UTF-16 с меткой порядка байтов или Windows-1251")
    )]
    NotText { name: String, at: usize, byte: u8 },

    /// Files packed into one.
    #[error("«{name}» – архив ZIP")]
    #[diagnostic(
        code(exchange::archive),
        help("распакуйте его и назовите папку: так читаются и архивы IMDF")
    )]
    Archive { name: String },

    /// A picture of a floor plan, of which nobody said how large it is.
    #[error("«{name}» – картинка, а масштаба она не говорит")]
    #[diagnostic(
        code(exchange::picture),
        help(
            "скажите, сколько сантиметров в пикселе PNG или PGM: --pixel 2; или назовите файл YAML с полями image, resolution и origin, как у ROS map_server"
        )
    )]
    Picture { name: String },

    /// The text breaks the rules of its own format.
    #[error("{format}: {what}")]
    #[diagnostic(code(exchange::syntax), help("исправьте файл в указанном месте"))]
    Syntax {
        format: &'static str,
        what: Bilingual,
        #[source_code]
        text: Source,
        #[label("здесь")]
        at: SourceSpan,
    },

    /// Bytes that break the rules of their format: a picture.
    #[error("{format}, байт {at}: {what}")]
    #[diagnostic(
        code(exchange::bytes),
        help("сохраните файл заново той программой, что его создала")
    )]
    Bytes { format: &'static str, what: Bilingual, at: usize },

    /// More parts than any building has.
    #[error("{format}: {what} больше {limit}")]
    #[diagnostic(code(exchange::too_many), help("разделите здание на несколько файлов"))]
    TooMany { format: &'static str, what: Bilingual, limit: usize },

    /// Things whose sizes stand in a second file, which is not there or is of other things.
    #[error("{format}: размеров нет ни у одной вещи из {count}: {what}")]
    #[diagnostic(
        code(exchange::no_sizes),
        help("положите asset-database.json рядом с файлом дома или назовите её: --assets ФАЙЛ")
    )]
    NoSizes { format: &'static str, what: Bilingual, count: usize },

    /// It reads well, but there is no building in it.
    #[error("{format}: {what}")]
    #[diagnostic(
        code(exchange::no_building),
        help("нужен файл, в котором есть хотя бы одно помещение")
    )]
    NoBuilding { format: &'static str, what: Bilingual },
}

impl ReadError {
    /// [`ReadError::Syntax`] at a byte of a text.
    #[must_use]
    pub fn syntax(
        format: &'static str,
        what: impl Into<Bilingual>,
        text: &Source,
        at: usize,
    ) -> Self {
        let mut at = at.min(text.text().len());
        while !text.text().is_char_boundary(at) {
            at -= 1;
        }
        let len = text.text()[at..].chars().next().map_or(0, char::len_utf8);
        Self::Syntax { format, what: what.into(), text: text.clone(), at: (at, len).into() }
    }

    /// [`ReadError::Unreadable`] of what the file system said.
    pub fn unreadable(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Self + use<> {
        let path = path.display().to_string();
        move |e| Self::Unreadable { path, reason: e.to_string().into() }
    }
}
