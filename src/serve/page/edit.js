// Editing: every gesture is one edit, tried while it is made, written as one revision when it is meant.
import { S, L, N, api, announce, length, reasons } from './base.js';
import { boxOf, named, paint, view, under } from './map.js';
import { reason } from './talk.js';

let render = () => {}, after = () => {};
export const begin = (redraw, written) => { render = redraw; after = written; };
const radians = (degrees) => (degrees * Math.PI) / 180;
const tenth = (value) => Math.round(value * 10) / 10;

export function toggle() {
  S.edit = S.edit ? null : { on: S.state.revision };
  reasons();
  if (S.edit) { S.tab = 'map'; if (S.selected) choose(S.selected); }
  render();
}

/** Takes something up to be edited. */
export function choose(name) {
  const one = named(name), edit = { on: S.edit?.on ?? S.state.revision };
  if (one?.gap) Object.assign(edit, { name, kind: 'door' });
  else if (one?.rule !== undefined) Object.assign(edit, { name, kind: 'zone', zone: one });
  else if (one?.frame) Object.assign(edit, { name, kind: 'room', room: one });
  else if (one?.at && !one.on_map && !one.gap) Object.assign(edit, { name, kind: 'place', place: one });
  else if (one?.on_map) Object.assign(edit, { name, kind: 'thing', thing: one, from: one.at, at: { ...one.at } });
  S.edit = edit;
}

/** The room's frame: its angle, by which the thing's own numbers are turned. */
export const roomAngle = (thing) => S.drawing.rooms.find((room) => room.name === thing.room)?.frame.angle_deg ?? 0;

function turned([x, y], about, degrees) {
  const [c, s] = [Math.cos(radians(degrees)), Math.sin(radians(degrees))], [dx, dy] = [x - about[0], y - about[1]];
  return [about[0] + c * dx - s * dy, about[1] + s * dx + c * dy];
}

/** Shifts by map cm and turns by degrees from where the thing stands. */
function place(dx, dy, turn) {
  const { thing } = S.edit, b = boxOf(thing), centre = [(b[0] + b[2]) / 2, -(b[1] + b[3]) / 2];
  const moved = thing.polygons.map((polygon) => polygon.map((p) => { const [x, y] = turned(p, centre, turn); return [x + dx, y + dy]; }));
  const origin = turned([thing.on_map.x, thing.on_map.y], centre, turn);
  const step = turned([origin[0] + dx - thing.on_map.x, origin[1] + dy - thing.on_map.y], [0, 0], -roomAngle(thing));
  S.edit.at = { ...thing.at, x: tenth(thing.at.x + step[0]), y: tenth(thing.at.y + step[1]), angle_deg: (((thing.at.angle_deg + turn) % 360) + 360) % 360 };
  S.edit.ghost = { name: thing.name, polygons: moved };
  Object.assign(S.edit, { shift: [dx, dy, turn], tried: null, theirs: null, asking: null });
  S.edit.steps = [{ move: thing.name, to: [S.edit.at.x, S.edit.at.y], carry: true }];
  if (turn) S.edit.steps.push({ turn: thing.name, to: S.edit.at.angle_deg, carry: true });
  sizes(b, dx, dy);
  paint();
}

/** Edges and middles of what stands near draw a dragged thing to them, within some pixels. */
function snapped(dx, dy) {
  const near = 8 / view.k, b = boxOf(S.edit.thing), lines = [];
  const mine = (axis) => [b[axis], (b[axis] + b[axis + 2]) / 2, b[axis + 2]];
  const others = S.drawing.things.filter((thing) => thing !== S.edit.thing).map(boxOf).filter((o) => Math.hypot((o[0] + o[2] - b[0] - b[2]) / 2 - dx, (o[1] + o[3] - b[1] - b[3]) / 2 + dy) < 300);
  const walls = S.drawing.walls.map(([p, q]) => [Math.min(p[0], q[0]), -Math.max(p[1], q[1]), Math.max(p[0], q[0]), -Math.min(p[1], q[1])]);
  const best = (axis, shift) => {
    let found = null;
    for (const o of [...others, ...walls.filter((w) => Math.abs(w[axis] - w[axis + 2]) < 0.5)]) for (const to of [o[axis], (o[axis] + o[axis + 2]) / 2, o[axis + 2]]) for (const from of mine(axis)) {
      const away = to - from - shift;
      if (Math.abs(away) < near && (!found || Math.abs(away) < Math.abs(found.away))) found = { away, to, o };
    }
    return found;
  };
  const x = best(0, dx), y = best(1, -dy);
  const nx = dx + (x?.away ?? 0), ny = dy - (y?.away ?? 0);
  if (x) lines.push([[x.to, -Math.min(x.o[1], b[1] - ny) + 20], [x.to, -Math.max(x.o[3], b[3] - ny) - 20]]);
  if (y) lines.push([[Math.min(y.o[0], b[0] + nx) - 20, -y.to], [Math.max(y.o[2], b[2] + nx) + 20, -y.to]]);
  S.edit.snaps = lines;
  return [nx, ny];
}
function sizes(b, dx, dy) {
  S.edit.sizes = dx || dy ? [[(b[0] + b[2]) / 2 + dx, -b[1] + dy + 16 / view.k, length(Math.hypot(dx, dy))]] : [];
}

