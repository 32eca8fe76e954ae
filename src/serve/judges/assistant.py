"""An assistant's work through the protocol's own Python client: over the standard streams and over HTTP, in both of the
protocol's ways (with a handshake, and without sessions). Usage: assistant.py ORTHO. Leaves with 77 where the client is
missing."""

import asyncio
import base64
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Literal

try:
    import httpx2
    from mcp import Client, MCPError, StdioServerParameters
    from mcp.client.extension import ClientExtension, ResultClaim
    from mcp.client.streamable_http import streamable_http_client
    from mcp.types import CallToolResult, ElicitResult, Implementation, Request, RequestParams, Result
except ImportError:
    sys.exit(77)

ORTHO = sys.argv[1]
TOKEN = "a token of sixteen characters or more".replace(" ", "-")
ME = Implementation(name="judge", version="1")


def check(what, message):
    if not what:
        raise AssertionError(message)


def asker(answers, asked):
    async def ask(_context, params):
        asked.append(params.message)
        return ElicitResult(action="accept", content={"approve": answers.pop(0)})

    return ask


class Begun(Result):
    result_type: Literal["task"] = "task"
    task_id: str
    status: str
    poll_interval_ms: int


class State(Result):
    task_id: str
    status: str
    status_message: str | None = None
    result: dict[str, Any] | None = None


class Of(RequestParams):
    task_id: str


class OfTask(Request[Of, str]):
    # By which a server over HTTP is told the task in a header.
    name_param = "taskId"


class Tasks(ClientExtension):
    """The protocol's tasks, as the Python client lets an extension of its own speak of them."""

    identifier = "io.modelcontextprotocol/tasks"

    def __init__(self, give_up_at=None):
        self.give_up_at, self.heard, self.begun, self.last = give_up_at, [], None, None

    def claims(self):
        return [ResultClaim(result_type="task", model=Begun, resolve=self.resolve)]

    async def ask(self, session, method, result=State, task=None):
        request = OfTask(method=method, params=Of(task_id=task or self.begun.task_id))
        return await session.send_request(request, result)

    async def resolve(self, begun, context):
        check(begun.status == "working", begun)
        self.begun = begun
        while True:
            self.last = await self.ask(context.session, "tasks/get")
            said = self.last.status_message
            if said and (not self.heard or self.heard[-1] != said):
                self.heard.append(said)
            if len(self.heard) == self.give_up_at:
                await self.ask(context.session, "tasks/cancel", Result)
                self.give_up_at = None
            if self.last.status != "working":
                break
            await asyncio.sleep(0.05)
        return CallToolResult.model_validate(self.last.result or {"content": [], "isError": True})


async def as_a_task(connect):
    """Where the client speaks of tasks, a plan that is carried out is one: asked how far it is, given up."""
    asked = []
    tasks = Tasks()
    async with connect("auto", asker([True], asked), extensions=[tasks]) as client:
        plan = (await client.call_tool("plan", {"text": "Go to Point K"})).structured_content
        told = await client.call_tool("run", {"id": plan["task"]["task"]})
        check(tasks.last.status == "completed" and not told.is_error, tasks.last)
        check(told.structured_content["state"] == "done" and len(asked) == 1, told)
        steps = [int(said.split("/")[0]) for said in tasks.heard]
        of = {said.split(":")[0].split("/")[1] for said in tasks.heard}
        check(steps and steps == sorted(steps) and len(of) == 1, tasks.heard)
        again = await tasks.ask(client.session, "tasks/get")
        check(again.result["structuredContent"]["state"] == "done", "what ended is still known")
        for method in ("tasks/get", "tasks/cancel"):
            try:
                await tasks.ask(client.session, method, Result, "no such task")
                check(False, f"{method} of no task is refused")
            except MCPError as error:
                check(error.error.code == -32602, error)
        # What is refused before anything is begun is no task.
        told = await client.call_tool("run", {"id": plan["task"]["task"]})
        check(told.is_error and told.structured_content["code"] == "serve::no_such_task", told)

    tasks = Tasks(give_up_at=1)
    async with connect("auto", asker([True], asked), extensions=[tasks]) as client:
        plan = (await client.call_tool("plan", {"text": "Bring Cup 1"})).structured_content
        told = await client.call_tool("run", {"id": plan["task"]["task"]})
        check(tasks.last.status == "cancelled" and told.is_error, tasks.last)
        now = (await client.call_tool("tasks", {})).structured_content
        check(now["task"] is None and now["ended"][-1]["state"] == "cancelled", now)

    # Who does not speak of tasks has none, and waits for the end of the call.
    async with connect("auto", asker([True], asked)) as client:
        try:
            await Tasks().ask(client.session, "tasks/get", Result, tasks.begun.task_id)
            check(False, "tasks are not spoken of")
        except MCPError as error:
            check(error.error.code < 0, error)


