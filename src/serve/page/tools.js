// What is drawn anew: rooms, doors in walls, zones, things and places put down, corners put elsewhere. A drawing becomes the steps of one edit, and is tried
// while it is made.
import { S, L, N, ask, el, announce, num } from './base.js';
import { boxOf, centre, holds, named, paint, under, view } from './map.js';
import { will, write } from './edit.js';

const tenth = (value) => Math.round(value * 10) / 10 + 0;
const radians = (degrees) => (degrees * Math.PI) / 180;
let render = () => {};
export const begin = (redraw) => { render = redraw; };

/** A name that nothing on this storey bears yet. */
function fresh(ru, en) {
  let n = 1;
  const name = () => L(`${ru}-${n}`, `${en} ${n}`), d = S.drawing;
  // Either name of a thing may be the one that is taken.
  const taken = new Set([...d.rooms, ...d.things, ...d.doors, ...d.places, ...d.zones ?? []].flatMap((one) => [one.name, one.name_en]));
  while (taken.has(name())) n += 1;
  return name();
}
const key = (name) => name.trim().replaceAll('.', '-');

const FIELDS = {
  thing: () => ({ name: '', kind: '', x: '', y: '', z: 0, angle: 0 }),
  point: () => ({ name: fresh('Место', 'Place'), x: '', y: '', heading: 0, serves: '' }),
  room: () => ({ name: fresh('Помещение', 'Room'), height: 270 }),
  zone: () => ({ name: fresh('Зона', 'Zone'), kind: 'keep-out', speed: 20, heading: 90, reason: '', from: '', until: '' }),
  door: () => ({ name: fresh('Дверь-новая', 'New door'), kind: 'hinged', width: 90, height: 210, hinge: 'left', opens: 'inside', one: '', other: '', along: 0 }),
};

/** Takes up a tool; the one that is in hand is laid down. */
export function take(tool) {
  if (!S.edit) return;
  const on = S.state.revision;
  if (S.edit.tool === tool) { S.edit = { on }; render(); paint(); return; }
  S.edit = { on, tool, draft: null, fields: FIELDS[tool]?.() ?? {} };
  if (tool === 'thing' && !S.kinds) ask('/api/kinds', {}).then((kinds) => { S.kinds = kinds; render(true); }).catch(() => {});
  S.tab = 'map';
  announce(HINTS[tool]?.() ?? '');
  render(); paint();
}
const HINTS = {
  thing: () => L('Выберите, что поставить, и щёлкните куда: на пол или на то, что там стоит.', 'Choose what to put down, and click where: on the floor, or on what stands there.'),
  point: () => L('Щёлкните, где роботу вставать.', 'Click where the robot is to stand.'),
  room: () => L('Потяните прямоугольник или отмечайте углы щелчками; Enter замыкает. Числа – в полях.', 'Drag a rectangle, or click corners; Enter closes. Numbers: in the fields.'),
  zone: () => L('Потяните прямоугольник или отмечайте углы щелчками; Enter замыкает.', 'Drag a rectangle, or click corners; Enter closes.'),
  door: () => L('Щёлкните по стене, или выберите в полях, между какими помещениями.', 'Click a wall, or choose in the fields between which rooms.'),
  shape: () => L('Тяните углы выбранного помещения, или его самого; стрелки двигают его на 1 см, углы – числами в полях.', 'Drag the corners of the chosen room, or the room itself; arrows move it 1 cm, corners also by numbers in the fields.'),
  plan: () => L('Тяните рисунок; две точки с известным расстоянием задают масштаб.', 'Drag the picture; two points with a known distance give its scale.'),
};
export const hint = () => HINTS[S.edit?.tool]?.();

/* points that lie where something is */
function snapped([x, y], from) {
  const near = 8 / view.k;
  let [bx, by] = [null, null];
  const meets = (to, at, best) => (Math.abs(to - at) < Math.min(near, best === null ? Infinity : Math.abs(best - at)) ? to : best);
  for (const [a, b] of S.drawing.walls) for (const [wx, wy] of [a, b]) { bx = meets(wx, x, bx); by = meets(wy, y, by); }
  for (const point of S.edit.draft?.points ?? []) { bx = meets(point[0], x, bx); by = meets(point[1], y, by); }
  if (from) { bx = meets(from[0], x, bx); by = meets(from[1], y, by); }
  return [tenth(bx ?? x), tenth(by ?? y)];
}

