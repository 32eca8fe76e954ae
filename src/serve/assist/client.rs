//! Who calls, and what all their calls share.

use std::hash::{Hash as _, Hasher as _};
use std::path::Path;
use std::sync::Arc;

use rmcp::service::{RequestContext, RoleServer};
use rmcp::task_manager::TaskManager;

use super::super::House;
use super::super::gate::{Role, Session};
use super::approval::Asked;
use super::calls::Calls;
use crate::engine::calls;

/// Sessions of assistants are told from those of browsers, which count from 1.
const FIRST_SESSION: u64 = 1 << 40;

/// One client over the standard streams, or all clients of a server over HTTP.
#[derive(Clone)]
pub(in super::super) struct Assistant {
    pub(super) house: Arc<House>,
    pub(super) calls: Arc<Calls>,
    pub(super) asked: Arc<Asked>,
    /// Plans that are carried out for clients that speak of tasks.
    pub(super) tasks: TaskManager,
    /// The client's program asks its user before it calls what acts.
    pub(super) trusts_host: bool,
}

impl Assistant {
    pub(in super::super) fn new(
        house: Arc<House>,
        store: Option<&Path>,
        trusts_host: bool,
    ) -> Self {
        Self {
            house,
            calls: Arc::new(Calls::new(store.map(calls::file))),
            asked: Arc::default(),
            tasks: TaskManager::new(),
            trusts_host,
        }
    }

    /// Who calls: over HTTP whoever the gate let in, else whoever started the program; named by the client's program.
    pub(super) fn session(&self, context: &RequestContext<RoleServer>) -> Session {
        let client = context.client_info().map(|info| info.name);
        let client = client.filter(|name| !name.is_empty()).unwrap_or_else(|| "assistant".into());
        let client: String = client.chars().take(60).collect();
        let parts = context.extensions.get::<axum::http::request::Parts>();
        match parts.and_then(|parts| parts.extensions.get::<Session>()) {
            Some(known) => {
                let name = format!("{} ({client})", known.name);
                // Requests over HTTP need not belong together: those of one token and one program do.
                let mut hasher = std::hash::DefaultHasher::new();
                name.hash(&mut hasher);
                let number = FIRST_SESSION + (hasher.finish() >> 24);
                Session::of(number, known.role, &name)
            }
            None => Session::of(FIRST_SESSION, Role::Edit, &client),
        }
    }
}
