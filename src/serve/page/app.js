// The page put together: what is heard from the server, what the operator does, and what is drawn anew for it.
import { S, L, N, I, $, el, api, ask, announce, length, names, may, reasons, Gone, Refused } from './base.js';
import { connect, refresh } from './link.js';
import { beyond, centre, fit, named, paint, show, under, view, zoom } from './map.js';
import { note, reason, renderLog, renderTalk, send } from './talk.js';
import { body, card, ending, verdict } from './panels.js';
import { compare } from './changes.js';
import * as edit from './edit.js';
import * as picture from './picture.js';
import * as tools from './tools.js';

const TABS = [['talk', 'talk', 'Разговор', 'Talk'], ['task', 'task', 'Задание', 'Task'], ['thing', 'thing', 'Вещь', 'Thing'], ['map', 'map', 'Карта', 'Map']];
const wide = () => innerWidth > 1279;

/* what is drawn */
function render(anew = false) {
  const root = document.documentElement;
  root.lang = S.lang; root.dataset.theme = S.theme; document.body.dataset.tab = S.tab;
  document.body.dataset.past = String(S.asOf !== null);
  document.body.classList.toggle('tall', S.tab !== 'talk');
  document.title = `${L('Пульт', 'Console')} – orthoframe`;
  $('.skip').textContent = L('К строке разговора', 'To the line of talk');
  $('#map').setAttribute('aria-label', L('План этажа. Стрелки двигают, плюс и минус меняют масштаб, 0 показывает всё. Словами то же – на вкладке «Вещь».', 'Plan of the storey. Arrows pan, plus and minus zoom, 0 fits. The same in words: tab Thing.'));
  bar(); side(anew); over(); time(); phone();
}
function stopButton(cls = '') {
  const off = S.linked !== 'yes';
  const text = S.stopping ? L('посылаю…', 'sending…') : L('Стоп', 'Stop');
  return el('button', { class: `stop ${cls}`, type: 'button', onclick: stop, 'aria-keyshortcuts': 'Control+.' }, I('stop'), el('span', null, text), off ? el('span', { class: 'vh' }, L(', связи нет', ', no link')) : null, ' ', el('kbd', null, 'Ctrl .'));
}
function bar() {
  const [words, cls] = S.linked === 'begin' ? ['…', 'warn'] : S.linked !== 'yes' ? [L('связи нет', 'no link'), 'bad'] : S.stopping ? [L('останавливается', 'stopping'), 'warn'] : S.task ? [L('едет', 'driving'), 'go'] : [L('стоит, готов', 'idle, ready'), ''];
  const lease = S.lease ? (S.lease.session === S.state?.session ? L('управляете вы', 'you drive') : L(`управляет ${S.lease.holder}`, `${S.lease.holder} drives`)) : '';
  $('.bar').replaceChildren(
    el('h1', { class: 'brand' }, mark(), el('span', { class: 'w' }, 'orthoframe'), el('small', null, S.state ? N(S.state) || L('карты нет', 'no map') : '')),
    el('div', { class: 'live', role: 'status' }, el('span', { class: `dot ${cls}` }), el('span', null, words), lease ? el('span', { class: 'long lease' }, `· ${lease}`) : null), el('span', { class: 'sp' }),
    el('div', { class: 'seg lang', role: 'group', 'aria-label': L('Язык', 'Language') }, [['ru', 'РУ', 'Русский'], ['en', 'EN', 'English']].map(([lang, text, name]) => el('button', { type: 'button', lang, 'aria-pressed': String(S.lang === lang), 'aria-label': `${text}, ${name}`, onclick: () => { S.lang = lang; keep(); renderTalk(talkers); render(); paint(); if (S.selected) select(S.selected); } }, text))),
    el('button', { class: 'ib', type: 'button', 'aria-label': L('Светлая или тёмная', 'Light or dark'), onclick: () => { S.theme = S.theme === 'dark' ? 'light' : 'dark'; keep(); render(); } }, I(S.theme === 'dark' ? 'sun' : 'moon')), stopButton());
}
const mark = () => { const icon = I('room'); icon.classList.add('mark'); return icon; };
function side(anew = false) {
  const current = S.tab === 'talk' && wide() ? 'task' : S.tab;
  const had = document.activeElement, id = had?.id, within = $('.body').contains(had) && !id, at = within ? [...$('.body').querySelectorAll('button,input')].indexOf(had) : -1;
  // Who fills in a form goes on; what is said of it is drawn anew.
  if (!anew && had?.closest?.('.draft') && $('.body').contains(had)) $('#verdict')?.replaceChildren(...[verdict(acts)].flat(4).filter(Boolean));
  else if (!(id === 'newname' || had?.type === 'search') || S.edit?.asking?.fresh) {
    const scroll = $('.body').scrollTop;
    $('.body').replaceChildren(...[body(S.tab, acts)].flat(4).filter(Boolean));
    $('.body').scrollTop = scroll;
    // Focus is not lost when a panel is drawn anew.
    if (id && $('.body').querySelector(`#${id}`)) $(`#${id}`).focus();
    else if (at >= 0) ([...$('.body').querySelectorAll('button,input')][at] ?? $('.body')).focus();
  }
  $('.tabs').replaceChildren(...TABS.map(([name, icon, ru, en]) => el('button', { role: 'tab', type: 'button', class: `t-${name}`, id: `tab-${name}`, 'aria-selected': String(name === current), 'aria-controls': 'panel', tabindex: name === current ? '0' : '-1', onclick: () => { S.tab = name; render(); $(`#tab-${name}`).focus(); if (name === 'map') history(); } }, I(icon), el('span', null, L(ru, en)), name === 'map' && S.proposals.length + S.edits.length ? el('span', { class: 'badge', 'aria-label': L('поправок', 'proposals') }, String(S.proposals.length)) : null)));
  if (id?.startsWith('tab-')) $(`#${id}`)?.focus();
}
function over() {
  const tool = (icon, text, pressed, work, cls = '') => el('button', { class: `ib ${cls}`, type: 'button', 'aria-label': text, title: text, 'aria-pressed': pressed === null ? null : String(pressed), onclick: work }, I(icon));
  const maps = S.state?.maps ?? [], parts = [];
  if (S.state?.missing?.includes('map')) parts.push(el('div', { class: 'card empty' }, el('h2', { class: 'title' }, L('Карты нет', 'There is no map')), el('p', null, L('Хранилище пусто. Прочтите в него здание и перезапустите:', 'The store is empty. Read a building into it and start again:')), el('p', { class: 'mono' }, 'ortho import FILE'), el('p', { class: 'mono' }, 'ortho serve --demo')));
  else if (S.drawing && !S.drawing.rooms.length) parts.push(el('div', { class: 'card empty' }, el('h2', { class: 'title' }, L('На этом этаже нет помещений', 'This storey has no rooms')), el('p', null, may('edit') ? L('Начертите первое: правка, «Помещение».', 'Draw the first one: edit, “Room”.') : L('Начертить их может тот, кто правит.', 'Whoever edits can draw them.')), may('edit') && !S.edit ? el('div', { class: 'btns' }, el('button', { class: 'btn pri', type: 'button', onclick: () => { edit.toggle(); tools.take('room'); } }, L('Начертить помещение', 'Draw a room'))) : null));
  else {
    parts.push(el('div', { class: 'card nowhere', role: 'status' }, el('span', null, L('Здесь ничего нет: план в стороне.', 'There is nothing here: the plan lies elsewhere.')), el('button', { class: 'btn', type: 'button', onclick: () => fit() }, L('Показать всё', 'Show all'), ' ', el('kbd', null, '0'))));
    if (S.state?.missing?.includes('robot')) parts.push(el('div', { class: 'card lacks' }, L('Карта не говорит, где стоит робот: назовите его место (start) в файле карты, и он поедет.', 'The map does not say where the robot stands: name its place (start) in the map file, and it will drive.')));
    if (going) parts.push(el('div', { class: 'card lacks', role: 'status' }, L('Щёлкните, куда ехать; с клавиатуры – подведите стрелками крест в середине карты и нажмите Enter. Esc – не ехать.', 'Click where to drive; by the keyboard, bring the spot beneath the cross with the arrows and press Enter. Esc: do not drive.')), el('div', { class: 'cross', 'aria-hidden': 'true' }));
    if (S.map && !S.drawing && S.linked === 'yes') parts.push(el('div', { class: 'card lacks' }, L('План загружается…', 'The plan is being fetched…')));
  }
  const now = S.edit && S.asOf === null ? editBar() : card(acts);
  if (now) parts.push(now);
  parts.push(el('div', { class: 'card tools' }, may('drive') ? tool('pin', L('Ехать туда, куда щёлкну (G)', 'Drive where I click (G)'), going, () => { going = !going; over(); }) : null, may('edit') ? tool('pen', L('Править (E)', 'Edit (E)'), Boolean(S.edit), edit.toggle) : null, tool('layers', L('Слои (L)', 'Layers (L)'), open, () => { open = !open; over(); }), tool('why', L('Клавиши (?)', 'Keys (?)'), keysShown, () => { keysShown = !keysShown; over(); }, 'opt')));
  if (open) parts.push(layers());
  if (keysShown) parts.push(keyCard());
  if (maps.length > 1) parts.push(el('div', { class: 'card storeys', role: 'group', 'aria-label': L('Этаж', 'Storey') }, maps.slice().reverse().map((map, i) => el('button', { type: 'button', 'aria-pressed': String(map.name === S.map), 'aria-label': N(map), title: N(map), class: S.robot?.map === map.name ? 'here' : '', onclick: () => storey(map.name) }, String(maps.length - i)))));
  parts.push(el('div', { class: 'card zoom' }, tool('follow', L('За роботом (F)', 'Follow the robot (F)'), S.follow, follow), tool('fit', L('Показать всё (0)', 'Fit (0)'), null, () => fit()), tool('plus', L('Крупнее', 'Zoom in'), null, () => zoom(1.4), 'z'), tool('minus', L('Мельче', 'Zoom out'), null, () => zoom(1 / 1.4), 'z')));
  parts.push(el('div', { class: 'scale', 'aria-hidden': 'true' }, ' ', el('i')));
  if (S.toast) parts.push(el('div', { class: 'card toast' }, el('span', null, S.toast), may('edit') ? el('button', { class: 'btn', type: 'button', onclick: () => { S.toast = null; acts.undo(); } }, I('undo'), L('Отменить', 'Undo')) : null, el('button', { class: 'btn', type: 'button', 'aria-label': L('Закрыть', 'Close'), onclick: () => { S.toast = null; over(); } }, I('x'))));
  const had = document.activeElement?.closest?.('.over') ? document.activeElement.getAttribute('aria-label') : null;
  $('.over').replaceChildren(...parts);
  $('.canvas').classList.toggle('aiming', going);
  if (had) [...$('.over').querySelectorAll('button')].find((one) => one.getAttribute('aria-label') === had)?.focus();
  paint();
}
let open = false;
/** The next click on the map says where to drive. */
let going = false;
let keysShown = false;
function keyCard() {
  const all = [['/', 'спросить или приказать', 'ask or order'], ['Enter · Esc', 'ехать или записать · отказаться', 'drive or write · decline'], ['Ctrl .', 'стоп, откуда угодно', 'stop, from anywhere'], ['← ↑ → ↓  + −  0', 'двигать план, крупнее, мельче, весь', 'pan, zoom, fit'], ['F  G', 'за роботом; ехать сюда', 'follow; drive here'], ['L  [  ]', 'слои; этаж ниже, выше', 'layers; storey down, up'], ['E', 'править', 'edit'], ['← ↑ → ↓  R', 'двигать на 1 см (Shift: 10), повернуть', 'move 1 cm (Shift: 10), turn'], ['Ctrl Z · Ctrl Shift Z', 'отменить · вернуть', 'undo · redo'], ['Tab', 'к следующему', 'to the next']];
  return el('div', { class: 'card layers keys' }, el('h2', null, L('Клавиши', 'Keys')), el('dl', { class: 'kv' }, all.map(([key, ru, en]) => [el('dt', null, el('kbd', null, key)), el('dd', null, L(ru, en))])));
}
function layers() {
  const one = (name, ru, en, cls) => el('label', null, el('input', { type: 'checkbox', checked: S.layers[name], onchange: async (event) => { S.layers[name] = event.target.checked; if (['frames', 'dead', 'network'].includes(name) && event.target.checked) await floor(); paint(); } }), L(ru, en), cls ? el('span', { class: `sw ${cls}` }) : null);
  return el('div', { class: 'card layers' }, el('h2', null, L('Слои', 'Layers')), one('names', 'Имена', 'Names'), one('things', 'Вещи', 'Things', 'sw-thing'), one('places', 'Места', 'Places'), one('zones', 'Зоны', 'Zones', 'sw-zone'), one('belief', 'Что в руке и что не на месте', 'Carried, and believed elsewhere', 'sw-belief'), one('frames', 'Пассфреймы', 'Passframes', 'sw-frame'), one('dead', 'Мёртвые зоны', 'Dead zones', 'sw-dead'), one('network', 'Сеть', 'Network', 'sw-net'), one('relations', 'Отношения выбранного', 'Relations of what is selected', 'sw-rel'));
}
function editBar() {
  const tb = (icon, text, work, more = {}) => el('button', { class: 'tb s', type: 'button', onclick: work, 'aria-label': text, title: text, ...more }, I(icon), el('span', null, text));
  const { edit: now } = S, tool = (name, icon, ru, en) => tb(icon, L(ru, en), () => tools.take(name), { 'aria-pressed': String(now.tool === name) });
  return el('div', { class: 'card edbar', role: 'toolbar', 'aria-label': L('Правка', 'Editing') },
    tool('thing', 'thing', 'Вещь', 'Thing'), tool('point', 'pin', 'Место', 'Place'), tool('room', 'room', 'Помещение', 'Room'), tool('door', 'door', 'Дверь', 'Door'), tool('zone', 'zone', 'Зона', 'Zone'), tool('plan', 'img', 'Рисунок', 'Picture'),
    tb('lock', L('Форма заперта', 'Shape locked'), () => { tools.take('shape'); if (S.edit.tool === 'shape' && S.selected) tools.choose(S.selected); }, { 'aria-pressed': String(now.tool !== 'shape') }), el('hr'),
    tb('undo', L('Отменить', 'Undo'), acts.undo), tb('redo', L('Вернуть', 'Redo'), acts.redo),
    now.kind === 'thing' ? [el('hr'), tb('turn', L('Повернуть', 'Turn'), () => edit.nudge(0, 0, 15)), tb('plus', L('Ещё такую', 'One more'), () => { S.tab = 'map'; edit.add(); }), tb('x', L('Убрать', 'Remove'), () => { S.tab = 'map'; edit.remove(); })] : null,
    now.draft && !now.draft.closed && now.draft.points.length > 2 && now.tool !== 'door' ? [el('hr'), tb('check', L('Замкнуть', 'Close'), () => tools.close())] : null,
    now.steps ? [el('hr'), tb('check', L('Записать', 'Write'), acts.write, { disabled: Boolean(now.wrong) })] : null,
    el('hr'), tb('x', L('Закончить', 'Finish'), () => { S.edit = null; render(); paint(); }));
}
function time() {
  const last = S.state?.revision ?? 0, at = S.asOf ?? last;
  const old = $('.time input');
  if (old && document.activeElement === old) { old.max = last; $('.time .lab b').textContent = S.asOf === null ? L('Сейчас', 'Now') : L('Прошлое', 'The past'); $('.time .lab span').textContent = L(`ревизия ${at}`, `revision ${at}`); return; }
  $('.time').replaceChildren(el('div', { class: 'lab' }, el('b', null, S.asOf === null ? L('Сейчас', 'Now') : L('Прошлое', 'The past')), el('span', null, L(`ревизия ${at}`, `revision ${at}`))),
    el('div', { class: 'track' }, el('input', { type: 'range', min: last < 2 ? 0 : 1, max: Math.max(1, last), value: at, disabled: last < 2, 'aria-label': L('Карта на ревизии', 'The map at revision'), oninput: (event) => asOf(Number(event.target.value)) })),
    S.asOf === null ? el('span', { class: 'num' }, L(`правок ${last}`, `revisions ${last}`)) : el('button', { class: 'btn', type: 'button', onclick: acts.now }, L('К настоящему', 'Back to now')));
}
function phone() { $('.phone').replaceChildren(stopButton('pstop')); }