/** A drag of the thing under the pointer; false where there is none to drag. */
export function grab(event, name) {
  const one = named(name);
  if (!S.edit || S.edit.tool) return null;
  if (one?.rule !== undefined) return one.rooms.length || S.edit.name !== name ? null : zone(event, one);
  if (one?.at && !one.on_map && !one.gap) return spot(event, one);
  if (!one?.on_map) return null;
  if (S.edit.name !== name) { choose(name); render(); }
  const begun = under(event), [bx, by, turn] = S.edit.shift ?? [0, 0, 0];
  return {
    move(next) {
      const [x, y] = under(next);
      let [dx, dy] = [bx + x - begun[0], by + y - begun[1]];
      if (next.shiftKey) { if (Math.abs(dx - bx) > Math.abs(dy - by)) dy = by; else dx = bx; }
      if (!next.altKey) [dx, dy] = snapped(dx, dy); else S.edit.snaps = [];
      place(tenth(dx), tenth(dy), turn);
      live();
    },
    end() { S.edit.snaps = []; live(); },
  };
}

/** A zone of one's own corners is dragged. */
function zone(event, one) {
  const begun = under(event);
  return {
    move(next) {
      const [x, y] = under(next);
      shiftZone(one, [tenth(x - begun[0]), tenth(y - begun[1])]);
      live();
    },
    end: live,
  };
}
function shiftZone(one, by) {
  Object.assign(S.edit, { by, tried: null, theirs: null, steps: [{ move: one.name, by }], ghost: { name: one.name, polygons: one.polygons.map((polygon) => polygon.map((p) => [p[0] + by[0], p[1] + by[1]])) } });
  paint();
}
/** A place to stand at is dragged. */
function spot(event, one) {
  if (S.edit.name !== one.name) { choose(one.name); render(); }
  const begun = under(event);
  return {
    move(next) {
      const [x, y] = under(next);
      shiftPlace(one, [tenth(x - begun[0]), tenth(y - begun[1])]);
      live();
    },
    end: live,
  };
}
/** By map cm; the step counts along the axes of the place's room. */
function shiftPlace(one, by) {
  const [x, y] = [one.at[0] + by[0], one.at[1] + by[1]], r = 8, inner = turned(by, [0, 0], -roomAngle(one)).map(tenth);
  Object.assign(S.edit, { by, tried: null, theirs: null, steps: [{ move: one.name, by: inner }], ghost: { name: one.name, polygons: [[[x - r, y], [x, y - r], [x + r, y], [x, y + r]]] }, sizes: [[x, y + 18 / view.k, length(Math.hypot(...by))]] });
  paint();
}

/** Moves or turns by a key. */
export function nudge(dx, dy, turn = 0) {
  const { kind, zone: area, place: point, by: [bx, by] = [0, 0] } = S.edit ?? {};
  if (kind === 'zone' && !turn && !area.rooms.length) shiftZone(area, [bx + dx, by + dy]);
  else if (kind === 'place' && !turn) shiftPlace(point, [bx + dx, by + dy]);
  else if (kind === 'thing') { const [x, y, t] = S.edit.shift ?? [0, 0, 0]; place(x + dx, y + dy, t + turn); } else return false;
  live(); render();
  return true;
}
/** Has the server check what is dragged, while it is: one request at a time, of what it is by then. */
let flying = false, again = false;
export async function live() {
  if (flying) { again = true; return; }
  flying = true;
  do { again = false; await test(); } while (again);
  flying = false;
}

