// The drawing: rooms, things and doors once for a revision; what changes (robot, route, selection) as an overlay.
import { S, L, N, num, sv, $, ask, exact, length, names } from './base.js';
import { overlay as changes } from './changes.js';
import { draw as drawPicture } from './picture.js';

/** Map cm at the left top (y downwards), pixels a cm, pixels. */
export const view = { x: 0, y: 0, k: 1, w: 0, h: 0 };
const MOST_NAMES = 200;
let built = null;
let waiting = false;

const P = (points) => `M${points.map(([x, y]) => `${x} ${-y}`).join('L')}`;
const Z = (points) => `${P(points)}z`;
const bounds = (polygons) => {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const polygon of polygons) for (const [x, y] of polygon) {
    box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], -y); box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], -y);
  }
  return box;
};
export const boxOf = (thing) => (thing.box ??= bounds(thing.polygons ?? [thing.gap?.flat() ?? [thing.at]]));
const meets = (a, b) => a[0] < b[2] && a[2] > b[0] && a[1] < b[3] && a[3] > b[1];
export const middle = (of) => { const b = boxOf(of); return [(b[0] + b[2]) / 2, -(b[1] + b[3]) / 2]; };

/** Whether a polygon holds a point of the map. */
export const holds = (points, [x, y]) => {
  let is = false;
  points.forEach(([ax, ay], i) => { const [bx, by] = points[(i + 1) % points.length]; if ((ay > y) !== (by > y) && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) is = !is; });
  return is;
};

/** Room, thing, door or place of this name on the storey that is shown. */
export const named = (name) => {
  const d = S.drawing;
  if (!d || !name) return null;
  d.index ??= new Map([...(d.zones ?? []), ...d.places, ...d.rooms, ...d.things, ...d.doors.filter((door) => door.name)].map((one) => [one.name, one]));
  return d.index.get(name) ?? null;
};

function inView(grown = 0) {
  const w = view.w / view.k, h = view.h / view.k;
  return [view.x - grown * w, view.y - grown * h, view.x + (1 + grown) * w, view.y + (1 + grown) * h];
}

/** How much is drawn, by pixels a cm. */
const detail = () => (view.k < 0.08 ? 0 : view.k < 0.3 ? 1 : 2);