/* what is asked of the server */
let drawn = 0;
async function draw() {
  const number = ++drawn;
  if (!S.map) return;
  const values = { map: S.map, most: 4000 };
  if (S.asOf !== null) values.as_of = S.asOf;
  try {
    const drawing = await ask('/api/drawing', values);
    if (number !== drawn) return;
    const first = !S.drawing || S.drawing.map !== drawing.map;
    S.drawing = drawing;
    names([...drawing.rooms, ...drawing.things, ...drawing.doors, ...drawing.places, ...drawing.zones, ...drawing.carried]);
    if (first) picture.recall();
    if (S.floor?.revision !== drawing.revision) S.floor = null;
    if (S.layers.frames || S.layers.dead || S.layers.network) await floor();
    if (first) fit(); else paint();
    if (S.selected && !S.edit) select(S.selected, false);
    document.body.dataset.ready = 'yes';
  } catch (error) { S.toast = reason(error); over(); }
}
async function floor() { if (!S.floor) { S.floor = await ask('/api/floor', { map: S.map }).catch(() => null); paint(); } }
async function storey(name) { S.map = name; S.drawing = null; S.changes = null; S.barred = null; S.floor = null; S.follow = S.follow && S.robot?.map === name; await draw(); over(); }
async function history() {
  const told = new Map(S.history.map((one) => [one.revision, one.told]));
  const [all, proposals, edits] = await Promise.all([api('/api/history').catch(() => null), api('/api/proposals').catch(() => null), api('/api/edits').catch(() => null)]);
  if (edits) S.edits = edits.edits;
  if (all) S.history = all.revisions.map((one) => ({ ...one, told: told.get(one.revision) }));
  if (proposals) S.proposals = proposals.proposals;
  side();
}
// Counts what is looked back at: what was asked for before the newest shows nothing any more.
let looked = 0;
async function compared(from, to) {
  const mine = ++looked;
  if (from === null) S.changes = null;
  else await compare(from, to, () => mine === looked);
  if (mine === looked) { over(); paint(); }
}
async function asOf(revision) {
  const mine = ++looked;
  S.asOf = revision >= S.state.revision ? null : revision; S.changes = null;
  render(); await draw();
  if (S.asOf === null) return;
  // What has become of it since is marked when the slider rests.
  await new Promise((done) => { setTimeout(done, 400); });
  if (mine !== looked || S.asOf === null) return;
  await compare(S.asOf, S.state.revision, () => mine === looked);
  if (mine === looked) { over(); paint(); }
}
async function everything() {
  await refresh();
  S.map ??= S.robot?.map ?? S.state.maps[0]?.name ?? null;
  renderLog(); render(); await draw(); history();
}

