//! Assistants: the house opened to programs that speak the Model Context Protocol.
//!
//! What only reads is answered at once. What acts has two steps: `plan` gives a plan with an id, its proof and its
//! assumptions, and `run` carries out that plan and no other, when a person has said yes.
//!
//! # Invariants
//!
//! - Nothing is driven and nothing of the map is written without the word of a person: the program asks its user
//!   (elicitation), or whoever started the server has said that it does so itself (`trusts_host`).
//! - A client that leaves stops what it had the robot do, at once.
//! - A plan is refused when the map, or anything that the plan rests on, is no longer what it was; and where the world
//!   turns out to differ on the way, the robot stops instead of taking another plan.
//! - Each call is noted with the client's name (`calls`).

mod acts;
mod approval;
mod arguments;
mod call;
mod calls;
mod client;
mod driven;
mod look;
mod stream;
mod tools;

use std::sync::Arc;
use std::time::SystemTime;

use rmcp::handler::server::ServerHandler;
use rmcp::model::{
    CallToolRequestParams, CallToolResponse, CallToolResult, CancelTaskParams, ContentBlock,
    CreateTaskResult, CustomRequest, CustomResult, ErrorCode, GetTaskParams, GetTaskResult,
    Implementation, ListToolsResult, PaginatedRequestParams, ServerCapabilities, ServerConfig,
    Tool, UpdateTaskParams,
};
use rmcp::service::{RequestContext, RoleServer, ServiceExt as _};
use serde_json::Value;

use crate::engine::Engine;
use crate::engine::calls::Ending;
use crate::units::{Stop, said};

use super::fault::Fault;
use super::{House, ServeError, Settings, raised};

pub(super) use client::Assistant;

type McpError = rmcp::ErrorData;

const ABOUT: &str = "A robot's map of a building: rooms, doors, furniture, how things lie to each other, and the robot itself. \
Questions and orders are plain English or Russian. Lengths are centimetres, angles degrees counter-clockwise from +x. \
Names of things are those of the map, in either language. To have the robot do something, call `plan` and show the plan, then `run` with its id.";

impl ServerHandler for Assistant {
    fn get_info(&self) -> ServerConfig {
        let capabilities = ServerCapabilities::builder().enable_tools().enable_tasks().build();
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
        let (session, at) = (self.session(&context), SystemTime::now().into());
        let Some(row) = tools::named(&request.name) else {
            let known: Vec<&str> = tools::names().collect();
            let text =
                format!("there is no tool {:?}; there are {}", request.name, known.join(", "));
            return Err(McpError::invalid_params(text, None));
        };
        let given = request.arguments.clone().unwrap_or_default();
        let arguments = Value::Object(given.clone());
        let told = if session.role < row.needs {
            Err(Fault::of_role())
        } else {
            let call = call::Call {
                assistant: self,
                session: &session,
                request: &request,
                context: &context,
            };
            tokio::select! {
                told = call.run(row, given) => told,
                // What acts ends by itself, when the robot stands.
                () = context.ct.cancelled(), if row.may_be_left() => Err(call::refuse("assist::cancelled", said!("the-call-was-cancelled"))),
            }
        };
        let outcome = match &told {
            _ if context.ct.is_cancelled() => Ending::Cancelled,
            Ok(call::Told::Waits(_)) => Ending::Asked,
            Ok(call::Told::Begun(_)) => Ending::Begun,
            Ok(_) => Ending::Answered,
            Err(_) => Ending::Refused,
        };
        self.calls.note(at, &session.name, row.name, &arguments, outcome);
        Ok(match told {
            Ok(call::Told::Waits(question)) => (*question).into(),
            Ok(call::Told::Begun(task)) => CreateTaskResult::new(*task).into(),
            Ok(call::Told::Value(value)) => complete(vec![], value).into(),
            Ok(call::Told::Picture(png, value)) => {
                use base64::Engine as _;
                let data = base64::engine::general_purpose::STANDARD.encode(png);
                complete(vec![ContentBlock::image(data, "image/png")], value).into()
            }
            Err(fault) => refused(&fault).into(),
        })
    }

    /// What the protocol's library can make nothing of: of a method that is known here, its parameters are wrong.
    async fn on_custom_request(
        &self,
        request: CustomRequest,
        _: RequestContext<RoleServer>,
    ) -> Result<CustomResult, McpError> {
        let CustomRequest { method, params, .. } = request;
        let fault = match method.as_str() {
            "tools/call" => arguments::of_no_call(&params.unwrap_or_default()),
            "initialize" | "ping" | "tools/list" | "tasks/get" | "tasks/update"
            | "tasks/cancel" => arguments::of_no_request(&method),
            _ => return Err(McpError::new(ErrorCode::METHOD_NOT_FOUND, method, None)),
        };
        let said = fault.body()["message_en"].as_str().unwrap_or_default().to_owned();
        Err(McpError::invalid_params(said, Some(fault.body().clone())))
    }

    async fn get_task(
        &self,
        asked: GetTaskParams,
        _: RequestContext<RoleServer>,
    ) -> Result<GetTaskResult, McpError> {
        self.tasks.get_task(&asked.task_id).map(GetTaskResult::new)
    }

    async fn update_task(
        &self,
        said: UpdateTaskParams,
        _: RequestContext<RoleServer>,
    ) -> Result<(), McpError> {
        // Nothing is asked of a person any more when a task is there.
        self.tasks.update_task(&said.task_id, said.input_responses)
    }

    /// Needs nobody's word, as a stop does.
    async fn cancel_task(
        &self,
        said: CancelTaskParams,
        context: RequestContext<RoleServer>,
    ) -> Result<(), McpError> {
        let by = self.session(&context).name;
        let (at, task) = (SystemTime::now().into(), Value::from(said.task_id.clone()));
        self.calls.note(at, &by, "tasks/cancel", &task, Ending::Answered);
        self.tasks.cancel_task(&said.task_id)
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
    let said = match (part("message_en"), part("help_en")) {
        (message, "") => message.to_owned(),
        (message, help) if message.ends_with(['.', '?', '!']) => format!("{message} {help}"),
        (message, help) => format!("{message}. {help}"),
    };
    let mut result = CallToolResult::error(vec![ContentBlock::text(said)]);
    result.structured_content = Some(body.clone());
    result
}

/// Serves one client over the standard streams until it leaves.
///
/// # Errors
/// What follows from the map cannot be derived, or the streams break.
pub fn run(engine: Engine, settings: &Settings, stop: &Stop) -> Result<(), ServeError> {
    let failed = |source| ServeError::Listen { at: settings.listen, source };
    let house = House::open(engine, settings, settings.listen)?;
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let runtime = runtime.map_err(failed)?;
    let tasks = Arc::clone(&house.tasks);
    let assistant = Assistant::new(house, settings.store.as_deref(), settings.trusts_host);
    let served = runtime.block_on(async {
        let (input, output) = rmcp::transport::io::stdio();
        let streams = (stream::Watched::new(input, Arc::clone(&tasks)), output);
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