function ground(d, box, lod) {
  const shown = (one) => meets(boxOf(one), box);
  const rooms = d.rooms.filter(shown), g = sv('g', { class: 'ground' });
  if (lod === 0) g.append(sv('path', { class: 'm-floor', d: rooms.flatMap((room) => room.polygons.map(Z)).join('') }));
  else for (const room of rooms) g.append(sv('path', { class: 'm-floor', d: room.polygons.map(Z).join(''), 'data-name': room.name, 'data-kind': 'room' }));
  if (S.floor && S.layers.frames) for (const frame of S.floor.passframes) if (meets(bounds([frame.points]), box)) g.append(sv('path', { class: 'm-frame', d: Z(frame.points) }, sv('title', null, frame.id)));
  if (S.floor && S.layers.dead) for (const dead of S.floor.dead) if (meets(bounds([dead.outer]), box)) g.append(sv('path', { class: 'm-dead', 'fill-rule': 'evenodd', d: Z(dead.outer) + dead.holes.map(Z).join('') }));
  if (S.layers.zones) for (const zone of d.zones ?? []) g.append(sv('path', { class: `m-zone m-zone-${zone.kind}${zone.in_force ? '' : ' off'}`, d: zone.polygons.map(Z).join(''), 'data-name': zone.name, 'data-kind': 'zone' }, sv('title', null, `${N(zone)}: ${L(zone.rule, zone.rule_en)}`)));
  if (S.layers.things && lod > 0) {
    const things = d.things.filter(shown);
    if (lod === 1) for (const movable of [false, true]) {
      const some = things.filter((thing) => thing.movable === movable);
      g.append(sv('path', { class: movable ? 'm-m' : 'm-f', d: some.flatMap((thing) => thing.polygons.map(Z)).join('') }));
    }
    else for (const thing of things) {
      const group = sv('g', { class: 'thing', 'data-name': thing.name, 'data-kind': 'thing' }, sv('title', null, N(thing)));
      for (const polygon of thing.polygons) group.append(sv('path', { class: thing.movable ? 'm-m' : 'm-f', d: Z(polygon) }));
      g.append(group);
    }
  }
  const walls = d.walls.filter(([a, b]) => meets([Math.min(a[0], b[0]) - 1, -Math.max(a[1], b[1]) - 1, Math.max(a[0], b[0]) + 1, -Math.min(a[1], b[1]) + 1], box));
  g.append(sv('path', { class: 'm-wall', d: walls.map(P).join('') }));
  g.append(sv('path', { class: 'm-win', d: d.windows.map(P).join('') }), sv('path', { class: 'm-winl', d: d.windows.map(P).join('') }));
  for (const door of d.doors.filter(shown)) {
    if (lod === 0) continue;
    const group = sv('g', door.name ? { class: 'thing door', 'data-name': door.name, 'data-kind': 'door' } : {});
    if (door.name) group.append(sv('title', null, `${N(door)}: ${doorState(door)}`));
    const [a, b] = door.gap;
    group.append(sv('path', { class: 'm-sill', d: Z([a[0], b[0], b[1], a[1]]) }));
    for (const arc of door.arcs ?? []) group.append(sv('path', { class: 'm-arc', d: P(arc) }));
    for (const leaf of door.leaves ?? []) group.append(sv('path', { class: door.state === 'locked' ? 'm-locked' : 'm-leaf', d: Z(leaf) }));
    g.append(group);
  }
  if (S.floor && S.layers.network) g.append(sv('path', { class: 'm-net', d: S.floor.network.map(P).join('') }));
  if (S.layers.places && lod > 0) for (const place of d.places.filter(shown)) g.append(sv('circle', { class: 'm-place', cx: place.at[0], cy: -place.at[1], r: 4, 'data-name': place.name, 'data-kind': 'place' }, sv('title', null, N(place))));
  return g;
}
export const doorState = (door) => ({ open: L('открыта', 'open'), closed: L('закрыта', 'closed'), locked: L('заперта', 'locked') })[door.state] ?? '';

const text = (x, y, words, cls, px) => sv('text', { class: cls, x, y, 'font-size': px / view.k, 'stroke-width': 3.2 / view.k, dy: '.35em' }, words);