/* what the operator does */
async function select(name, open = true) {
  if (S.selected !== name) reasons();
  S.selected = name; S.marked = []; S.barred = null;
  const thing = name ? await ask('/api/thing', { name, lang: S.lang }).catch(() => null) : null;
  if (S.selected !== name) return;
  S.thing = thing; S.reason = null;
  if (S.edit?.tool === 'shape' && named(name)?.frame) tools.choose(name);
  else if (S.edit && !S.edit.tool && name && !S.edit.steps) edit.choose(name);
  if (open && name) S.tab = S.edit ? 'map' : 'thing';
  if (name && S.thing) announce(`${N(S.thing)}`);
  render();
}
async function stop() {
  S.stopping = Boolean(S.task); S.plan = null; bar(); phone();
  try { await api('/api/stop', {}); } catch (error) { S.stopping = false; announce(L('Стоп не послан', 'The stop was not sent'), true); S.toast = L('Стоп не послан: ', 'The stop was not sent: ') + reason(error); }
  render();
}
function follow() { S.follow = !S.follow; if (S.follow && S.robot && S.robot.map !== S.map) storey(S.robot.map); over(); }
async function attempt(work) {
  try { return await work(); } catch (error) { S.toast = reason(error); announce(S.toast, true); over(); return null; }
}
const change = (path, more = {}) => attempt(() => api(path, { on: S.state.revision, ...more }));

