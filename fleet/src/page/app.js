// The fleet's page. What robots wrote is text, never markup: all of it goes through textContent.

const $ = (id) => document.getElementById(id);

const HEADS = {
  conflicts: "Разошедшиеся карты", robots: "Роботы", buildings: "Здания", missions: "Задания",
  proposals: "Предложения всех роботов", stuck: "Не выведено", maps: "Этажи", things: "Вещи", revisions: "Ревизии", facts: "Отношения",
};
const COLUMNS = {
  building: null, robot: null, building_name: "Здание", robot_name: "Робот", name: "Имя", robots: "Роботов", centre: "Карта центра",
  reported: "Последнее сообщение", revision: "Ревизия", sequence: "Журнал до", state: "Состояние", text: "Задание", given_by: "Кто дал",
  given: "Когда", ended: "Окончено", thing: "Вещь", map_area: "На карте", seen_area: "Видели", apart_cm: "Разница, см",
  sure_percent: "Уверенность, %", seen: "Когда видели", at: "Когда", author: "Кто", reason: "Почему", records: "Записей",
  relation: "Отношение", subject: "Что", object: "К чему", fault: "Почему", area: "Где", x: "x, см", y: "y, см", angle: "Угол, °", map: null,
};
const NUMBERS = new Set(["robots", "centre", "revision", "sequence", "apart_cm", "sure_percent", "records", "x", "y", "angle"]);
const MOMENTS = new Set(["reported", "given", "ended", "seen", "at", "noted"]);
const STATES = {
  silent: ["ещё не сообщал", ""], apart: ["карты разошлись", "warn"], works: ["работает", "go"], away: ["давно не сообщал", "bad"],
  here: ["на связи", "ok"], ended: ["окончено", ""], begun: ["выполняется", "go"], waiting: ["ждёт", ""],
};
const TOTALS = [["buildings", "здания"], ["robots", "роботы"], ["missions", "неоконченные задания"], ["proposals", "предложения"], ["apart", "разошедшиеся карты"]];

function node(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== undefined && child !== null));
  return made;
}

async function call(path, body) {
  const answer = await fetch(path, body === undefined ? {} : {
    method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body),
  });
  if (answer.ok) return answer.json();
  const told = await answer.json().catch(() => ({}));
  if (answer.status === 401 && path !== "/v1/enter") enterFirst();
  throw new Error(told.what || (answer.status === 503 ? "База данных не отвечает." : `Центр ответил: ${answer.status}.`));
}

function fault(text) {
  $("fault").textContent = text;
  $("fault").hidden = !text;
}

async function run(what) {
  try {
    fault("");
    await what();
  } catch (error) {
    fault(error instanceof TypeError ? "Центр не отвечает." : error.message);
  }
}

function enterFirst() {
  $("enter").hidden = false;
  $("fleet").hidden = $("building").hidden = $("leave").hidden = true;
  $("who").textContent = $("when").textContent = "";
  $("key").focus();
}

// How long ago, and exactly when beside it.
function moment(text) {
  if (!text) return "";
  const then = new Date(text), minutes = Math.round((Date.now() - then) / 60000);
  const ago = minutes < 1 ? "только что" : minutes < 60 ? `${minutes} мин назад`
    : minutes < 1440 ? `${Math.round(minutes / 60)} ч назад` : then.toLocaleDateString("ru");
  return node("time", { datetime: text, title: then.toLocaleString("ru") }, ago);
}

function cell(column, value) {
  if (column === "state") {
    const [word, colour] = STATES[value] || [value, ""];
    return node("span", { class: `pill ${colour}` }, word);
  }
  return MOMENTS.has(column) ? moment(value) : value;
}

const where = (building, robot) => `#/building/${building}/robot/${robot}`;

// A list with a head of its own; `link` tells where the first shown cell of a row leads.
function list(name, data, link, total) {
  const card = node("section", { class: "card", id: `list-${name}` });
  const told = total && Number(total) > data.rows.length ? `первые ${data.rows.length} из ${total}` : String(data.rows.length);
  card.append(node("header", {}, node("h2", {}, HEADS[name]), node("span", { class: "mute" }, told)));
  if (!data.rows.length) {
    card.append(node("p", { class: "mute" }, "Нет."));
    return card;
  }
  const shown = data.columns.map((column, at) => [column, at]).filter(([column]) => COLUMNS[column] !== null);
  const head = node("tr", {}, ...shown.map(([column], n) =>
    node("th", { scope: "col", class: n > 0 && NUMBERS.has(column) ? "num" : undefined }, COLUMNS[column] || column)));
  const body = data.rows.map((row) => {
    const of = Object.fromEntries(data.columns.map((column, at) => [column, row[at]]));
    return node("tr", {}, ...shown.map(([column, at], n) => {
      const inside = cell(column, row[at]);
      const isLink = link && n === 0;
      return node("td", { "data-label": COLUMNS[column] || column, class: n > 0 && NUMBERS.has(column) ? "num" : undefined },
        ...(isLink ? [node("a", { href: link(of) }, inside || "–")] : inside === "" ? [] : [inside]));
    }));
  });
  const table = node("table", {}, node("thead", {}, head), node("tbody", {}, ...body));
  card.append(node("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": HEADS[name] }, table));
  return card;
}