async def work(connect, mode, log=None):
    asked, answers = [], []
    async with connect(mode, asker(answers, asked)) as client:
        tools = {tool.name: tool for tool in (await client.list_tools()).tools}
        reads = {name for name, tool in tools.items() if tool.annotations.read_only_hint}
        check({"ask", "why", "map", "as_of"} <= reads and not {"run", "plan", "propose_edit"} & reads, reads)

        async def call(tool, progress=None, **arguments):
            result = await client.call_tool(tool, arguments, progress_callback=progress)
            return result, result.structured_content

        told, value = await call("ask", text="What is on Table 1?")
        check(not told.is_error and "Book 4" in told.content[0].text, told)
        _, value = await call("ask", text="And where is Chair 1?")
        check("Chair 1" in value["text"], value)
        told, value = await call("ask", text="Bring the medicine")
        check(told.is_error and value["code"] == "assist::order", value)
        _, value = await call("query", query='?- ON_TOP_OF(X, "Стол-1").')
        check(len(value["rows"]) == 2, value)
        _, value = await call("why", relation="ON_TOP_OF", of=["Чашка-1", "Стол-1"])
        check(value["holds"] and value["steps"], value)
        # By whichever name, in either language; of what is not there nothing is said to be false.
        for of in (["Cup 1", "Table 1"], ["Чашка-1", "Table 1"], ["cup 1", "стол-1"]):
            _, value = await call("why", relation="ON_TOP_OF", of=of)
            check(value["holds"] and value["steps"], (of, value))
        for tool in ("why", "why_not"):
            told, value = await call(tool, relation="ON_TOP_OF", of=["unicorn", "Table 1"])
            check(told.is_error and "holds" not in value, value)
        _, value = await call("why_not", relation="ON_TOP_OF", of=["Chair 1", "Table 1"])
        check(value["holds"] is False and "?" in value["text"], value)
        _, value = await call("why_not", relation="ON_TOP_OF", of=["Стул-1", "Стол-1"])
        check(value["holds"] is False and "?" in value["text"], value)
        _, value = await call("route", **{"from": "Точка-А", "to": "Точка-К"})
        check(value["length_cm"] > 100 if "length_cm" in value else True, value)
        _, value = await call("relations", of="Стол-1")
        check(any(r["relation"] == "ON_TOP_OF" for r in value["facts"]), value)
        picture, value = await call("map")
        image = next(block for block in picture.content if block.type == "image")
        check(base64.b64decode(image.data)[:4] == b"\x89PNG" and value["rooms"], "a picture of the map")
        _, value = await call("map", name="Комната-В", picture=False)
        check(value["kind"] == "room", value)

        # Nonsense is refused, and nothing hangs or ends.
        for name, arguments in [
            ("ask", {}), ("ask", {"text": 7}), ("ask", {"text": "x" * 100000}), ("run", {"id": -1}), ("run", {"id": 999}),
            ("observe", {"thing": "Стул-1", "x": 1e300, "y": 0}), ("observe", {"thing": "нет такого", "x": 1, "y": 1}),
            ("query", {"query": "?- )("}), ("why", {"relation": "нет", "of": []}), ("map", {"name": "нет"}),
            ("as_of", {"revision": 999, "text": "?"}), ("propose_edit", {"edit": {"edit": 3}}), ("route", {"from": "", "to": ""}),
        ]:
            result = await client.call_tool(name, arguments)
            check(result.is_error, (name, arguments, result))
        _, value = await call("ask", text="x" * 10000)
        check(value["replies"][0]["outcome"] != "answered", "a line of nonsense is not understood")

        # A person is shown what they agree to: the steps, their proof, what they rest on, what is opened and carried.
        told, plan = await call("plan", text="Bring the medicine")
        check("fewer steps are proven impossible" in told.content[0].text, told.content[0].text)
        plan = plan["task"]
        check(plan["plan"]["is_shortest"] and [c["ru"] for c in plan["plan"]["carries"]] == ["Лекарство"], plan["plan"])
        answers.append(False)
        await call("run", id=plan["task"])
        for said in ("6. take the medicine", "proven impossible", "Assuming: Door ZY is open", "pushes: the medicine"):
            check(said in asked[-1], asked[-1])
        told, _ = await call("plan", text="Принеси лекарство")
        for said in ("6. взять Лекарство", "это доказано", "Если так и есть: Дверь-ZY открыта", "отодвинет: Лекарство"):
            check(said in told.content[0].text, told.content[0].text)

        # A plan, declined, then carried out with progress.
        told, plan = await call("plan", text="Go to Point K")
        check(plan["task"]["plan"]["outcome"] in ("done", "plan") or plan["task"]["plan"], plan)
        number = plan["task"]["task"]
        answers.append(False)
        told, value = await call("run", id=number)
        check(told.is_error and value["code"] == "assist::declined" and len(asked) == 2, value)
        heard = []

        async def hear(progress, _total, message):
            heard.append((progress, message))

        answers.append(True)
        told, value = await call("run", hear, id=number)
        check(not told.is_error and value["state"] == "done", value)
        check(heard and [p for p, _ in heard] == sorted({p for p, _ in heard}), heard)
        told, value = await call("run", id=number)
        check(told.is_error, "a plan is good once")

        # What was seen since changes the plan, though not the map: it is not begun.
        _, plan = await call("plan", text="Bring Cup 1")
        _, value = await call("observe", thing="Чашка-1", x=120, y=700, z=0, sure=0.95)
        check(value["outcome"] == "noted", value)
        answers.append(True)
        told, value = await call("run", id=plan["task"]["task"])
        check(told.is_error and value["code"] == "serve::expired", value)
        _, value = await call("proposals")
        check(any(p["name"] == "Чашка-1" for p in value["proposals"]), value)

        # An edit is tried, asked about, written with an author; undone by nobody but a person.
        edit = {"edit": [{"move": "Стул-1", "by": [10, 0]}]}
        answers.append(False)
        told, value = await call("propose_edit", edit=edit, reason="no")
        check(told.is_error and value["code"] == "assist::declined", value)
        check("moved by 10 cm" in asked[-1], asked[-1])
        # The question is in the language of the reason; what would stay where it is is in it.
        answers.append(False)
        table = {"edit": [{"move": "Стол-1", "by": [0, 1]}]}
        await call("propose_edit", edit=table, reason="стол ближе к стене")
        check("Стол-1" in asked[-1] and "Остаётся на месте: " in asked[-1], asked[-1])
        told, value = await call("propose_edit", edit={"edit": [{"move": "Стул-1", "by": [0, 0]}]}, reason="")
        check(told.is_error and value["code"] == "assist::nothing", value)
        _, before = await call("history")
        answers.append(True)
        told, value = await call("propose_edit", edit=edit, reason="a judge moves a chair")
        check(not told.is_error and value["outcome"] == "edited", value)
        _, after = await call("history")
        check(len(after["revisions"]) == len(before["revisions"]) + 1, after)
        check("judge" in after["revisions"][-1]["user"], after["revisions"][-1])
        _, value = await call("as_of", revision=1, text="Where is Chair 1?")
        check("Chair 1" in value["text"], value)

        # A call that is given up stops the robot.
        _, plan = await call("plan", text="Go to Point A")
        if plan.get("task"):
            answers.append(True)
            running = asyncio.ensure_future(client.call_tool("run", {"id": plan["task"]["task"]}))
            await asyncio.sleep(1.0)
            running.cancel()
            for _ in range(50):
                _, value = await call("tasks")
                if value["task"] is None:
                    break
                await asyncio.sleep(0.1)
            check(value["task"] is None and value["ended"][-1]["state"] in ("stopped", "cancelled"), value["ended"][-1])
    if log:
        lines = [json.loads(line) for line in Path(log).read_text().splitlines()]
        check({line["tool"] for line in lines} >= {"ask", "run", "propose_edit"}, "calls are noted")
        check(all("judge" in line["client"] for line in lines), lines[0])