const acts = {
  confirm: async () => {
    const plan = S.plan; if (!plan) return;
    // Before it is sent: its answer may come after the robot has been stopped.
    S.plan = null; S.stoppedBy = null; S.barred = null; render();
    try { await api(`/api/tasks/${plan.task}/confirm`, {}); } catch (error) {
      if (error instanceof Refused && error.body.task) { S.plan = error.body.task; note({ q: plan.text, cls: 'order', lines: [error.message] }); } else { note({ q: plan.text, cls: 'bad', lines: [reason(error)] }); }
      render();
    }
  },
  decline: () => { const plan = S.plan; S.plan = null; render(); if (plan) attempt(() => api(`/api/tasks/${plan.task}/cancel`, {})); },
  later: async () => {
    const plan = S.plan; if (!plan) return;
    S.plan = null; render();
    if (await attempt(() => api('/api/later', { text: plan.text }))) note({ q: plan.text, cls: 'order', lines: [L('Отложено: ждёт в очереди.', 'Put off: it waits in the queue.')] });
  },
  cleared: (isClear) => { const { task } = S.task; return attempt(() => api(`/api/tasks/${task}/cleared`, { is_clear: isClear })); },
  pause: () => attempt(() => api('/api/pause', {})),
  resume: (task = null) => { S.stoppedBy = null; render(); return attempt(() => api('/api/resume', { task })); },
  shortest: () => attempt(() => api('/api/shortest', {})),
  favourite: (text) => { S.favourites = S.favourites.includes(text) ? S.favourites.filter((one) => one !== text) : [...S.favourites, text].slice(-30); keep(); side(); },
  barred: (told) => { S.barred = told; over(); paint(); },
  way: async (thing) => {
    const way = await attempt(() => ask('/api/route', { to: thing.name, lang: S.lang }));
    if (way) acts.shown(way, N(thing));
  },
  shown: (way, whither) => {
    const legs = way.legs ?? [way], here = legs.find((leg) => leg.map === S.map);
    if (way.outcome === 'route') {
            note({ q: L(`Путь: ${whither}`, `The way: ${whither}`), lines: [`${length(way.length_cm)}${way.opens?.length ? L(`; открыть: ${way.opens.map(N).join(', ')}`, `; to be opened: ${way.opens.map(N).join(', ')}`) : ''}`] });
      if (way.opens?.length) S.barred = { title: L(`До «${whither}» – ${length(way.length_cm)}, если открыть`, `To ${whither}: ${length(way.length_cm)}, with doors opened`), text: way.opens.map(N).join(', '), remedy: { open: way.opens }, way: here?.points ?? null, is_way: true };
      else S.barred = { title: `${whither}: ${length(way.length_cm)}`, text: '', remedy: null, way: here?.points ?? null, is_way: true };
    } else {
      S.barred = { title: L(`До «${whither}» не проехать`, `There is no way to ${whither}`), text: [way.explanation, way.advice].filter(Boolean).map((text) => `${text.charAt(0).toUpperCase()}${text.slice(1).replace(/[.]$/, '')}.`).join(' '), remedy: way.remedy ?? null };
      announce([S.barred.title, S.barred.text].join('. '), true);
    }
    over(); paint();
  },
  whyNot: async (relation, other) => {
    const of = [S.selected, other];
    const found = await attempt(() => ask('/api/why', { relation, of: of.join(','), lang: S.lang }));
    if (!found) return;
    reasons(found.about, found.measures); S.marked = [];
    note({ q: L(`Почему ${found.holds ? '' : 'не '}так: ${relation.toLowerCase().replaceAll('_', ' ')} (${of.map(N).join(', ')})?`, `Why ${found.holds ? '' : 'not '}${relation.toLowerCase().replaceAll('_', ' ')} (${of.map(N).join(', ')})?`), lines: [found.words, ...found.measures.map((m) => m.text).filter((text) => text && !found.words.includes(text))] });
    S.reason = { ...found, relation, other }; announce(found.words); side(true); paint();
  },
  compare: compared,
  judge: async (id, verdict) => { await change(`/api/edits/${encodeURIComponent(id)}`, { verdict }); history(); },
  shut: edit.shut, ends: edit.ends,
  cancel: (id) => attempt(() => api(`/api/tasks/${id}/cancel`, {})),
  move: (id, before) => attempt(() => api(`/api/tasks/${id}/move`, { before })),
  say: (text) => send(text),
  seen: () => { S.stoppedBy = null; render(); },
  now: () => asOf(S.state.revision),
  select: (name) => select(name),
  go: (thing) => send(L(`Поезжай к: ${thing.name}`, `Go to ${N(thing)}`)),
  edit: () => { if (!S.edit) edit.toggle(); S.tab = 'map'; render(); },
  turn: (by) => edit.nudge(0, 0, by), place: edit.put, add: edit.add, rename: edit.rename, remove: edit.remove, door: edit.door, write: async () => { await tools.flush(); await edit.write(); }, drop: edit.drop, onTop: edit.onTop,
  undo: async () => { const done = await change('/api/undo'); if (done) { S.toast = null; announce(L('Отменено', 'Undone')); } },
  redo: async () => { const done = await change('/api/redo'); if (done) announce(L('Возвращено', 'Redone')); },
  restore: async () => { if (await change('/api/restore', { revision: S.asOf })) asOf(Infinity); },
  decide: async (name, verdict) => { await change(`/api/proposals/${encodeURIComponent(name)}`, { verdict }); history(); },
  told: async (one) => { if (one.told) { one.told = null; compared(null); } else { if (one.revision > 1) compared(one.revision - 1, one.revision); const all = await attempt(() => ask('/api/diff', { from: one.revision - 1, to: one.revision })); one.told = all?.differences; } side(); },
  asOf: (revision) => asOf(revision),
  invite: async (role) => { const given = await attempt(() => api('/api/invite', { role, name: role })); if (given) { S.invited = `${location.origin}/?token=${given.token}`; side(); } },
};
const talkers = { select, confirm: acts.confirm, barred: async (reply) => {
  // What bars the way is shown where it stands.
  const target = (reply.goal ?? []).flatMap((fact) => fact.args).reverse().find((name) => named(name) || named(String(name).replace(/^Место-у-/, '')));
  if (!target) return;
  const way = await ask('/api/route', { to: target, lang: S.lang }).catch(() => null);
  if (way && way.outcome !== 'route') acts.shown(way, N(target));
}, planned: (task) => { S.plan = task; S.selected = null; if (wide()) S.tab = 'task'; render(); fit(); } };