/** Names where nothing is beneath them, the largest first. */
function labels(d, taken, bold) {
  const g = sv('g', { class: 'labels' });
  if (!S.layers.names) return g;
  const k = view.k, box = inView(), boxes = [...taken];
  const wide = (words, px) => words.length * px * 0.57 / k;
  const free = (b) => b[0] > box[0] && b[2] < box[2] && b[1] > box[1] && b[3] < box[3] && !boxes.some((other) => meets(b, other));
  let count = 0;
  const place = (words, cls, px, spots, lines = 1) => {
    const w = wide(words, px), h = px * 1.25 * lines / k;
    for (const [x, y] of spots) {
      const b = [x - w / 2, y - px * 0.7 / k, x + w / 2, y - px * 0.7 / k + h];
      if (!free(b)) continue;
      boxes.push(b); count += 1;
      g.append(text(x, y, words, cls, px));
      return [x, y];
    }
    return null;
  };
  for (const one of bold) { const [x, y] = middle(one), b = boxOf(one); place(N(one), 'm-em', 13, [[x, b[1] - 10 / k], [x, b[3] + 10 / k], [x, -y], [b[2] + wide(N(one), 13) / 2 + 4 / k, -y]]); }
  const fine = k > 0.52, solid = d.things.filter((thing) => meets(boxOf(thing), box)).map(boxOf);
  for (const room of d.rooms) {
    if (count > MOST_NAMES || !room.middle || !meets(boxOf(room), box) || bold.includes(room)) continue;
    const b = boxOf(room), px = fine ? 16 : 12.5;
    if ((b[2] - b[0]) * k < N(room).length * px * 0.45) continue;
    const spots = [];
    for (let dx = -160; dx <= 160; dx += 20) for (let dy = -160; dy <= 160; dy += 20) {
      const x = room.middle[0] + dx, y = -room.middle[1] + dy;
      if (x > b[0] && x < b[2] && y > b[1] && y < b[3]) spots.push([x, y, Math.hypot(dx, dy)]);
    }
    spots.sort((p, q) => p[2] - q[2]);
    const half = wide(N(room), px) / 2;
    const own = spots.filter(([x, y]) => [x - half, x + half].every((side) => room.polygons.some((polygon) => holds(polygon, [side, -y]))));
    const clear = own.filter(([x, y]) => !solid.some((s) => meets([x - half, y - 12 / k, x + half, y + 28 / k], s)));
    const at = place(N(room), 'm-room', px, clear.length ? clear : own.length ? own.slice(0, 40) : spots.slice(0, 12), fine ? 2.2 : 1);
    if (at && fine) g.append(text(at[0], at[1] + 18 / k, `${num(room.m2)} ${L('м²', 'm²')}`, 'm-m2lab', 12));
  }
  if (detail() < 2 || !S.layers.things) return g;
  const near = 5 / k;
  for (const [p, q] of d.walls) boxes.push([Math.min(p[0], q[0]) - near, -Math.max(p[1], q[1]) - near, Math.max(p[0], q[0]) + near, -Math.min(p[1], q[1]) + near]);
  const area = (b) => (b[2] - b[0]) * (b[3] - b[1]);
  for (const thing of [...d.things].sort((a, b) => area(boxOf(b)) - area(boxOf(a)))) {
    if (count > MOST_NAMES) break;
    const b = boxOf(thing);
    if (bold.includes(thing) || !meets(b, box)) continue;
    const w = (b[2] - b[0]) * k, h = (b[3] - b[1]) * k, [x, y] = [(b[0] + b[2]) / 2, (b[1] + b[3]) / 2], need = wide(N(thing), 11) * k;
    if (w >= need + 2 && h >= 14) place(N(thing), 'm-th', 11, [[x, y]]);
    else if (Math.min(w, h) > 24 && need < w + 30) place(N(thing), 'm-th', 11, [[x, b[3] + 9 / k], [x, b[1] - 8 / k]]);
  }
  if (S.layers.zones) for (const zone of d.zones ?? []) { const b = boxOf(zone); if (meets(b, box) && !bold.includes(zone)) { const until = zoneTime(zone); place(`${N(zone)}${until ? ` · ${until}` : ''}`, 'm-zlab', 11.5, [[(b[0] + b[2]) / 2, (b[1] + b[3]) / 2], [(b[0] + b[2]) / 2, b[3] - 10 / k]]); } }
  if (S.layers.places) for (const one of d.places) if (fine && !bold.includes(one)) place(N(one), 'm-th', 11, [[one.at[0], -one.at[1] - 13 / k], [one.at[0], -one.at[1] + 13 / k]]);
  return g;
}

/** Until when a zone counts, or from when. */
export function zoneTime(zone) {
  const at = (text) => new Date(text).toLocaleString(S.lang === 'ru' ? 'ru' : 'en-GB', { dateStyle: 'short', timeStyle: 'short' });
  if (zone.from && !zone.in_force && new Date(zone.from) > new Date()) return L(`с ${at(zone.from)}`, `from ${at(zone.from)}`);
  if (zone.until) return zone.in_force ? L(`до ${at(zone.until)}`, `until ${at(zone.until)}`) : L('кончилась', 'over');
  return '';
}