// Conflicts of one robot, thing by thing; who edits may settle them.
function conflict(building, robot, title, rows, edits, done) {
  const card = node("section", { class: "card conflict" }, node("header", {}, node("h2", {}, title)));
  const sides = node("dl", { class: "sides" });
  for (const row of rows) {
    sides.append(node("div", { class: "thing" }, row.thing));
    for (const [who, what] of [["в центре", row.centre], ["у робота", row.robots]])
      sides.append(node("div", {}, node("dt", {}, who), node("dd", {}, what || "как было")));
  }
  card.append(sides);
  if (edits) {
    const settle = (path, word) => node("button", { class: "btn", type: "button", onclick: (event) => {
      event.target.disabled = true;
      run(async () => { await call(path, { building, robot, reason: "расхождение решено" }); await done(); });
    } }, word);
    card.append(node("div", { class: "row" }, settle("/v1/adopt", "Взять карту робота"), settle("/v1/insist", "Оставить карту центра")));
  }
  return card;
}

const records = (data) => data.rows.map((row) => Object.fromEntries(data.columns.map((column, at) => [column, row[at]])));

function conflicts(data, edits, done) {
  const groups = Map.groupBy(records(data), (row) => `${row.building}/${row.robot}`);
  return [...groups.values()].map((rows) => {
    const { building, robot, building_name, robot_name, centre_revision, robot_revision } = rows[0];
    const title = `Разошлись: ${building_name}, ${robot_name} (ревизия центра ${centre_revision}, робота ${robot_revision})`;
    return conflict(Number(building), Number(robot), title, rows, edits, done);
  });
}

function shown(name, edits) {
  $("enter").hidden = true;
  $("leave").hidden = false;
  if (name) $("who").textContent = name + (edits ? "" : ", только просмотр");
  $("when").textContent = new Date().toLocaleTimeString("ru");
}

async function showFleet(isTimer) {
  const told = await call(`/v1/fleet?find=${encodeURIComponent($("find").value)}&again=${isTimer === true}`);
  shown(told.name, told.edits);
  $("when").textContent = new Date(Date.now() - told.age * 1000).toLocaleTimeString("ru");
  $("fleet").hidden = false;
  $("building").hidden = true;
  $("building").replaceChildren();
  const totals = records(told.totals)[0];
  const lists = { apart: "conflicts" };
  $("totals").replaceChildren(...TOTALS.map(([name, word]) =>
    node("a", { href: "#/", class: name === "apart" && totals[name] !== "0" ? "warn" : undefined,
      onclick: (event) => { event.preventDefault(); const to = $(`list-${lists[name] || name}`) || document.querySelector(".conflict"); to?.scrollIntoView(); } },
    node("b", {}, totals[name]), word)));
  const robots = (of) => where(of.building, of.robot);
  $("lists").replaceChildren(
    ...conflicts(told.conflicts, told.edits, showFleet),
    list("robots", reordered(told.robots, ["name", "building_name"]), robots, $("find").value ? undefined : totals.robots),
    list("buildings", told.buildings, (of) => where(of.building, of.centre && of.centre !== "0" ? 0 : -1), $("find").value ? undefined : totals.buildings),
    list("missions", reordered(told.missions, ["text"])),
    list("proposals", reordered(told.proposals, ["thing"]), robots, $("find").value ? undefined : totals.proposals),
    ...(told.stuck.rows.length ? [list("stuck", told.stuck)] : []),
  );
}

// The same table with these columns first.
function reordered(data, first) {
  const order = [...first, ...data.columns.filter((column) => !first.includes(column))];
  const at = order.map((column) => data.columns.indexOf(column));
  return { columns: order, rows: data.rows.map((row) => at.map((n) => row[n])) };
}