/* what is heard */
const heard = {
  linked: (was) => { if (was === 'no') { announce(L('Связь есть', 'The link is back')); everything(); } render(); },
  lost: () => render(),
  gap: () => everything(),
  robot: (place) => {
    if (!place) return;
    if (S.robot?.map !== place.map && S.follow) storey(place.map);
    S.robot = place;
    const last = S.trail.at(-1), at = [place.pose.x, place.pose.y];
    if (!last || Math.hypot(last.at[0] - at[0], last.at[1] - at[1]) > 3) S.trail.push({ map: place.map, at });
    if (S.trail.length > 3000) S.trail.shift();
    paint();
  },
  task: (task) => {
    if (task.state === 'running') { S.task = task; S.step = 0; S.stoppedBy = null; S.trail = S.robot?.pose ? [{ map: S.robot.map, at: [S.robot.pose.x, S.robot.pose.y] }] : []; note({ q: task.text, cls: 'order', lines: [L('Поехали.', 'Under way.')] }); }
    else {
      if (S.task?.task === task.task) { S.task = null; S.stopping = false; }
      if (S.plan?.task === task.task) S.plan = null;
      S.ended = [...S.ended.filter((one) => one.task !== task.task), task].slice(-50);
      if (!['declined', 'cancelled'].includes(task.state)) { note({ q: task.text, cls: task.state === 'done' ? 'order' : 'bad', lines: [task.text_end || ending(task.state)] }); announce(task.text_end || ending(task.state), task.state !== 'done'); }
    }
    render();
  },
  directive: (event) => {
    if (event.event === 'planned' && S.task && !S.task.plan) { S.task = { ...S.task, plan: { events: [event], directives: event.steps.flat().map((step, i) => ({ ...step, number: i + 1, map: null, points: [], length_cm: 0, seconds: 0 })) } }; S.step = 0; }
    if (event.event === 'started') { S.step = Math.max(0, event.number - 1); announce(L(event.do_ru, event.do_en)); }
    else if (event.event === 'arrived' || event.event === 'done') { S.step = event.number; if (event.pose) S.robot = { map: event.map, pose: event.pose, ru: event.ru ?? S.robot?.ru, en: event.en ?? S.robot?.en }; }
    else if (event.event === 'surprised') note({ q: L('Замечено в пути', 'Noticed on the way'), cls: 'seen', lines: [L(event.explanation, event.explanation_en)] });
    else if (event.event === 'barred' && S.task) {
      if (!S.task.is_replayed) S.task = { ...S.task, barred: event };
      note({ q: L('Путь преграждён', 'The way is barred'), cls: 'seen', lines: [L(event.explanation, event.explanation_en)] });
      announce(L(event.explanation, event.explanation_en), true);
    }
    else if (event.event === 'answered' && S.task) S.task = { ...S.task, barred: null };
    else if (event.event === 'replanned' && S.task) {
      // The ways of the new plan are told as they are driven.
      const fresh = event.steps.flat().map((step, i) => ({ ...step, number: i + 1, map: null, points: [], length_cm: 0, seconds: 0 }));
      S.task = { ...S.task, plan: { ...S.task.plan, directives: fresh } }; S.step = 0;
      note({ q: L('План заново', 'Planned anew'), cls: 'seen', lines: [L(`Шагов ${fresh.length}.`, `${fresh.length} steps.`)] });
    }
    over(); if (S.tab !== 'thing' && !(S.edit && S.tab === 'map')) side();
  },
  queue: ({ tasks, paused }) => { S.queue = tasks; S.paused = paused; side(); over(); },
  proposed: () => history(),
  known: async () => { await refresh(); await draw(); history(); render(); },
  revision: async (revision) => {
    S.state.revision = revision.revision;
    if (S.edit && !S.edit.steps) S.edit.on = revision.revision;
    // What the word beside the map offers to undo is no longer the last.
    if (S.toast && S.written !== revision.revision) { S.toast = null; over(); }
    time(); if (S.asOf === null) await draw(); history();
    // What is edited may have moved under one's hands.
    if (S.edit?.name && !S.edit.steps) { if (S.edit.tool === 'shape') tools.choose(S.edit.name); else { edit.choose(S.edit.name); render(); } }
  },
  lease: (lease) => { S.lease = lease; bar(); },
  stop: () => { S.plan = null; render(); },
  stopped: (stopped) => { S.stopping = false; S.stoppedBy = stopped.by ?? '?'; announce(L('Остановлено', 'Stopped'), true); render(); },
};

