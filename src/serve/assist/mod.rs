//! Assistants: the house opened to programs that speak the Model Context Protocol.
//!
//! What only reads is answered at once. What acts has two steps: `plan` gives a plan with an id, its proof and its
//! assumptions, and `run` carries out that plan and no other, when a person has said yes.
//!
//! # Invariants
//!
//! - Nothing is driven and nothing of the map is written without the word of a person: the program asks its user
//!   (elicitation), or whoever started the server has said that it does so itself (`trusts_host`).
//! - A plan is refused when the map, or anything that the plan rests on, is no longer what it was; and where the world
//!   turns out to differ on the way, the robot stops instead of taking another plan.
//! - Each call is noted with the client's name (`calls`).

mod approval;
mod calls;
mod tools;

use std::hash::{Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rmcp::handler::server::ServerHandler;
use rmcp::model::{
    CallToolRequestParams, CallToolResponse, CallToolResult, ContentBlock, Implementation,
    ListToolsResult, PaginatedRequestParams, ServerCapabilities, ServerConfig, Tool,
};
use rmcp::service::{RequestContext, RoleServer, ServiceExt as _};
use serde_json::Value;

use crate::engine::Engine;
use crate::units::Stop;

use super::fault::Fault;
use super::gate::{Role, Session};
use super::{House, ServeError, Settings, raised};

use approval::Asked;
use calls::Calls;

type McpError = rmcp::ErrorData;

/// Sessions of assistants are told from those of browsers, which count from 1.
const FIRST_SESSION: u64 = 1 << 40;

/// One client over the standard streams, or all clients of a server over HTTP.
#[derive(Debug, Clone)]
pub(super) struct Assistant {
    house: Arc<House>,
    calls: Arc<Calls>,
    asked: Arc<Asked>,
    /// The client's program asks its user before it calls what acts.
    trusts_host: bool,
    /// Where edits wait that nobody could be asked about.
    proposed: Option<PathBuf>,
}

impl Assistant {
    pub(super) fn new(house: Arc<House>, store: Option<&Path>, trusts_host: bool) -> Self {
        let beside = |ending: &str| {
            store.map(|store| {
                let mut name = store.as_os_str().to_owned();
                name.push(ending);
                PathBuf::from(name)
            })
        };
        Self {
            house,
            calls: Arc::new(Calls::new(beside(".calls.jsonl"))),
            asked: Arc::default(),
            trusts_host,
            proposed: beside(".proposed"),
        }
    }

    /// Who calls: over HTTP whoever the gate let in, else whoever started the program; named by the client's program.
    fn session(&self, context: &RequestContext<RoleServer>) -> Session {
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

const ABOUT: &str = "A robot's map of a building: rooms, doors, furniture, how things lie to each other, and the robot itself. \
Questions and orders are plain English or Russian. Lengths are centimetres, angles degrees counter-clockwise from +x. \
Names of things are those of the map, in either language. To have the robot do something, call `plan` and show the plan, then `run` with its id.";

impl ServerHandler for Assistant {
    fn get_info(&self) -> ServerConfig {
        let capabilities = ServerCapabilities::builder().enable_tools().build();
        ServerConfig::new(capabilities)
            .with_server_info(Implementation::new("orthoframe", env!("CARGO_PKG_VERSION")))
            .with_instructions(ABOUT)
    }

    async fn list_tools(
        &self,
        _: Option<PaginatedRequestParams>,
        _: RequestContext<RoleServer>,
    ) -> Result<ListToolsResult, McpError> {
        Ok(ListToolsResult::with_all_items(tools::all()))
    }

    fn get_tool(&self, name: &str) -> Option<Tool> {
        tools::all().into_iter().find(|tool| tool.name == name)
    }

    async fn call_tool(
        &self,
        request: CallToolRequestParams,
        context: RequestContext<RoleServer>,
    ) -> Result<CallToolResponse, McpError> {
        let session = self.session(&context);
        let Some(row) = tools::named(&request.name) else {
            let known: Vec<&str> = tools::names().collect();
            let text =
                format!("there is no tool {:?}; there are {}", request.name, known.join(", "));
            return Err(McpError::invalid_params(text, None));
        };
        let arguments = Value::Object(request.arguments.clone().unwrap_or_default());
        let told = if session.role < row.needs {
            Err(super::routes::role_is_not_enough())
        } else {
            let call = tools::Call {
                assistant: self,
                session: &session,
                request: &request,
                context: &context,
            };
            call.run(row.name, arguments.clone()).await
        };
        let outcome = match &told {
            Ok(tools::Told::Waits(_)) => "asked",
            Ok(_) => "answered",
            Err(_) => "refused",
        };
        self.calls.note(&session.name, row.name, &arguments, outcome);
        Ok(match told {
            Ok(tools::Told::Waits(question)) => (*question).into(),
            Ok(tools::Told::Value(value)) => complete(vec![], value).into(),
            Ok(tools::Told::Picture(png, value)) => {
                use base64::Engine as _;
                let data = base64::engine::general_purpose::STANDARD.encode(png);
                complete(vec![ContentBlock::image(data, "image/png")], value).into()
            }
            Err(fault) => refused(&fault).into(),
        })
    }
}

/// An answer: what there is to read first, the value after it.
fn complete(mut content: Vec<ContentBlock>, value: Value) -> CallToolResult {
    let said = value["text"].as_str().map_or_else(|| value.to_string(), str::to_owned);
    content.insert(0, ContentBlock::text(said));
    let mut result = CallToolResult::success(content);
    result.structured_content = Some(value);
    result
}

fn refused(fault: &Fault) -> CallToolResult {
    let body = fault.body();
    let part = |name: &str| body[name].as_str().unwrap_or_default();
    let said = [part("message_en"), part("help_en")].join(" ");
    let mut result = CallToolResult::error(vec![ContentBlock::text(said.trim())]);
    result.structured_content = Some(body.clone());
    result
}

/// Serves one client over the standard streams until it leaves.
///
/// # Errors
/// What follows from the map cannot be derived, or the streams break.
pub fn run(engine: Engine, settings: Settings, stop: &Stop) -> Result<(), ServeError> {
    let failed = |source| ServeError::Listen { at: settings.listen, source };
    let (trusts_host, store) = (settings.trusts_host, settings.store.clone());
    let house = House::open(engine, &settings, settings.listen)?;
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let runtime = runtime.map_err(failed)?;
    let tasks = Arc::clone(&house.tasks);
    let assistant = Assistant::new(house, store.as_deref(), trusts_host);
    let served = runtime.block_on(async {
        let streams = rmcp::transport::io::stdio();
        tokio::select! {
            () = raised(stop) => Ok(()),
            served = async {
                let service = assistant.serve(streams).await;
                let service = service.map_err(std::io::Error::other)?;
                service.waiting().await.map_err(std::io::Error::other).map(|_| ())
            } => served,
        }
    });
    tasks.close();
    // A read of the standard input cannot be broken off.
    runtime.shutdown_background();
    served.map_err(failed)
}
