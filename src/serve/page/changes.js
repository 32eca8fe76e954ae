// What differs between two revisions, on the map: where things were and where they are, what came and what went.
import { S, L, N, ask, sv } from './base.js';
import { boxOf } from './map.js';

const SORTS = ['rooms', 'things', 'doors', 'zones', 'places'];
/** Without corners on a straight wall: a side that was cut in two is where it was. */
const bare = (points) => points.filter(([x, y], i) => {
  const [ax, ay] = points.at(i - 1), [bx, by] = points[(i + 1) % points.length];
  return Math.abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) > 0.05 * Math.hypot(bx - ax, by - ay);
});
const shape = (one) => JSON.stringify([one.polygons?.map(bare) ?? null, one.z ?? null, one.gap ?? null, one.at && !one.polygons ? one.at : null]);
const rest = ({ box, frame, m2, middle, rule, rule_en, in_force, polygons, rooms, leaves, arcs, opening, ...one }) => JSON.stringify(one);
const drawn = (revision) => ask('/api/drawing', { map: S.map, ...(revision === S.state.revision ? {} : { as_of: revision }) }).catch(() => null);

/** Compares the storey at two revisions, and has the map show it, where nothing else was asked for meanwhile. */
export async function compare(from, to, isNewest) {
  const map = S.map, [was, is] = await Promise.all([drawn(from), drawn(to)]);
  if (S.map !== map || !was || !is || !isNewest()) return;
  const marks = [];
  for (const sort of SORTS) {
    const before = new Map((was[sort] ?? []).filter((one) => one.id).map((one) => [one.id, one]));
    for (const one of is[sort] ?? []) {
      if (!one.id) continue;
      const old = before.get(one.id);
      before.delete(one.id);
      if (!old) marks.push({ fate: 'new', is: one });
      else if (shape(old) !== shape(one)) marks.push({ fate: 'moved', was: old, is: one });
      else if (rest(old) !== rest(one)) marks.push({ fate: 'changed', was: old, is: one });
    }
    for (const old of before.values()) marks.push({ fate: 'gone', was: old });
  }
  S.changes = { map, from, to, marks };
}

/** What came of a comparison, counted. */
export function told() {
  const count = (fate) => S.changes.marks.filter((mark) => mark.fate === fate).length;
  const parts = [['new', L('новых', 'new')], ['gone', L('убрано', 'gone')], ['moved', L('сдвинуто', 'moved')], ['changed', L('изменено', 'changed')]];
  const some = parts.map(([fate, word]) => [count(fate), word]).filter(([n]) => n);
  const span = L(`Ревизии ${S.changes.from} → ${S.changes.to}`, `Revisions ${S.changes.from} → ${S.changes.to}`);
  return `${span}: ${some.length ? some.map(([n, word]) => `${word} ${n}`).join(', ') : L('на этом этаже то же', 'the same on this storey')}`;
}

const outline = (one) => {
  const path = (points, ends = 'z') => `M${points.map(([x, y]) => `${x} ${-y}`).join('L')}${ends}`;
  if (one.polygons) return one.polygons.map((points) => path(points)).join('');
  if (one.gap) { const [a, b] = one.gap; return path([a[0], b[0], b[1], a[1]]); }
  const [x, y] = one.at;
  return path([[x - 6, y - 6], [x + 6, y - 6], [x + 6, y + 6], [x - 6, y + 6]]);
};
const middle = (one) => { const b = boxOf(one); return [(b[0] + b[2]) / 2, (b[1] + b[3]) / 2]; };

/** The marks of what differs, as an overlay of `k` pixels a cm. */
export function overlay(k) {
  const g = sv('g', { class: 'changes' });
  if (S.changes?.map !== S.map) return g;
  for (const { fate, was, is } of S.changes.marks) {
    const words = { new: L('новое', 'new'), gone: L('убрано', 'gone'), moved: L('сдвинуто', 'moved'), changed: L('изменено', 'changed') }[fate];
    const title = () => sv('title', null, `${N(is ?? was) || L('проём', 'opening')}: ${words}`);
    if (was && fate !== 'changed') g.append(sv('path', { class: `m-past${fate === 'gone' ? ' gone' : ''}${was.frame ? ' room' : ''}`, d: outline(was), 'stroke-width': 2 / k }, title()));
    if (is) g.append(sv('path', { class: `m-next ${fate}`, d: outline(is), 'stroke-width': 2 / k }, title()));
    if (fate === 'moved') { const [a, b] = [middle(was), middle(is)]; g.append(sv('path', { class: 'm-moved', d: `M${a[0]} ${a[1]}L${b[0]} ${b[1]}`, 'stroke-width': 1.6 / k })); }
  }
  return g;
}