/* the map under the hand */
const map = $('#map');
const pointers = new Map();
let gesture = null;
const nameAt = (event) => document.elementFromPoint(event.clientX, event.clientY)?.closest('[data-name]')?.dataset.name ?? null;
map.addEventListener('pointerdown', (event) => {
  if (event.button > 0) return;
  map.setPointerCapture(event.pointerId); pointers.set(event.pointerId, event); map.focus({ preventScroll: true });
  if (pointers.size === 2) { const [a, b] = [...pointers.values()]; gesture = { pinch: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY) }; return; }
  const name = nameAt(event);
  gesture = { x: event.clientX, y: event.clientY, vx: view.x, vy: view.y, name, moved: false, grabbed: S.asOf === null ? tools.grab(event, name) ?? picture.grab(event) ?? edit.grab(event, name) : null };
});
map.addEventListener('pointermove', (event) => {
  if (!pointers.has(event.pointerId) || !gesture) return;
  pointers.set(event.pointerId, event);
  if (gesture.pinch) {
    if (pointers.size < 2) return;
    const [a, b] = [...pointers.values()], away = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY), r = map.getBoundingClientRect();
    zoom(away / gesture.pinch, (a.clientX + b.clientX) / 2 - r.left, (a.clientY + b.clientY) / 2 - r.top); gesture.pinch = away; return;
  }
  if (!gesture.moved && Math.hypot(event.clientX - gesture.x, event.clientY - gesture.y) < 4) return;
  gesture.moved = true;
  if (gesture.grabbed) gesture.grabbed.move(event);
  else { S.follow = false; view.x = gesture.vx - (event.clientX - gesture.x) / view.k; view.y = gesture.vy - (event.clientY - gesture.y) / view.k; paint(); }
});
const up = (event) => {
  if (!pointers.delete(event.pointerId) || !gesture) return;
  if (gesture.pinch) { if (!pointers.size) gesture = null; return; }
  const { moved, grabbed, name } = gesture; gesture = null;
  if (!moved && event.type === 'pointerup' && grabbed?.click) { grabbed.click(event); return; }
  if (!moved && event.type === 'pointerup' && going) { goTo(name, under(event)); return; }
  if (moved && grabbed) { grabbed.end(); S.tab = 'map'; render(); } else if (!moved && event.type === 'pointerup') select(name);
};
map.addEventListener('pointerup', up);
map.addEventListener('pointercancel', up);
map.addEventListener('dblclick', (event) => { if (S.edit?.tool) return; const name = nameAt(event); if (name) show(name); else { const [x, y] = under(event); zoom(1.6); centre(x, y); paint(); } });
map.addEventListener('wheel', (event) => { event.preventDefault(); S.follow = false; const r = map.getBoundingClientRect(); zoom(Math.exp(-event.deltaY * 0.0015), event.clientX - r.left, event.clientY - r.top); }, { passive: false });