function way(points, cls) {
  const g = sv('g');
  if (points.length > 1) g.append(sv('path', { class: 'm-halo', d: P(points), 'stroke-width': 8 / view.k }), sv('path', { class: cls, d: P(points), 'stroke-width': (cls === 'm-route' ? 4.5 : 2.5) / view.k }));
  return g;
}
function badge(x, y, words, hollow) {
  const r = 10 / view.k;
  return sv('g', { class: `m-badge${hollow ? ' hollow' : ''}` }, sv('circle', { cx: x, cy: -y, r, 'stroke-width': 1.6 / view.k }), sv('text', { x, y: -y, dy: '.36em', 'font-size': 11.5 / view.k }, words));
}
function tag(x, y, words, cls) {
  const k = view.k, w = (words.length * 6.9 + 16) / k, h = 22 / k;
  return sv('g', { class: `m-tag ${cls}` }, sv('rect', { x: x - w / 2, y: -y - h / 2, width: w, height: h, rx: 5 / k, 'stroke-width': 1.2 / k }), sv('text', { x, y: -y, dy: '.36em', 'font-size': 12 / k }, words));
}
function robot(place, past) {
  const { x, y, heading_deg: heading } = place.pose, k = view.k, r = S.state?.profile?.radius ?? 25, big = Math.max(1, 12 / (r * k));
  return sv('g', { class: `m-robot${past ? ' past' : ''}`, transform: `translate(${x} ${-y}) rotate(${-heading}) scale(${big})` },
    sv('title', null, L('Робот', 'Robot')), sv('circle', { r, 'stroke-width': 2 / k }), sv('path', { d: `M${r * 0.56} 0L${-r * 0.3} ${r * 0.42}L${-r * 0.1} 0L${-r * 0.3} ${-r * 0.42}z` }));
}

/** Directives of the plan that waits, or of the task that is driven. */
export const directives = () => (S.plan?.plan ?? S.task?.plan)?.directives ?? [];