const counterClockwise = (points) => {
  let area = 0;
  points.forEach(([x, y], i) => { const [nx, ny] = points[(i + 1) % points.length]; area += x * ny - nx * y; });
  return area < 0 ? [...points].reverse() : points;
};

/* what becomes of a press on the map, by the tool in hand */
export function grab(event, name) {
  const edit = S.edit;
  if (!edit?.tool || S.asOf !== null) return null;
  if (edit.tool === 'room' || edit.tool === 'zone') return outline(event);
  if (edit.tool === 'thing' || edit.tool === 'point') return { move() {}, end() {}, click: (at) => putDown(under(at)) };
  if (edit.tool === 'door') return { move() {}, end() {}, click: (at) => doorAt(under(at)) };
  if (edit.tool === 'shape') return corners(event, name);
  return null;
}
function outline(event) {
  const { edit } = S, begun = under(event);
  return {
    move(next) {
      const from = snapped(begun), to = snapped(under(next));
      edit.draft = { closed: true, points: [from, [to[0], from[1]], to, [from[0], to[1]]] };
      paint(); soon();
    },
    end: () => soon(),
    click(at) {
      if (!edit.draft || edit.draft.closed) edit.draft = { closed: false, points: [] };
      const { points } = edit.draft, point = snapped(under(at), points.at(-1));
      const first = points[0];
      if (points.length > 2 && Math.hypot(first[0] - point[0], first[1] - point[1]) < 10 / view.k) { close(); return; }
      points.push(point); paint(); render();
    },
  };
}
/** Closes an outline that is being clicked; false where there is none to close. */
export function close() {
  const draft = S.edit?.draft;
  if (!draft || draft.closed || draft.points.length < 3) return false;
  draft.closed = true; soon();
  return true;
}

/* a room's corners, and the room itself */
export async function choose(name) {
  const edit = S.edit, room = named(name);
  if (!room?.frame) return;
  edit.awaited = name;
  const about = await ask('/api/thing', { name, lang: S.lang }).catch(() => null);
  if (S.edit !== edit || edit.awaited !== name || !about) return;
  Object.assign(edit, { name, kind: 'room', room, parts: about.parts.map((part) => ({ id: part.id, points: part.sides.map((side) => [...side.from]), was: part.sides.map((side) => side.from) })), shift: null, steps: null, tried: null, wrong: null });
  render(); paint();
}
function corners(event, name) {
  const { edit } = S;
  if (!edit.parts || (edit.name !== name && !onCorner(event))) return { move() {}, end() {}, click: () => { if (name) choose(name); } };
  const held = onCorner(event), begun = under(event);
  if (held) {
    const reshaped = () => reshape(held.part);
    return { move(next) { held.part.points[held.at] = snapped(under(next)); paint(); reshaped(); }, end: reshaped, click() {} };
  }
  const [bx, by] = edit.shift ?? [0, 0];
  const moved = (next) => { const [x, y] = under(next); shift(bx + x - begun[0], by + y - begun[1]); };
  return { move: moved, end: moved, click() {} };
}
/** Puts the chosen room elsewhere, by cm from where it stands. */
function shift(dx, dy) {
  const { edit } = S, { x, y } = edit.room.frame, d = [tenth(dx), tenth(dy)];
  edit.parts.forEach((part) => { part.points = part.was.map((p) => [tenth(p[0] + d[0]), tenth(p[1] + d[1])]); });
  edit.shift = d; paint();
  will([{ stand: edit.name, map: S.map, at: [tenth(x + d[0]), tenth(y + d[1])], relink: true }]);
}
/** Moves the chosen room by a key; false where none is chosen with its shape unlocked. */
export function nudge(dx, dy) {
  if (S.edit?.tool !== 'shape' || !S.edit.parts) return false;
  const [x, y] = S.edit.shift ?? [0, 0];
  shift(x + dx, y + dy);
  return true;
}
/** The corners of the chosen room as numbers. */
export function cornerFields() {
  const many = S.edit.parts.length > 1, name = (part, i) => `${many ? `${part.id}, ` : ''}${i + 1}`;
  const one = (part, i, axis, sign) => el('label', null, el('span', null, L(`Угол ${name(part, i)}, ${sign}`, `Corner ${name(part, i)}, ${sign}`)), el('input', { type: 'number', step: '1', id: `f-corner-${part.id}-${i}-${axis}`, value: tenth(part.points[i][axis]), onchange: (event) => { part.points[i][axis] = Number(event.target.value); paint(); reshape(part); } }));
  const all = S.edit.parts.map((part) => part.points.map((_, i) => [one(part, i, 0, 'X'), one(part, i, 1, 'Y')]));
  return el('form', { class: 'draft', onsubmit: (event) => { event.preventDefault(); write(); } }, el('div', { class: 'four' }, all), el('button', { class: 'vh', tabindex: '-1', 'aria-hidden': 'true' }));
}
function onCorner(event) {
  const [x, y] = under(event);
  for (const part of S.edit.parts ?? []) {
    const at = part.points.findIndex((p) => Math.hypot(p[0] - x, p[1] - y) < 12 / view.k);
    if (at >= 0) return { part, at };
  }
  return null;
}
/** The corners of a part in the room's own frame. */
function reshape(part) {
  const { x, y, angle_deg: angle } = S.edit.room.frame, [c, s] = [Math.cos(radians(angle)), Math.sin(radians(angle))];
  const inner = part.points.map(([px, py]) => { const [dx, dy] = [px - x, py - y]; return [tenth(c * dx + s * dy), tenth(c * dy - s * dx)]; });
  will([{ shape: S.edit.name, item: part.id, points: inner }]);
}

