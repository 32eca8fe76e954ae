//! What can go wrong between a robot and the centre.

use miette::Diagnostic;
use thiserror::Error;

use crate::store::StoreError;

/// See the module.
pub type Result<T, E = FleetError> = std::result::Result<T, E>;

/// A centre that cannot be reached or refuses, or a robot that it cannot believe.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum FleetError {
    /// The database refused or is gone.
    #[error("база данных: {what}")]
    #[diagnostic(code(fleet::database), help("проверьте адрес базы и что сервер работает"))]
    Database { what: String },

    /// No such key, or it was revoked.
    #[error("ключ не подходит")]
    #[diagnostic(code(fleet::key), help("получите ключ: ortho-fleet key"))]
    Key,

    /// The key is good, but not for this.
    #[error("этому ключу сюда нельзя")]
    #[diagnostic(code(fleet::forbidden), help("нужен ключ другого рода: ortho-fleet key"))]
    Forbidden,

    /// Frames that do not follow what is here.
    #[error("после кадра {have} пришёл кадр {came}")]
    #[diagnostic(code(fleet::gap), help("пришлите кадры, начиная со следующего"))]
    Gap { have: i64, checksum: Option<u32>, came: u64 },

    /// The same number, other bytes.
    #[error("кадр {sequence} здесь другой: хранилище робота пошло другим путём")]
    #[diagnostic(code(fleet::diverged), help("пришлите хранилище целиком"))]
    Diverged { sequence: u64 },

    /// Bytes that are no frames, or say nothing sensible.
    #[error("{what}")]
    #[diagnostic(code(fleet::content))]
    Content { what: String },

    /// The centre could not be reached, or did not answer as a centre does.
    #[error("центр «{url}»: {what}")]
    #[diagnostic(code(fleet::line), help("проверьте связь и адрес"))]
    Line { url: String, what: String },

    /// A plain connection beyond this machine.
    #[error("без TLS сервер слушает только этот компьютер, а не {address}")]
    #[diagnostic(code(fleet::plain), help("дайте --cert и --tls-key или слушайте 127.0.0.1"))]
    Plain { address: String },

    /// A plain connection to a database beyond this machine.
    #[error("к базе данных на {host} без TLS не подключаемся")]
    #[diagnostic(
        code(fleet::plain_database),
        help("уберите sslmode=disable из адреса; чужой сертификат: --db-authority")
    )]
    PlainDatabase { host: String },

    /// A revision that was made on an older one.
    #[error("карта центра тем временем изменилась: сейчас ревизия {revision}")]
    #[diagnostic(code(fleet::moved), help("посмотрите на новую ревизию и повторите"))]
    Moved { revision: i64 },

    /// There is no such thing at the centre.
    #[error("в центре нет: {what}")]
    #[diagnostic(code(fleet::unknown))]
    Unknown { what: String },

    /// Another program has the store open and does not take a map just now.
    #[error("карта центра подождёт: {why}")]
    #[diagnostic(
        code(fleet::held),
        help(
            "повторите позже (push --pull повторяет сам) или закройте программу, которая держит хранилище"
        )
    )]
    Held { why: String },

    /// A file or a socket.
    #[error("{path}: {source}")]
    #[diagnostic(code(fleet::io))]
    Io { path: String, source: std::io::Error },

    /// The robot's store.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Store(#[from] StoreError),
}

impl From<tokio_postgres::Error> for FleetError {
    fn from(error: tokio_postgres::Error) -> Self {
        // The client's own text of a server's refusal is "db error" and no more; and of a line's fault, that there is one.
        let told = || match std::error::Error::source(&error) {
            Some(cause) if !error.to_string().contains(&cause.to_string()) => {
                format!("{error}: {cause}")
            }
            _ => error.to_string(),
        };
        let what = error.as_db_error().map_or_else(told, |told| {
            let place = told.table().map_or_else(String::new, |t| format!(" ({t})"));
            format!("{}{place}", told.message())
        });
        Self::Database { what }
    }
}

impl From<deadpool_postgres::PoolError> for FleetError {
    fn from(error: deadpool_postgres::PoolError) -> Self {
        match error {
            deadpool_postgres::PoolError::Backend(error) => error.into(),
            other => Self::Database { what: other.to_string() },
        }
    }
}

impl FleetError {
    /// What came cannot be used, and why.
    pub fn content(what: impl Into<String>) -> Self {
        Self::Content { what: what.into() }
    }
}