function overlay(d, taken, bold) {
  const g = sv('g', { class: 'overlay' }), top = sv('g'), k = view.k;
  const along = (points) => { for (let i = 1; i < points.length; i += 1) { const [a, b] = [points[i - 1], points[i]], n = Math.min(200, Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) / 20)); for (let j = 0; j <= n; j += 1) keep([[a[0] + ((b[0] - a[0]) * j) / n, a[1] + ((b[1] - a[1]) * j) / n]]); } };
  const keep = (points) => { for (const [x, y] of points) taken.push([x - 9 / k, -y - 9 / k, x + 9 / k, -y + 9 / k]); };
  if (S.layers.belief) for (const away of d.elsewhere) {
    if (away.polygons) for (const polygon of away.polygons) g.append(sv('path', { class: 'm-away', d: Z(polygon), 'stroke-width': 2 / k }));
    const at = named(away.name);
    if (at) g.append(sv('rect', { class: 'm-was', ...rect(boxOf(at)), 'stroke-width': 1.5 / k }));
  }
  if (S.asOf === null) {
    const steps = directives(), from = S.plan ? 0 : S.step;
    if (S.trail.length > 1 && !S.plan) { g.append(sv('path', { class: 'm-trail', d: P(S.trail.filter((p) => p.map === d.map).map((p) => p.at)), 'stroke-width': 2 / k })); }
    if (S.task || S.plan) for (const [i, step] of steps.entries()) {
      if (i < from || step.map !== d.map || step.points.length < 2) continue;
      g.append(way(i === from && S.robot && !S.plan ? rest(step.points) : step.points, S.plan ? 'm-planned' : 'm-route'));
      along(step.points);
      const end = step.points[step.points.length - 1];
      top.append(badge(end[0], end[1], String(step.number), i > from)); keep([end]);
    }
  }
  const chosen = named(S.selected);
  if (S.proof) for (const one of S.proof.map(named).filter(Boolean)) { g.append(one.frame ? sv('path', { class: 'm-reason room', d: one.polygons.map(Z).join(''), 'stroke-width': 2 / k }) : sv('rect', { class: 'm-reason', ...rect(boxOf(one), 3 / k), 'stroke-width': 2 / k })); if (!one.frame) bold.push(one); }
  for (const one of S.marked.map(named).filter(Boolean)) { g.append(sv('rect', { class: 'm-mark', ...rect(boxOf(one), 4 / k), rx: 4 / k, 'stroke-width': 2.4 / k })); if (!bold.includes(one)) bold.push(one); }
  if (chosen) {
    if (S.layers.relations && S.thing?.name === chosen.name && !S.measures.length) related(chosen, g, top, taken);
    if (chosen.polygons) for (const polygon of chosen.polygons) g.append(sv('path', { class: 'm-sel', d: Z(polygon), 'stroke-width': 2.2 / k }));
    else g.append(sv('rect', { class: 'm-sel', ...rect(boxOf(chosen), 6 / k), 'stroke-width': 2.2 / k }));
    if (!bold.includes(chosen)) bold.push(chosen);
  }
  g.append(changes(k));
  measured(d, top);
  if (S.barred) remedy(g, top);
  if (S.layers.belief) for (const thing of d.carried ?? []) {
    const at = named(thing.name);
    if (at?.polygons) g.append(sv('rect', { class: 'm-was', ...rect(boxOf(at)), 'stroke-width': 1.5 / k }));
  }
  if (S.edit?.parts) for (const part of S.edit.parts) {
    top.append(sv('path', { class: `m-draft${S.edit.wrong ? ' wrong' : ''}`, d: Z(part.points), 'stroke-width': 2 / k }));
    for (const [x, y] of part.points) top.append(sv('rect', { class: 'm-handle', x: x - 5 / k, y: -y - 5 / k, width: 10 / k, height: 10 / k, 'stroke-width': 1.5 / k }));
  }
  if (S.edit?.draft) {
    const { points, closed } = S.edit.draft;
    if (points.length > 1) top.append(sv('path', { class: `m-draft${S.edit.wrong ? ' wrong' : ''}${closed ? '' : ' open'}${S.edit.tool === 'door' ? ' door' : ''}`, d: closed ? Z(points) : P(points), 'stroke-width': (S.edit.tool === 'door' ? 7 : 2) / k }));
    for (const [x, y] of points) top.append(sv('circle', { class: 'm-handle', cx: x, cy: -y, r: 4 / k, 'stroke-width': 1.5 / k }));
    points.forEach((p, i) => { const q = points[(i + 1) % points.length], l = Math.hypot(q[0] - p[0], q[1] - p[1]); if ((closed || i + 1 < points.length) && l * k > 70) top.append(tag((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, length(l), 'know')); });
  }
  for (const [x, y] of S.edit?.marks ?? []) top.append(sv('path', { class: 'm-cross', d: `M${x - 8 / k} ${-y}H${x + 8 / k}M${x} ${-y - 8 / k}V${-y + 8 / k}`, 'stroke-width': 2 / k }));
  if (S.edit?.ghost) {
    for (const polygon of S.edit.ghost.polygons) top.append(sv('path', { class: `m-ghost${S.edit.wrong ? ' wrong' : ''}`, d: Z(polygon), 'stroke-width': 2 / k }));
    for (const line of S.edit.snaps ?? []) top.append(sv('path', { class: 'm-snap', d: P(line), 'stroke-width': 1 / k }));
    for (const [x, y, words] of S.edit.sizes ?? []) top.append(tag(x, y, words, 'know'));
  }
  if (S.robot?.pose && S.robot.map === d.map && S.asOf === null) {
    const { x, y } = S.robot.pose, r = Math.max(14 / k, S.state?.profile?.radius ?? 25);
    top.append(robot(S.robot, S.linked !== 'yes')); taken.push([x - r, -y - r, x + r, -y + r]);
    const held = (d.carried ?? []).filter((thing) => thing.by === '');
    if (held.length && S.layers.belief) top.append(tag(x, y + r + 16 / k, held.map(N).join(', '), 'belief'));
  }
  return [g, top];
}
/** Lines from what is selected to what it stands in a relation to, each with the word for it where that has room. */
const MOST_RELATED = 14;
function related(chosen, g, top, taken) {
  const k = view.k, [x, y] = middle(chosen), others = new Map(), boxes = [];
  for (const { relation, args } of S.thing.relations) for (const other of args) {
    // In which room a thing stands is to be seen.
    if (typeof other !== 'string' || other === chosen.name || !named(other) || (chosen.on_map && named(other).frame)) continue;
    if (!others.has(other)) others.set(other, new Set());
    others.get(other).add(relation.toLowerCase().replaceAll('_', ' ').replace(/^находится /, ''));
  }
  const all = [...others].map(([name, words]) => ({ one: named(name), words: [...words], at: middle(named(name)) }));
  const far = ({ at }) => Math.hypot(at[0] - x, at[1] - y);
  // What a room has to do with is in it or at its walls.
  const [l, t, r, b] = boxOf(chosen), around = [l - 60, t - 60, r + 60, b + 60], near = ({ one }) => !chosen.frame || meets(boxOf(one), around);
  for (const { one, words, at: [ox, oy] } of all.filter(near).sort((a, b) => far(a) - far(b)).slice(0, MOST_RELATED)) {
    g.append(sv('path', { class: 'm-rel', d: P([[x, y], [ox, oy]]), 'stroke-width': 1.5 / k }), sv('circle', { class: 'm-reldot', cx: ox, cy: -oy, r: 3.5 / k }, sv('title', null, `${N(one)}: ${words.join(', ')}`)));
    const said = words.sort((a, b) => a.length - b.length)[0] + (words.length > 1 ? ` +${words.length - 1}` : ''), w = said.length * 6 / k, h = 14 / k;
    for (const along of [0.5, 0.65, 0.35]) {
      const [tx, ty] = [x + (ox - x) * along, -(y + (oy - y) * along)], box = [tx - w / 2, ty - h / 2, tx + w / 2, ty + h / 2];
      if (Math.hypot(ox - x, oy - y) * k < 46 || boxes.some((other) => meets(other, box))) continue;
      boxes.push(box); taken.push(box); top.append(text(tx, ty, said, 'm-rellab', 11)); break;
    }
  }
}
/** What a reason was measured by, where that was: lines with their lengths. */
function measured(d, top) {
  const k = view.k, tags = [];
  for (const { map, ends: [a, b], length_cm: cm, fails } of S.measures) {
    if (map !== d.map) continue;
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]], l = Math.hypot(dx, dy), cls = fails ? ' bad' : '';
    if (l * k > 3) {
      const [nx, ny] = [(-dy / l) * 6 / k, (dx / l) * 6 / k], end = ([x, y]) => P([[x + nx, y + ny], [x - nx, y - ny]]);
      top.append(sv('path', { class: 'm-halo', d: P([a, b]), 'stroke-width': 5 / k }), sv('path', { class: `m-measure${cls}`, d: P([a, b]) + end(a) + end(b), 'stroke-width': 1.8 / k }));
    } else top.append(sv('circle', { class: `m-measure${cls}`, cx: a[0], cy: -a[1], r: 4 / k, 'stroke-width': 1.8 / k }));
    // Where two would lie over each other, the later one goes below.
    let [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2 - (l * k > 90 ? 0 : 18 / k)];
    while (tags.some(([tx, ty]) => Math.abs(tx - x) < 80 / k && Math.abs(ty - y) < 24 / k)) y -= 25 / k;
    tags.push([x, y]); top.append(tag(x, y, exact(cm), fails ? 'bad' : 'know'));
  }
}
/** What would open a way that there is not. */
function remedy(g, top) {
  const { remedy: what, way: lead } = S.barred, k = view.k, done = [];
  const mark = (name, words) => { const one = named(name); if (one && !done.includes(one)) { done.push(one); g.append(sv('rect', { class: 'm-cure', ...rect(boxOf(one), 5 / k), 'stroke-width': 2.4 / k })); const [x, y] = middle(one); top.append(tag(x, y, words, 'cure')); } return one; };
  if (lead) g.append(way(lead, 'm-planned'));
  if (!what) return;
  for (const name of what.open ?? []) mark(name, L('открыть', 'open'));
  if (what.shut) mark(what.shut.of ?? what.shut.door, L('закрыть', 'shut'));
  for (const name of what.remove ?? []) mark(name, L('убрать', 'take away'));
  if (what.move) {
    const one = mark(what.move.thing, L('подвинуть', 'push')), [dx, dy] = what.move.by;
    if (one?.polygons) { for (const polygon of one.polygons) g.append(sv('path', { class: 'm-cure', d: Z(polygon.map(([x, y]) => [x + dx, y + dy])), 'stroke-width': 2 / k })); const [x, y] = middle(one); g.append(sv('path', { class: 'm-cureway', d: P([[x, y], [x + dx, y + dy]]), 'stroke-width': 2 / k })); }
  }
}
const rect = (b, grown = 0) => ({ x: b[0] - grown, y: b[1] - grown, width: b[2] - b[0] + 2 * grown, height: b[3] - b[1] + 2 * grown });