/* things and places put down */
const roomAt = (p) => S.drawing.rooms.find((room) => room.polygons.some((polygon) => holds(polygon, p)));
/** The highest thing under a point, which bears what is put there. */
function beneath(p) {
  const all = S.drawing.things.filter((thing) => thing.polygons.some((polygon) => holds(polygon, p)));
  return all.sort((a, b) => b.z[1] - a.z[1])[0] ?? null;
}
function putDown([x, y]) {
  const { fields, tool } = S.edit, room = roomAt([x, y]);
  if (!room) { announce(L('Здесь нет помещения', 'There is no room here'), true); return; }
  Object.assign(fields, { x: tenth(x), y: tenth(y) });
  if (tool === 'thing') fields.z = tenth((beneath([x, y])?.z[1] ?? room.frame.z) - room.frame.z);
  render(true); soon();
}
/** The steps that put a thing or a place down where the fields say, and how that will look. */
function put(edit) {
  const { fields, tool } = edit, [x, y] = [Number(fields.x), Number(fields.y)];
  edit.ghost = null;
  if (fields.x === '' || fields.y === '' || !fields.name.trim()) return null;
  const room = roomAt([x, y]);
  if (!room) throw new Error(L('Здесь нет помещения', 'There is no room here'));
  const name = fields.name.trim();
  if (tool === 'point') {
    const step = { point: name, area: room.name, pose: [x, y], heading: Number(fields.heading) }, r = 8;
    if (fields.serves) step.serves = fields.serves;
    edit.ghost = { name, polygons: [[[x - r, y], [x, y - r], [x + r, y], [x, y + r]]] };
    return { steps: [step] };
  }
  const kind = S.kinds?.objects.find((one) => one.object === fields.kind);
  if (!kind) return null;
  // Its middle comes where the click was.
  const all = kind.polygons.flat(), middle = [0, 1].map((axis) => (Math.min(...all.map((p) => p[axis])) + Math.max(...all.map((p) => p[axis]))) / 2);
  const angle = Number(fields.angle), [c, s] = [Math.cos(radians(angle)), Math.sin(radians(angle))];
  const onMap = ([px, py]) => { const [dx, dy] = [px - middle[0], py - middle[1]]; return [x + c * dx - s * dy, y + s * dx + c * dy]; };
  const [ox, oy] = onMap([0, 0]).map(tenth);
  edit.ghost = { name, polygons: kind.polygons.map((polygon) => polygon.map(onMap)) };
  return { steps: [{ place: name, object: kind.object, area: room.name, pose: [ox, oy, tenth(room.frame.z + Number(fields.z))], angle }] };
}