/** Orders a drive to what was clicked, or to that very point of the floor. */
function goTo(name, [x, y]) {
  going = false; over();
  const one = named(name);
  if (one && !one.frame && one.rule === undefined) { acts.go(one); return; }
  const storey = S.robot?.map && S.robot.map !== S.map ? [S.map] : [], at = [Math.round(x), Math.round(y), ...storey];
  send(L(`Поезжай в точку (${at.join('; ')})`, `Go to the point (${at.join(storey.length ? '; ' : ', ')})`));
}
/** Where the arrows aim, without a pointer: the middle of what is in view. */
const aim = () => [view.x + view.w / view.k / 2, -(view.y + view.h / view.k / 2)];

/* keys */
document.addEventListener('keydown', (event) => {
  if (event.ctrlKey && event.key === '.') { event.preventDefault(); stop(); return; }
  const typing = /INPUT|TEXTAREA|SELECT/.test(event.target.tagName) && event.target.type !== 'checkbox';
  if (event.ctrlKey && !typing && /^[zя]$/i.test(event.key) && may('edit')) { event.preventDefault(); if (event.shiftKey) acts.redo(); else acts.undo(); return; }
  if (event.key === 'Escape') { if (keysShown || open) { keysShown = open = false; over(); } else if (going) { going = false; over(); } else if (S.plan && !(typing && $('#say').value)) acts.decline(); else if (S.edit) edit.drop(); else if (S.asOf !== null) acts.now(); else if (typing) event.target.blur(); else if (S.selected) select(null); return; }
  if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
  const onMap = event.target === map, arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
  if (event.target.getAttribute?.('role') === 'tab' && arrow?.[0]) { const all = [...document.querySelectorAll('[role=tab]')].filter((one) => one.offsetParent); all[(all.indexOf(event.target) + arrow[0] + all.length) % all.length].click(); return; }
  if (arrow && onMap) { event.preventDefault(); const by = event.shiftKey ? 10 : 1; if (!(S.edit && (tools.nudge(arrow[0] * by, arrow[1] * by) || edit.nudge(arrow[0] * by, arrow[1] * by)))) { S.follow = false; view.x += arrow[0] * 48 / view.k; view.y -= arrow[1] * 48 / view.k; paint(); } return; }
  if (event.key === 'Enter' && onMap && going) { const at = aim(), r = map.getBoundingClientRect(); goTo(nameAt({ clientX: r.left + r.width / 2, clientY: r.top + r.height / 2 }), at); return; }
  if (event.key === 'Enter' && event.target.tagName !== 'BUTTON') { if (tools.close()) return; if (S.plan) acts.confirm(); else if (S.edit?.steps) acts.write(); return; }
  const key = event.code.replace(/^Key/, '');
  if (event.key === '?') { keysShown = !keysShown; over(); }
  else if (event.key === '/' || (event.code === 'Slash' && !event.shiftKey)) { event.preventDefault(); if (!wide()) { S.tab = 'talk'; render(); } $('#say').focus(); }
  else if (event.key === '+' || event.key === '=') zoom(1.25);
  else if (event.key === '-') zoom(0.8);
  else if (event.key === '0') fit();
  else if (key === 'F') follow();
  else if (key === 'L') { open = !open; over(); }
  else if (key === 'E' && may('edit')) edit.toggle();
  else if (key === 'G' && may('drive')) { going = !going; over(); if (going) map.focus({ preventScroll: true }); }
  else if (key === 'R' && S.edit) edit.nudge(0, 0, event.shiftKey ? -15 : 15);
  else if (key === 'BracketLeft' || key === 'BracketRight') { const maps = S.state.maps, at = maps.findIndex((one) => one.name === S.map) + (key === 'BracketRight' ? 1 : -1); if (maps[at]) storey(maps[at].name); }
});