/** What is left of a leg from where the robot is. */
function rest(points) {
  const { x, y } = S.robot.pose; let best = 1, near = Infinity;
  for (let i = 1; i < points.length; i += 1) {
    const [a, b] = [points[i - 1], points[i]], l = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2 || 1;
    const t = Math.max(0, Math.min(1, ((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])) / l));
    const away = Math.hypot(a[0] + t * (b[0] - a[0]) - x, a[1] + t * (b[1] - a[1]) - y);
    if (away <= near) { near = away; best = i; }
  }
  return [[x, y], ...points.slice(best)];
}

/** Draws in the next frame, however often it is asked. */
export function paint() {
  if (waiting || document.hidden) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; draw(); });
}

function draw() {
  const svg = $('#map'), d = S.drawing, canvas = $('.canvas');
  view.w = canvas.clientWidth; view.h = canvas.clientHeight;
  svg.setAttribute('viewBox', `${view.x} ${view.y} ${view.w / view.k} ${view.h / view.k}`);
  if (!d) { svg.replaceChildren(); built = null; drawPicture(); return; }
  drawPicture();
  fetchAround(d);
  if (S.follow && S.robot?.pose && S.robot.map === d.map) centre(S.robot.pose.x, S.robot.pose.y);
  const key = JSON.stringify([S.layers, S.lang, Boolean(S.floor)]), lod = detail(), box = inView();
  const fits = built && built.d === d && built.key === key && built.lod === lod && box[0] >= built.box[0] && box[1] >= built.box[1] && box[2] <= built.box[2] && box[3] <= built.box[3];
  if (!fits) { const around = inView(1); built = { d, key, lod, box: around, g: ground(d, around, lod) }; }
  const taken = [], bold = [], [below, top] = overlay(d, taken, bold);
  const edited = S.edit?.ghost ? built.g.querySelector(`[data-name="${CSS.escape(S.edit.ghost.name)}"]`) : null;
  built.g.querySelectorAll('.dimmed').forEach((one) => one.classList.remove('dimmed'));
  edited?.classList.add('dimmed');
  svg.replaceChildren(built.g, below, labels(d, taken, bold), top);
  const nothing = !d.rooms.some((room) => meets(boxOf(room), box));
  if (nothing !== empty) { empty = nothing; document.body.dataset.empty = String(nothing); }
  scale();
}
let empty = false;