/* a door in a wall */
const along = ([ax, ay], [bx, by], [x, y]) => {
  const l = Math.hypot(bx - ax, by - ay);
  return l ? ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / l : 0;
};
function foot(a, b, p) {
  const l = Math.hypot(b[0] - a[0], b[1] - a[1]), t = Math.max(0, Math.min(l, along(a, b, p)));
  const at = l ? [a[0] + ((b[0] - a[0]) * t) / l, a[1] + ((b[1] - a[1]) * t) / l] : a;
  return { at, away: Math.hypot(at[0] - p[0], at[1] - p[1]) };
}
const edges = (room) => room.polygons.flatMap((polygon) => polygon.map((p, i) => [p, polygon[(i + 1) % polygon.length]]));
/** So far apart are two rooms at most that a door joins: the thickness of a wall. */
const WALL = 60;
const parallel = ([a, b], [c, d]) => Math.abs((b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])) < 0.02 * Math.hypot(b[0] - a[0], b[1] - a[1]) * Math.hypot(d[0] - c[0], d[1] - c[1]);

function doorAt(point) {
  let best = null;
  for (const room of S.drawing.rooms) for (const edge of edges(room)) {
    const found = foot(...edge, point);
    if (found.away < Math.max(30 / view.k, 15) && (!best || found.away < best.away)) best = { ...found, room, edge };
  }
  if (!best) { announce(L('Здесь нет стены', 'There is no wall here'), true); return; }
  const other = neighbour(best.room, best.edge, best.at);
  Object.assign(S.edit.fields, { one: best.room.name, other: other?.name ?? '', along: 0 });
  S.edit.spot = best.at;
  rebuild(); render();
}
/** The room on the other side of a wall at a point, if there is one. */
function neighbour(room, edge, at) {
  let best = null;
  for (const other of S.drawing.rooms) {
    if (other === room) continue;
    for (const wall of edges(other)) {
      const found = foot(...wall, at);
      if (found.away < WALL && parallel(edge, wall) && (!best || found.away < best.away)) best = { away: found.away, room: other };
    }
  }
  return best?.room ?? null;
}
/** The middle of the longest stretch of wall that two rooms share, or of a room's longest wall. */
function between(one, other) {
  let best = null;
  for (const edge of edges(one)) {
    if (!other) { const l = Math.hypot(edge[1][0] - edge[0][0], edge[1][1] - edge[0][1]); if (!best || l > best.l) best = { l, at: [(edge[0][0] + edge[1][0]) / 2, (edge[0][1] + edge[1][1]) / 2] }; continue; }
    for (const wall of edges(other)) {
      if (!parallel(edge, wall) || foot(...edge, wall[0]).away > WALL + 1e4) continue;
      const [a, b] = edge, l = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const [t0, t1] = [along(a, b, wall[0]), along(a, b, wall[1])].sort((p, q) => p - q), [s0, s1] = [Math.max(0, t0), Math.min(l, t1)];
      if (s1 - s0 < 20) continue;
      const t = (s0 + s1) / 2, at = [a[0] + ((b[0] - a[0]) * t) / l, a[1] + ((b[1] - a[1]) * t) / l];
      if (foot(...wall, at).away > WALL) continue;
      if (!best || s1 - s0 > best.l) best = { l: s1 - s0, at };
    }
  }
  return best?.at ?? null;
}