function picture(building, robot, maps) {
  const storey = node("select", { "aria-label": "Этаж" }, ...maps.map((map) => node("option", { value: map.map }, map.name || map.map)));
  const believed = node("input", { type: "checkbox", id: "believed" });
  const image = node("img", { alt: "План здания", width: "900", height: "600" });
  const draw = () => {
    image.src = `/v1/plan?building=${building}&robot=${robot}&map=${storey.value}&believed=${believed.checked}&t=${Date.now()}`;
  };
  storey.addEventListener("change", draw);
  believed.addEventListener("change", draw);
  image.addEventListener("load", () => { image.removeAttribute("width"); image.removeAttribute("height"); });
  draw();
  return node("section", { class: "card" },
    node("div", { class: "row" }, node("h2", {}, "План"), node("span", { class: "sp" }),
      ...(maps.length > 1 ? [storey] : []),
      ...(robot > 0 ? [node("label", { class: "check", for: "believed" }, believed, "как робот думает, что есть")] : [])),
    node("figure", {}, image));
}

// Two forms of an edit and a map file; each is tried before it is written.
function editor(building, revision, things, done) {
  const told = node("div", { class: "told", hidden: true, "aria-live": "polite" });
  const say = (text, colour) => { told.textContent = text; told.className = `told ${colour}`; told.hidden = false; };
  const reason = node("input", { id: "reason", placeholder: "переставили на обходе" });
  const send = async (text, isTry) => {
    const done_ = await call("/v1/edit", { building, on: revision, reason: reason.value, try: isTry, text });
    const lines = [...done_.differences, ...done_.warnings.map((w) => `Внимание: ${w}`), ...done_.left_behind.map((n) => `Осталось на месте: ${n}`)];
    if (isTry) return say(lines.length ? lines.join("\n") : "Ничего не изменится.", "ok");
    await done(`Записана ревизия ${done_.revision}.`);
  };
  const guarded = (what) => async () => {
    try { fault(""); await what(); } catch (error) { say(error.message, "bad"); }
  };
  const buttons = (text) => node("div", { class: "row" },
    node("button", { class: "btn", type: "button", onclick: guarded(() => send(text(), true)) }, "Проверить"),
    node("button", { class: "btn pri", type: "button", onclick: guarded(() => send(text(), false)) }, "Записать ревизию"));

  const which = node("select", { id: "thing" }, ...things.map((t) => node("option", { value: t.thing }, `${t.thing} – ${t.area}`)));
  const [x, y, angle] = ["x", "y", "angle"].map((name) => node("input", { type: "number", step: "0.1", id: `to-${name}` }));
  const fill = () => {
    const thing = things.find((t) => t.thing === which.value);
    if (thing) [x.value, y.value, angle.value] = [thing.x, thing.y, thing.angle];
  };
  which.addEventListener("change", fill);
  fill();
  const carry = node("input", { type: "checkbox", id: "carry", checked: true });
  const moved = () => {
    const of = things.find((t) => t.thing === which.value), steps = [{ move: of.thing, to: [Number(x.value), Number(y.value)], carry: carry.checked }];
    if (angle.value !== of.angle) steps.push({ turn: of.thing, to: Number(angle.value), carry: carry.checked });
    return JSON.stringify({ edit: steps });
  };
  const text = node("textarea", { id: "text", spellcheck: "false", placeholder: "[[edit]]\nmove = \"Стол-1\"\nto = [120, 80]" });
  const file = node("input", { type: "file", id: "file", accept: ".toml,.json,.yaml" });
  const replace = guarded(async () => {
    if (!file.files[0]) return say("Выберите файл карты.", "bad");
    const made = await call("/v1/revise", { building, on: revision, reason: reason.value, map: await file.files[0].text() });
    await done(`Записана ревизия ${made}.`);
  });
  return node("section", { class: "card", id: "editor" },
    node("h2", {}, "Новая ревизия карты центра"),
    node("label", { for: "reason" }, "Почему"), reason,
    node("details", { open: true }, node("summary", {}, "Передвинуть вещь"), node("form", { onsubmit: (e) => e.preventDefault() },
      node("label", { for: "thing" }, "Вещь"), which,
      node("div", { class: "three" }, ...[["to-x", "x, см", x], ["to-y", "y, см", y], ["to-angle", "угол, °", angle]]
        .map(([name, word, input]) => node("div", {}, node("label", { for: name }, word), input))),
      node("label", { class: "check", for: "carry" }, carry, "вместе с тем, что на ней стоит"),
      buttons(moved))),
    node("details", {}, node("summary", {}, "Правка словами карты"), node("form", { onsubmit: (e) => e.preventDefault() },
      node("label", { for: "text" }, "Шаги и разделы, как в файле карты"), text, buttons(() => text.value))),
    node("details", {}, node("summary", {}, "Карта из файла"), node("form", { onsubmit: (e) => e.preventDefault() },
      node("p", { class: "mute" }, node("a", { href: `/v1/map.toml?building=${building}&robot=0`, download: `building-${building}.toml` }, "Скачать нынешнюю"), " – поправить – вернуть сюда."),
      node("label", { for: "file" }, "Файл карты"), file,
      node("div", { class: "row" }, node("button", { class: "btn pri", type: "button", onclick: replace }, "Записать ревизию")))),
    told);
}