/** Has the server check what would be written. */
async function test() {
  const edit = S.edit;
  if (!edit?.steps) return;
  try {
    edit.tried = await api('/api/edits', { on: edit.on, try: true, edit: edit.steps, ...edit.more });
    edit.wrong = null;
  } catch (error) { refused(edit, error); }
  if (S.edit === edit) { render(); paint(); }
}
function refused(edit, error) {
  edit.tried = null;
  if (error.status === 409) { edit.theirs = error.body.theirs; edit.wrong = null; return; }
  const faults = error.body?.faults ?? [];
  edit.wrong = faults.length ? faults.slice(0, 5).map((fault) => [(S.lang === 'en' && fault.message_en) || fault.message, (S.lang === 'en' && fault.help_en) || fault.help].filter(Boolean).join('. ').replace(/([.!?])\. /g, '$1 ')) : [reason(error)];
  announce(edit.wrong.join(' '), true);
}

/** Sets what is to be written, and tries it. */
export function will(steps, more) { Object.assign(S.edit, { steps, more, tried: null, theirs: null, asking: null }); render(); return live(); }

export async function write() {
  const edit = S.edit;
  if (!edit?.steps?.length || edit.wrong) return;
  try {
    const done = await api('/api/edits', { on: edit.on, edit: edit.steps, reason: edit.why ?? '', ...edit.more });
    // A tool stays in hand: who draws one room draws another.
    const again = edit.tool;
    S.edit = { on: done.revision };
    if (again && again !== 'shape') after(again);
    S.written = done.revision;
    S.toast = L(`Записано, ревизия ${done.revision}`, `Written, revision ${done.revision}`);
    announce(S.toast);
  } catch (error) { refused(edit, error); }
  render(); paint();
}
export function drop() { const { edit } = S; S.edit = edit?.steps || edit?.tool || edit?.draft ? { on: S.state.revision } : null; render(); paint(); }
/** Others came first, and this is meant all the same. */
export function onTop() { S.edit.on = S.state.revision; S.edit.theirs = null; live(); }

const asked = (value, done) => { S.edit.asking = { value, done }; render(); document.querySelector('#newname')?.focus(); };
export const rename = () => asked(S.edit.name, (name) => will([{ rename: S.edit.name, to: name }]));
export async function remove() {
  const { edit } = S, steps = [];
  // Where a door hung, the wall is whole again.
  if (edit.kind === 'door') for (const room of new Set(named(edit.name).rooms)) {
    const about = await api(`/api/thing?${new URLSearchParams({ name: room })}`).catch(() => ({ parts: [] }));
    for (const part of about.parts) for (const side of part.sides) if (side.doors.includes(edit.name)) {
      const length = Math.hypot(side.to[0] - side.from[0], side.to[1] - side.from[1]);
      steps.push({ cut: room, side: `${part.id}.${side.id}`, from: 0, to: length, as: side.id, permeability: 'impermeable' });
    }
  }
  if (S.edit === edit) will([...steps, { remove: edit.name }]);
}
export const door = (is) => will([{ state: S.edit.name, is }]);
/** A zone is in force no longer than this moment. */
export const ends = () => will([{ zone: S.edit.name, until: `${new Date().toISOString().slice(0, 16)}Z` }]);
/** Whole rooms are shut, until somebody opens them. */
export function shut() {
  let n = 1;
  while ((S.drawing.zones ?? []).some((one) => one.name === L(`Закрыто-${n}`, `Closed ${n}`))) n += 1;
  asked(L(`Закрыто-${n}`, `Closed ${n}`), (name) => will([{ zone: name, kind: 'closed', rooms: [S.edit.name] }]));
}
/** One more of the same, beside it. */
export function add() {
  const { thing } = S.edit, b = boxOf(thing);
  const base = thing.name.replace(/[-\s]?\d+$/, ''), joint = /-\d+$/.test(thing.name) ? '-' : ' ';
  let n = 1;
  while (named(`${base}${joint}${n}`)) n += 1;
  asked(`${base}${joint}${n}`, (name) => {
    const step = turned([b[2] - b[0] + 10, 0], [0, 0], -roomAngle(thing));
    will([{ place: name, object: thing.object, area: thing.room, at: [tenth(thing.at.x + step[0]), tenth(thing.at.y + step[1]), thing.at.z], angle: thing.at.angle_deg }]);
  });
}
export const label = () => (S.edit?.name ? N(S.edit.name) : '');