/** The steps that cut a stretch of a room's wall and hang a door in it; none where the room has no free wall there. */
async function hung(room, ends, door, opens, permeability) {
  const about = await ask('/api/thing', { name: room, lang: S.lang });
  let best = null;
  for (const part of about.parts) for (const side of part.sides) {
    const middle = [(ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2], found = foot(side.from, side.to, middle);
    if (!parallel([side.from, side.to], ends) || (best && found.away >= best.away)) continue;
    best = { ...found, part, side };
  }
  if (!best || best.away > WALL) throw new Error(L(`У «${room}» здесь нет стены`, `${N(room)} has no wall here`));
  if (best.side.doors.length || best.side.is_window || best.side.permeability !== 0) throw new Error(L(`Здесь в стене «${room}» уже есть проём`, `The wall of ${N(room)} has an opening here already`));
  const [t0, t1] = ends.map((p) => along(best.side.from, best.side.to, p)).sort((a, b) => a - b);
  const ids = new Set(best.part.sides.map((side) => side.id));
  let n = 1;
  while (ids.has(`D${n}`)) n += 1;
  return [
    { cut: room, side: `${best.part.id}.${best.side.id}`, from: tenth(t0), to: tenth(t1), as: `D${n}`, permeability },
    { bind: door, to: room, side: `${best.part.id}.D${n}`, opens },
  ];
}

/* the steps of what is drawn */
/** While something is drawn: one after another, of what it is by then. */
let busy = false, more = false;
async function soon() {
  if (busy) { more = true; return; }
  busy = true;
  do { more = false; await rebuild(); } while (more);
  busy = false;
}
let number = 0;
export async function rebuild() {
  const { edit } = S, mine = ++number;
  try {
    const made = await steps(edit);
    if (S.edit !== edit || mine !== number) return;
    if (made) await will(made.steps, made.more); else { Object.assign(edit, { steps: null, tried: null, wrong: null }); render(); paint(); }
  } catch (error) {
    if (S.edit !== edit || mine !== number) return;
    Object.assign(edit, { steps: null, tried: null, wrong: [error.message] });
    announce(error.message, true); render(); paint();
  }
}
async function steps(edit) {
  const { fields, draft, tool } = edit;
  if (tool === 'thing' || tool === 'point') return put(edit);
  if (tool === 'door') {
    const [one, other] = [named(fields.one), named(fields.other)];
    if (!one) return null;
    const spot = edit.spot ?? between(one, other);
    if (!spot) throw new Error(L('У этих помещений нет общей стены', 'These rooms share no wall'));
    const edge = edges(one).map((e) => ({ e, ...foot(...e, spot) })).sort((a, b) => a.away - b.away)[0];
    const [a, b] = edge.e, l = Math.hypot(b[0] - a[0], b[1] - a[1]), t = along(a, b, edge.at) + Number(fields.along || 0), half = Number(fields.width) / 2;
    const ends = [t - half, t + half].map((t) => [a[0] + ((b[0] - a[0]) * t) / l, a[1] + ((b[1] - a[1]) * t) / l]);
    if (!(half > 0)) return null;
    edit.draft = { closed: false, points: ends };
    const name = key(fields.name), leaves = fields.kind === 'passage' ? [] : [{ hinge: fields.hinge }];
    const lets = fields.kind === 'passage' ? 'permeable' : 'conditional', made = [...await hung(one.name, ends, name, fields.opens, lets)];
    if (other) made.push(...await hung(other.name, ends, name, fields.opens === 'inside' ? 'outside' : 'inside', lets));
    return { steps: made, more: { door: { [name]: { name: fields.name.trim(), kind: fields.kind, width: Number(fields.width), height: Number(fields.height), leaves, state: fields.kind === 'passage' ? 'open' : 'closed' } } } };
  }
  if (!draft?.closed) return null;
  const points = counterClockwise(draft.points), [ox, oy] = points[0], name = key(fields.name);
  if (tool === 'room') {
    const base = points.map(([x, y]) => [tenth(x - ox), tenth(y - oy)]);
    const stands = { stand: name, map: S.map, at: [ox, oy] }, tie = S.drawing.rooms.length ? await tied(name, points) : null;
    return {
      // A storey hangs together: the new room is tied to the wall that is nearest, whatever lies between.
      steps: tie ? [stands, tie, { ...stands, relink: true }] : [stands],
      more: { orthoframe: { [name]: { height: Number(fields.height), points: base } }, area: { [name]: { name: fields.name.trim(), items: [{ id: 'A', orthoframe: name }] } } },
    };
  }
  const zone = { zone: fields.name.trim(), kind: fields.kind, points, map: S.map };
  if (fields.kind === 'slow') zone.speed = Number(fields.speed);
  if (fields.kind === 'one-way') zone.heading = Number(fields.heading);
  if (fields.reason.trim()) zone.reason = fields.reason.trim();
  for (const at of ['from', 'until']) if (fields[at]) zone[at] = `${new Date(fields[at]).toISOString().slice(0, 16)}Z`;
  return { steps: [zone] };
}

/** The link of a new room to the wall of another that is nearest to one of its own. */
async function tied(name, points) {
  const middle = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], own = points.map((p, i) => [p, points[(i + 1) % points.length]]);
  let best = null;
  for (const room of S.drawing.rooms) for (const wall of edges(room)) own.forEach((edge, i) => {
    const away = Math.min(foot(...wall, middle(edge)).away, foot(...edge, middle(wall)).away) + (parallel(wall, edge) ? 0 : 1e4);
    if (!best || away < best.away) best = { away, room, wall, side: String.fromCharCode(65 + i) };
  });
  if (!best || points.length > 26) return null;
  const about = await ask('/api/thing', { name: best.room.name, lang: S.lang }), spot = middle(best.wall);
  let to = null;
  for (const part of about.parts) for (const side of part.sides) {
    if (side.permeability !== 0) continue;
    const { away } = foot(side.from, side.to, spot);
    if (!to || away < to.away) to = { away, text: `${best.room.name}.${part.id}.${side.id}` };
  }
  return to ? { link: `${name}.A.${best.side}`, to: to.text } : null;
}