async function showBuilding(building, asked, note) {
  let robot = asked;
  let told = await call(`/v1/building?building=${building}&robot=${Math.max(robot, 0)}`);
  if (robot < 0) {
    // Without a map of the centre, the first robot that has one.
    robot = Number(records(told.robots).find((r) => r.revision !== "0")?.robot ?? 0);
    if (robot > 0) told = await call(`/v1/building?building=${building}&robot=${robot}`);
  }
  shown();
  const again = (text) => showBuilding(building, robot, text);
  const all = records(told.robots);
  const whose = node("select", { id: "whose", onchange: (event) => { location.hash = where(building, event.target.value); } },
    ...all.map((r) => node("option", { value: r.robot, selected: Number(r.robot) === robot },
      r.robot === "0" ? `карта центра (ревизия ${r.revision})` : `${r.name} (ревизия ${r.revision})`)));
  const maps = records(told.maps);
  const open = Map.groupBy(records(told.conflicts), (row) => row.robot);
  const parts = [node("section", { class: "card" },
    node("div", { class: "row" }, node("h2", {}, told.name), node("span", { class: "sp" }), node("label", { for: "whose" }, "Чья карта"), whose),
    ...(note ? [node("div", { class: "told ok", role: "status" }, note)] : []),
    ...(told.revision === 0 ? [node("p", { class: "mute" }, robot ? "Робот ещё не присылал карты." : "У центра ещё нет карты этого здания. Возьмите карту робота или дайте файл.")] : []),
    ...(told.edits && robot > 0 && told.revision > 0 ? [node("div", { class: "row" }, node("button", { class: "btn", type: "button", onclick: (event) => {
      event.target.disabled = true;
      run(async () => { const made = await call("/v1/adopt", { building, robot, reason: "карта робота" }); location.hash = where(building, 0); await showBuilding(building, 0, `Карта робота взята: ревизия центра ${made}.`); });
    } }, "Сделать картой центра"))] : []))];
  for (const [other, rows] of open) {
    const name = all.find((r) => r.robot === other)?.name ?? other;
    parts.push(conflict(building, Number(other), `Разошлись: центр и ${name}`, rows, told.edits, again));
  }
  const things = records(told.things);
  const plan = maps.length ? picture(building, robot, maps) : undefined;
  const edit = told.edits && robot === 0 ? editor(building, told.revision, things, again) : undefined;
  if (plan && edit) parts.push(node("div", { class: "two" }, plan, edit));
  else parts.push(...[plan, edit].filter(Boolean));
  for (const name of ["revisions", "things", "facts"]) parts.push(list(name, told[name]));
  $("building").replaceChildren(...parts);
  $("fleet").hidden = true;
  $("building").hidden = false;
}

let busy = false;
async function route(isTimer) {
  if (busy) return;
  busy = true;
  await run(async () => {
    const found = location.hash.match(/^#\/building\/(\d+)\/robot\/(-?\d+)$/);
    // What somebody is typing into is not drawn anew under their hands.
    if (found && isTimer) return;
    await (found ? showBuilding(Number(found[1]), Number(found[2])) : showFleet(isTimer));
  });
  busy = false;
  document.body.dataset.ready = "yes";
}

$("enter").addEventListener("submit", (event) => {
  event.preventDefault();
  run(async () => {
    await call("/v1/enter", { key: $("key").value });
    $("key").value = "";
    await route();
  });
});
$("leave").addEventListener("click", () => run(async () => { await call("/v1/leave", {}); enterFirst(); }));
$("ask").addEventListener("submit", (event) => {
  event.preventDefault();
  run(async () => {
    const told = await call("/v1/ask", { question: $("question").value });
    $("answer").replaceChildren(node("div", {}, told.text), ...(told.rule ? [node("code", {}, told.rule)] : []));
    $("answer").hidden = false;
  });
});
let typed;
$("find").addEventListener("input", () => { clearTimeout(typed); typed = setTimeout(() => run(showFleet), 250); });
addEventListener("hashchange", () => { route().then(() => $("main").focus()); });
setInterval(() => { if (!$("fleet").hidden && !document.hidden) route(true); }, 15000);
route();