def leaves(store):
    """A client that goes away in the middle of a drive stops it, at once and not when its open call is given up."""
    command = [ORTHO, "mcp", "--demo", "--store", store, "--pace", "1", "--trust-client"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
        def send(method, **more):
            server.stdin.write(json.dumps({"jsonrpc": "2.0", "method": method, **more}) + "\n")
            server.stdin.flush()

        def answer(number):
            for line in server.stdout:
                told = json.loads(line)
                if told.get("id") == number:
                    return told["result"]

        send("initialize", id=1, params={"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "judge", "version": "1"}})
        answer(1)
        send("notifications/initialized")
        send("tools/call", id=2, params={"name": "plan", "arguments": {"text": "Go to Room Z"}})
        task = answer(2)["structuredContent"]["task"]["task"]
        send("tools/call", id=3, params={"name": "run", "arguments": {"id": task}, "_meta": {"progressToken": 7}})
        while json.loads(server.stdout.readline()).get("method") != "notifications/progress":
            pass
        server.stdin.close()
        server.stdout.read()
    # A call that is given up after a while is never noted; one that ends because the robot stands is.
    noted = [json.loads(line) for line in Path(f"{store}.calls.jsonl").read_text().splitlines()]
    check("run" in [call["tool"] for call in noted], noted)


def over_streams(store):
    def connect(mode, ask, more=("--pace", "5"), extensions=()):
        arguments = ["mcp", "--demo", "--store", store, *more]
        server = StdioServerParameters(command=ORTHO, args=arguments)
        return Client(
            server, mode=mode, elicitation_callback=ask, client_info=ME, read_timeout_seconds=120, extensions=extensions
        )

    return connect


class OverHttp:
    """A console of its own, and a client that bears its token."""

    def __init__(self, mode, ask, extensions=()):
        self.mode, self.ask, self.extensions = mode, ask, extensions

    async def __aenter__(self):
        command = [ORTHO, "serve", "--demo", "--port", "0", "--pace", "5", "--token", TOKEN]
        self.console = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        url = self.console.stdout.readline().split()[-1].split("?")[0] + "mcp"
        self.http = httpx2.AsyncClient(headers={"Authorization": f"Bearer {TOKEN}"}, timeout=120)
        self.client = Client(
            streamable_http_client(url, http_client=self.http),
            mode=self.mode, elicitation_callback=self.ask, client_info=ME, read_timeout_seconds=120,
            extensions=self.extensions,
        )
        try:
            return await self.client.__aenter__()
        except BaseException:
            self.console.kill()
            raise

    async def __aexit__(self, *what):
        try:
            await self.client.__aexit__(*what)
            await self.http.aclose()
        finally:
            self.console.kill()
            self.console.wait()


async def nobody_to_ask(store):
    """A client that cannot ask drives nothing, and its edit is laid beside the store."""
    server = StdioServerParameters(command=ORTHO, args=["mcp", "--demo", "--store", store, "--pace", "20"])
    async with Client(server, client_info=ME, read_timeout_seconds=120) as client:
        plan = (await client.call_tool("plan", {"text": "Go to Point K"})).structured_content
        refused = await client.call_tool("run", {"id": plan["task"]["task"]})
        check(refused.is_error and refused.structured_content["code"] == "assist::nobody_to_ask", refused)
        edit = {"edit": [{"move": "Стул-1", "by": [10, 0]}]}
        laid = (await client.call_tool("propose_edit", {"edit": edit})).structured_content
        check(laid["outcome"] == "proposed" and Path(laid["file"]).exists(), laid)


async def main():
    for mode in ("auto", "legacy"):
        with tempfile.TemporaryDirectory() as folder:
            store = f"{folder}/store"
            await work(over_streams(store), mode, f"{store}.calls.jsonl")
        await work(OverHttp, mode)
        print(mode, "works")
    with tempfile.TemporaryDirectory() as folder:
        await as_a_task(over_streams(f"{folder}/store"))
        await as_a_task(OverHttp)
    with tempfile.TemporaryDirectory() as folder:
        await nobody_to_ask(f"{folder}/store")
    # It goes while it is told of the progress, or in between.
    for _ in range(8):
        with tempfile.TemporaryDirectory() as folder:
            leaves(f"{folder}/store")
    print("all works")


asyncio.run(main())