/* the fields: what a pointer draws, and what it cannot */
let timer = 0;
/** What was typed last becomes steps before they are written. */
export async function flush() { if (timer) { clearTimeout(timer); timer = 0; await rebuild(); } }
function set(name, value) {
  S.edit.fields[name] = value;
  if (['one', 'other'].includes(name)) { S.edit.spot = null; S.edit.fields.along = 0; }
  clearTimeout(timer); timer = setTimeout(() => { timer = 0; rebuild(); }, 250);
}
const field = (name, label, kind = 'text', more = {}) => el('label', null, el('span', null, label), el('input', { id: `f-${name}`, type: kind, value: S.edit.fields[name], oninput: (event) => set(name, event.target.value), ...more }));
const choice = (name, label, options, chosen = () => {}) => el('label', null, el('span', null, label), el('select', { id: `f-${name}`, onchange: (event) => { chosen(event.target.value); set(name, event.target.value); render(true); } }, options.map(([value, text]) => el('option', { value, selected: S.edit.fields[name] === value }, text))));
const cm = L.bind(null, 'см', 'cm');

/** The box of a rectangle that is drawn, as numbers. */
function rectangle() {
  const drawn = () => {
    const points = S.edit.draft?.closed ? S.edit.draft.points : null;
    return points ? [Math.min(...points.map((p) => p[0])), Math.min(...points.map((p) => p[1])), Math.max(...points.map((p) => p[0])), Math.max(...points.map((p) => p[1]))] : null;
  };
  const shown = drawn(), number = (i, label) => el('label', null, el('span', null, label), el('input', { id: `f-box${i}`, type: 'number', step: '1', value: shown ? tenth(i < 2 ? shown[i] : shown[i] - shown[i - 2]) : '', onchange: (event) => {
    const box = drawn(), now = box ? [...box] : [view.x + view.w / view.k / 2 - 150, -view.y - view.h / view.k / 2 - 150, 0, 0].map(tenth), size = box ? [box[2] - box[0], box[3] - box[1]] : [300, 300], value = Number(event.target.value);
    if (i < 2) now[i] = value; else size[i - 2] = value;
    const [x, y] = now, [w, h] = size;
    S.edit.draft = { closed: true, points: [[x, y], [tenth(x + w), y], [tenth(x + w), tenth(y + h)], [x, tenth(y + h)]] };
    paint(); soon();
  } }));
  return el('div', { class: 'four' }, number(0, `X, ${cm()}`), number(1, `Y, ${cm()}`), number(2, L('Ширина', 'Width')), number(3, L('Глубина', 'Depth')));
}