/** Of a large storey, the things and doors in view are asked for, in squares; those far away are dropped. */
const SQUARE = 2000;
async function fetchAround(d) {
  if (!d.is_part || detail() === 0) return;
  d.squares ??= new Map();
  const [l, t, r, b] = inView(0.5).map((value) => value / SQUARE), wanted = [];
  for (let x = Math.floor(l); x <= Math.floor(r); x += 1) for (let y = Math.floor(-b); y <= Math.floor(-t); y += 1) wanted.push(`${x},${y}`);
  if (wanted.length > 40) return;
  const missing = wanted.filter((square) => !d.squares.has(square));
  if (!missing.length) return;
  for (const square of missing) d.squares.set(square, null);
  await Promise.all(missing.map(async (square) => {
    const [x, y] = square.split(',').map(Number);
    const part = await ask('/api/drawing', { map: d.map, box: [x, y, x + 1, y + 1].map((n) => n * SQUARE).join(',') }).catch(() => null);
    if (part) d.squares.set(square, part); else d.squares.delete(square);
  }));
  if (d !== S.drawing) return;
  const near = new Set(wanted), far = [...d.squares.keys()].filter((square) => !near.has(square));
  for (const square of far.slice(0, Math.max(0, d.squares.size - 80))) d.squares.delete(square);
  const all = (sort) => [...new Map([...d.squares.values()].filter(Boolean).flatMap((part) => part[sort]).map((one) => [one.name ?? JSON.stringify(one.gap), one])).values()];
  d.things = all('things'); d.doors = all('doors');
  names([...d.things, ...d.doors]);
  d.index = undefined; built = null;
  paint();
}
function scale() {
  const bar = $('.scale'); if (!bar) return;
  const cm = [10, 20, 50, 100, 200, 500, 1000, 2000, 5000].find((c) => c * view.k > 60) ?? 10000;
  bar.firstChild.data = length(cm).replace(/[.,]0/, ''); bar.lastChild.style.width = `${cm * view.k}px`;
}