/* the beginning */
const KEY = 'orthoframe';
function keep() { try { localStorage.setItem(KEY, JSON.stringify({ lang: S.lang, theme: S.theme, favourites: S.favourites })); } catch { /* it is a convenience */ } }
function recall() {
  S.lang = navigator.language.startsWith('ru') ? 'ru' : 'en';
  S.theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  try { Object.assign(S, JSON.parse(localStorage.getItem(KEY) ?? '{}')); } catch { /* nothing was kept */ }
}
recall();
edit.begin(render, (tool) => tools.take(tool)); tools.begin(render); picture.begin(render);
beyond.reveal = async (name) => {
  const about = await ask('/api/thing', { name, lang: S.lang }).catch(() => null);
  if (!about?.seen) return;
  if (about.seen.map !== S.map) await storey(about.seen.map);
  const [l, b, r, t] = about.seen.box, grown = Math.max(120, (r - l) / 2);
  fit([l - grown, -t - grown, r + grown, -b + grown]);
};
renderTalk(talkers); render();
new ResizeObserver(() => { if (S.drawing && !S.edit) fit(); else paint(); }).observe($('.canvas'));
document.addEventListener('visibilitychange', () => paint());
// Who waits for nothing is told of the lost line by the page as a whole.
addEventListener('unhandledrejection', (event) => { if (event.reason instanceof Gone) event.preventDefault(); });
setInterval(() => { if (S.lease?.session === S.state?.session && S.linked === 'yes') api('/api/lease', { do: 'keep' }).then((lease) => { S.lease = lease; }).catch(() => {}); }, 40000);
connect(heard).then(everything).catch((error) => { S.linked = error.status === 401 ? 'stranger' : 'no'; render(); if (S.linked === 'no') setTimeout(() => location.reload(), 3000); });