/** The form of the tool in hand. */
export function form() {
  const { tool } = S.edit;
  if (!FIELDS[tool]) return null;
  const rooms = S.drawing.rooms.map((room) => [room.name, N(room)]).sort((a, b) => a[1].localeCompare(b[1]));
  const spot = () => el('div', { class: 'four' }, field('x', `X, ${cm()}`, 'number', { step: 'any' }), field('y', `Y, ${cm()}`, 'number', { step: 'any' }), tool === 'thing' ? [field('z', L('Над полом, см', 'Above the floor, cm'), 'number', { step: 'any' }), field('angle', L('Поворот, °', 'Turn, °'), 'number')] : field('heading', L('Смотрит, °', 'Looks, °'), 'number'));
  const parts = [];
  if (tool === 'thing') {
    const kinds = (S.kinds?.objects ?? []).map((one) => [one.object, N(one)]).sort((a, b) => a[1].localeCompare(b[1]));
    parts.push(choice('kind', L('Что', 'What'), [['', '–'], ...kinds], (key) => { const one = S.kinds.objects.find((kind) => kind.object === key); if (one) S.edit.fields.name = fresh(L(one.name, one.name_en || one.name), one.name_en || one.name); }));
  }
  parts.push(field('name', L('Имя', 'Name'), 'text', { maxlength: 120, required: true }));
  if (tool === 'thing' || tool === 'point') parts.push(spot());
  if (tool === 'point') parts.push(choice('serves', L('Отсюда берут с', 'From here one takes from'), [['', '–'], ...S.drawing.things.map((one) => [one.name, N(one)]).sort((a, b) => a[1].localeCompare(b[1]))]));
  if (tool === 'room') parts.push(rectangle(), field('height', L('Высота, см', 'Height, cm'), 'number', { min: 1 }));
  if (tool === 'zone') {
    parts.push(choice('kind', L('Правило', 'Rule'), [['keep-out', L('не въезжать', 'keep out')], ['closed', L('закрыто', 'closed')], ['slow', L('медленно', 'slow')], ['one-way', L('в одну сторону', 'one way')]]), rectangle());
    if (S.edit.fields.kind === 'slow') parts.push(field('speed', L('Скорость, см/с', 'Speed, cm/s'), 'number', { min: 1 }));
    if (S.edit.fields.kind === 'one-way') parts.push(field('heading', L('Направление, °', 'Heading, °'), 'number'));
    parts.push(field('reason', L('Почему', 'Why')), field('from', L('С какого времени', 'From'), 'datetime-local'), field('until', L('До какого времени', 'Until'), 'datetime-local'));
  }
  if (tool === 'door') {
    parts.push(choice('one', L('Из помещения', 'From the room'), [['', '–'], ...rooms]), choice('other', L('В помещение', 'Into the room'), [['', L('наружу', 'outside')], ...rooms]),
      el('div', { class: 'four' }, field('width', L('Ширина, см', 'Width, cm'), 'number', { min: 1 }), field('height', L('Высота, см', 'Height, cm'), 'number', { min: 1 }), field('along', L('Сдвиг, см', 'Shift, cm'), 'number')),
      choice('kind', L('Какая', 'Which'), [['hinged', L('распашная', 'hinged')], ['sliding', L('раздвижная', 'sliding')], ['passage', L('проход без створки', 'passage without a leaf')]]));
    if (S.edit.fields.kind !== 'passage') parts.push(choice('hinge', L('Петли', 'Hinges'), [['left', L('слева', 'left')], ['right', L('справа', 'right')]]), choice('opens', L('Открывается', 'Opens'), [['inside', L('внутрь первого', 'into the first room')], ['outside', L('наружу из него', 'out of it')]]));
  }
  return el('form', { class: 'draft', onsubmit: async (event) => { event.preventDefault(); await flush(); write(); } }, el('p', { class: 'sub' }, hint()), parts, el('button', { class: 'vh', tabindex: '-1', 'aria-hidden': 'true' }));
}

/** Shows where the draft lies, for who draws by numbers. */
export function look() {
  const points = S.edit?.draft?.points ?? [];
  if (points.length) { const b = boxOf({ polygons: [points] }); centre((b[0] + b[2]) / 2, -(b[1] + b[3]) / 2); paint(); }
}
export const areaOf = (points) => { let area = 0; points.forEach(([x, y], i) => { const [nx, ny] = points[(i + 1) % points.length]; area += x * ny - nx * y; }); return `${num(Math.abs(area) / 20000)} ${L('м²', 'm²')}`; };