/** Fits a box, or the whole storey, into what is not covered by cards. */
export function fit(box) {
  const d = S.drawing; if (!d) return;
  box ??= d.rooms.map(boxOf).reduce((a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])], [Infinity, Infinity, -Infinity, -Infinity]);
  if (!Number.isFinite(box[0])) return;
  const canvas = $('.canvas'), w = canvas.clientWidth, h = canvas.clientHeight, small = w < 520;
  const card = $('.over .next, .over .edbar'), above = card ? card.offsetHeight + 24 : 20;
  const [l, t, r, b] = small ? [12, above, 56, 12] : [24, above, 66, 34];
  const k = Math.max(0.01, Math.min((w - l - r) / (box[2] - box[0]), (h - t - b) / (box[3] - box[1]), 4));
  Object.assign(view, { k, w, h, x: (box[0] + box[2]) / 2 - (l + (w - l - r) / 2) / k, y: (box[1] + box[3]) / 2 - (t + (h - t - b) / 2) / k });
  paint();
}
/** What is not on this storey, or not drawn, is shown by whoever can fetch it. */
export const beyond = { reveal() {} };
/** Shows a thing with what is around it. */
export function show(name) {
  const one = named(name); if (!one) { beyond.reveal(name); return; }
  const b = boxOf(one), grown = Math.max(120, (b[2] - b[0]) / 2);
  fit([b[0] - grown, b[1] - grown, b[2] + grown, b[3] + grown]);
}
export function centre(x, y) { view.x = x - view.w / view.k / 2; view.y = -y - view.h / view.k / 2; }
export function zoom(by, px = view.w / 2, py = view.h / 2) {
  const k = Math.min(12, Math.max(0.005, view.k * by));
  view.x += px / view.k - px / k; view.y += py / view.k - py / k; view.k = k; paint();
}
/** Where on the map a pointer is, cm. */
export function under(event) {
  const r = $('#map').getBoundingClientRect();
  return [view.x + (event.clientX - r.left) / view.k, -(view.y + (event.clientY - r.top) / view.k)];
}
