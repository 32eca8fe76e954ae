// What stands beside the map and over it: the task, the thing, the map's history, and the card that says what matters now.
import { S, L, N, I, $, el, num, ask, may, exact, length, reasons, seconds } from './base.js';
import { directives, doorState, show, paint, zoneTime } from './map.js';
import { nameButton, planInWords } from './talk.js';
import { told as changesTold } from './changes.js';
import { cornerFields, form as toolForm, hint } from './tools.js';
import { form as pictureForm } from './picture.js';

const words = (step) => { const text = L(step.do_ru, step.do_en) ?? ''; return text.charAt(0).toUpperCase() + text.slice(1); };
const ENDS = {
  done: ['сделано', 'done'], already_true: ['уже так', 'already so'], no_plan: ['пути нет', 'no way'], stuck: ['застрял', 'stuck'], stopped: ['остановлено', 'stopped'],
  cancelled: ['отменено', 'cancelled'], limit: ['план не нашёлся за отведённое время', 'no plan was found in time'], vehicle_failed: ['робот отказал', 'the robot failed'], declined: ['отклонено', 'declined'], failed: ['сбой', 'failed'], refused: ['нельзя', 'refused'], misheard: ['не понято', 'not understood'],
};
export const ending = (state) => L(...(ENDS[state] ?? [state, state]));
const pill = (cls, text) => el('span', { class: `pill ${cls}` }, text);
const button = (cls, text, work, more = {}) => el('button', { class: `btn ${cls}`, type: 'button', onclick: work, ...more }, text);

/** The card at the top left of the map: the one thing that matters now. */
export function card(act) {
  const one = (cls, icon, kicker, title, more, buttons) => el('div', { class: `card next ${cls}` }, el('div', { class: 'ic' }, I(icon)),
    el('div', { class: 'tx' }, el('div', { class: 'k' }, kicker), el('strong', null, title), more ? el('p', { class: 'long' }, more) : null, buttons ? el('div', { class: 'btns' }, buttons) : null));
  if (S.linked === 'stranger') return one('stopd', 'off', el('b', null, L('Нужен адрес', 'An address is needed')), L('Откройте адрес, который напечатала программа', 'Open the address that the program printed'), L('Ключ в нём действует один раз.', 'The key in it is good once.'));
  if (S.linked === 'no') return one('stopd', 'off', el('b', null, L('Связи нет', 'No link')), L('Положение робота устарело', 'The robot’s place is out of date'), L('Стоп не дойдёт. Без связи робот сам остановится, когда кончится право управления.', 'A stop will not get there. Without a link the robot stops by itself when the right to drive ends.'));
  if (S.asOf !== null) return one('past', 'clock', el('b', null, L('Прошлое', 'The past')), L(`Карта на ревизии ${S.asOf}`, `The map at revision ${S.asOf}`), S.changes ? changesTold() : null, [button('', L('К настоящему', 'Back to now'), act.now)]);
  if (S.plan) {
    const plan = S.plan.plan;
    return one('', 'task', [el('b', null, L('План', 'Plan')), el('span', null, `${length(plan.length_cm)} · ${seconds(plan.seconds)}`)], S.plan.text, planInWords(plan),
      [button('pri', [L('Ехать', 'Drive'), ' ', el('kbd', null, 'Enter')], act.confirm, { id: 'confirm' }), button('', [L('Не надо', 'Decline'), ' ', el('kbd', null, 'Esc')], act.decline), may('drive') ? button('', L('Позже', 'Later'), act.later) : null]);
  }
  if (S.task?.barred) return one('stopd', 'warn', el('b', null, L('Путь преграждён', 'The way is barred')), L(S.task.barred.explanation, S.task.barred.explanation_en), L('Не обойти и не сдвинуть. Уберите и скажите, что свободно.', 'No way leads round it, and it is not to be pushed. Take it away, and say that it is clear.'),
    may('drive') ? [button('pri', L('Свободно', 'It is clear'), () => act.cleared(true), { id: 'cleared' }), button('', L('Отказаться', 'Give up'), () => act.cleared(false))] : null);
  if (S.task) {
    const all = directives(), step = all[S.step];
    return one(S.stopping ? 'stopd' : '', S.stopping ? 'stop' : icon(step), [el('b', null, L(`Шаг ${Math.min(S.step + 1, all.length)} из ${all.length}`, `Step ${Math.min(S.step + 1, all.length)} of ${all.length}`)), step ? el('span', null, `${length(step.length_cm)} · ${seconds(step.seconds)}`) : null], step ? words(step) : S.task.text, place());
  }
  if (S.stoppedBy) return one('stopd', 'stop', el('b', null, L('Остановлено', 'Stopped')), L('Робот стоит', 'The robot stands'), place(), [
    may('drive') && S.queue.some((task) => task.is_begun) ? button('pri', L('Продолжить', 'Go on'), () => act.resume(S.queue.find((task) => task.is_begun).task), { id: 'goon' }) : null,
    may('drive') && S.queue.some((task) => task.is_begun) ? button('', L('Отменить задание', 'Cancel the task'), () => { act.cancel(S.queue.find((task) => task.is_begun).task); act.seen(); }) : null,
    button('', L('Понятно', 'All right'), act.seen)]);
  if (S.barred) return one(S.barred.is_way ? '' : 'stopd', S.barred.is_way ? 'ahead' : 'warn', el('b', null, S.barred.is_way ? L('Путь', 'The way') : L('Пути нет', 'No way')), S.barred.title, S.barred.text, [button('', L('Понятно', 'All right'), () => act.barred(null))]);
  if (S.changes) return one('know', 'clock', el('b', null, L('Что изменилось', 'What changed')), changesTold(), null, [button('', L('Убрать с карты', 'Take off the map'), () => act.compare(null))]);
  const left = S.queue.filter((task) => !task.is_released);
  if (S.paused && S.queue.length) return one('past', 'clock', el('b', null, L('Пауза', 'Paused')), L(`Заданий ждёт: ${S.queue.length}`, `Tasks waiting: ${S.queue.length}`), null, may('drive') ? [button('pri', L('Продолжить', 'Resume'), () => act.resume())] : null);
  if (left.some((task) => task.is_begun)) return one('past', 'task', el('b', null, L('Прервано', 'Broken off')), left.find((task) => task.is_begun).text, L('Задание начато и не закончено.', 'The task was begun and not finished.'), may('drive') ? [button('pri', L('Продолжить', 'Go on'), () => act.resume(left.find((task) => task.is_begun).task)), button('', L('Отменить', 'Cancel'), () => act.cancel(left.find((task) => task.is_begun).task))] : null);
  return null;
}
const icon = (step) => (!step ? 'task' : /take|взять|put|give|перед/i.test(step.action) ? 'take' : 'ahead');
const place = () => (S.robot ? L(S.robot.ru, S.robot.en) : '');

export function body(tab, act) {
  if (!S.state) return el('p', { class: 'sub' }, '…');
  return { task: taskTab, thing: thingTab, map: mapTab }[tab === 'talk' ? 'task' : tab](act);
}

function taskTab(act) {
  const parts = [], running = S.plan ?? S.task;
  if (running) {
    const all = directives(), at = S.plan ? -1 : S.step;
    const meter = el('div', { class: 'meter', role: 'progressbar', 'aria-valuemin': 0, 'aria-valuemax': all.length, 'aria-valuenow': Math.max(0, at), 'aria-label': L('Ход задания', 'Progress') }, all.map((_, i) => el('i', { class: i < at ? 'd' : i === at ? 'c' : '' })));
    parts.push(el('div', { class: 'sec' },
      el('div', { class: 'row' }, S.plan ? pill('warn', L('Ждёт подтверждения', 'Waits for a yes')) : S.stopping ? pill('bad', L('Останавливается', 'Stopping')) : running.is_replayed ? pill('mute', L('Запись', 'Recording')) : pill('', L('Исполняется', 'Under way')), S.plan ? null : el('span', { class: 'sub' }, L(`шаг ${Math.min(at + 1, all.length)} из ${all.length}`, `step ${Math.min(at + 1, all.length)} of ${all.length}`))),
      el('div', { class: 'row' }, el('h2', { class: 'title' }, running.text), star(running.text, act)), meter,
      S.plan ? el('div', { class: 'btns' }, button('pri wide', L('Ехать', 'Drive'), act.confirm), button('wide', L('Не надо', 'Decline'), act.decline)) : null,
      el('ol', { class: 'steps' }, all.map((step, i) => el('li', { class: i < at ? 'done' : i === at ? 'cur' : '', 'aria-current': i === at ? 'step' : null }, el('span', { class: 'n' }, i < at ? I('check') : String(step.number)), el('span', null, words(step)), el('span', { class: 'num' }, `${step.length_cm > 0 ? `${length(step.length_cm)} · ` : ''}${seconds(step.seconds)}`))))));
    const rests = [...new Set((running.plan?.events ?? []).flatMap((event) => L(event.assumptions_ru, event.assumptions_en) ?? []))];
    if (rests.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('План держится на том, что', 'The plan rests on this')), el('ul', { class: 'list' }, rests.map((text) => el('li', null, I('door'), el('span', { class: 'g' }, text))))));
  } else {
    parts.push(el('div', { class: 'sec' }, el('div', { class: 'row' }, pill('mute', L('Задания нет', 'No task'))), el('h2', { class: 'title' }, L('Робот стоит', 'The robot stands')), el('p', { class: 'sub' }, place())));
  }
  const drive = may('drive'), ib = (icon, text, work) => el('button', { class: 'ib', type: 'button', 'aria-label': text, title: text, onclick: work }, I(icon));
  const stands = (task) => (task.is_begun ? L('начато и прервано', 'begun and broken off') : task.is_released && !S.paused ? L('ждёт очереди', 'waits its turn') : L('отложено', 'put off'));
  parts.push(el('div', { class: 'sec' }, el('div', { class: 'row wrap' }, el('h2', null, L('Очередь', 'Queue')), el('span', { class: 'num' }, String(S.queue.length)), S.paused ? pill('warn', L('Пауза', 'Paused')) : null,
    el('span', { class: 'end btns' }, S.task || (S.queue.some((task) => task.is_released) && !S.paused) ? button('sm', L('Пауза', 'Pause'), act.pause) : null,
      drive && S.queue.length && (S.paused || S.queue.some((task) => !task.is_released)) ? button('sm pri', L('Продолжить', 'Resume'), () => act.resume()) : null,
      drive && S.queue.length > 1 ? button('sm', L('Кратчайшим путём', 'Shortest way'), act.shortest) : null)),
    S.queue.length ? el('ul', { class: 'list queue' }, S.queue.map((task, i) => el('li', null, el('span', { class: 'num' }, String(i + 1)), el('span', { class: 'g' }, task.text, el('div', { class: 'sub' }, `${stands(task)} · ${task.by}${task.is_kept ? '' : L(' · не переживёт перезапуска', ' · not kept over a restart')}`)),
      drive && !task.is_released && !S.task ? ib('play', L(`Начать: ${task.text}`, `Begin: ${task.text}`), () => act.resume(task.task)) : null,
      drive && i > 0 ? ib('up', L(`Раньше: ${task.text}`, `Sooner: ${task.text}`), () => act.move(task.task, S.queue[i - 1].task)) : null,
      drive && i + 1 < S.queue.length ? ib('down', L(`Позже: ${task.text}`, `Later: ${task.text}`), () => act.move(task.task, S.queue[i + 2]?.task ?? null)) : null,
      drive ? ib('x', L(`Отменить: ${task.text}`, `Cancel: ${task.text}`), () => act.cancel(task.task)) : null))) : el('p', { class: 'sub' }, L('Пусто. Здесь ждут приказы, данные в пути, отложенные и прерванные.', 'Empty. Orders given on the way, put off and broken off wait here.'))));
  if (S.favourites.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Избранное', 'Favourites')), el('ul', { class: 'list' }, S.favourites.map((text) => el('li', null, el('button', { class: 'lnk g', type: 'button', disabled: !drive, onclick: () => act.say(text) }, text), star(text, act))))));
  if (S.ended.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Было', 'Ended')), el('ul', { class: 'list' }, S.ended.slice(-8).reverse().map((task) => el('li', null, I(task.state === 'done' ? 'check' : task.state === 'stopped' ? 'stop' : 'x'),
    el('span', { class: 'g' }, task.text, el('div', { class: 'sub' }, `${ending(task.state)}${task.stopped_by ? ` – ${task.stopped_by === 'lease' ? L('кончилось право управления', 'the right to drive ended') : task.stopped_by}` : ''}`, task.waits ? L(' · ждёт в очереди', ' · waits in the queue') : '', task.state !== 'done' && task.text_end ? el('div', null, task.text_end) : null)),
    may('drive') ? el('button', { class: 'lnk', type: 'button', onclick: () => act.say(task.text) }, L('Ещё раз', 'Again')) : null, star(task.text, act))))));
  return parts;
}
/** Keeps an order among the favourites of this browser, or lets it go. */
function star(text, act) {
  const is = S.favourites.includes(text), words = is ? L(`Убрать из избранного: ${text}`, `Not a favourite any more: ${text}`) : L(`В избранное: ${text}`, `A favourite: ${text}`);
  return el('button', { class: 'ib star', type: 'button', 'aria-pressed': String(is), 'aria-label': words, title: words, onclick: () => act.favourite(text) }, I('star'));
}

let wanted = '';
function thingTab(act) {
  const thing = S.thing;
  if (!thing) {
    const d = S.drawing; if (!d) return el('p', { class: 'sub' }, L('Карты нет.', 'There is no map.'));
    const list = el('ul', { class: 'list pick' });
    const fill = () => {
      const has = (one) => one.name && `${one.name} ${one.name_en ?? ''}`.toLowerCase().includes(wanted.toLowerCase());
      const all = [...d.rooms, ...d.doors, ...d.places, ...(d.zones ?? []), ...d.things].filter(has);
      list.replaceChildren(...all.slice(0, 300).map((one) => el('li', null, I(one.frame ? 'room' : one.gap ? 'door' : one.on_map ? 'thing' : one.rule !== undefined ? 'zone' : 'pin'), el('button', { class: 'g lnk', type: 'button', onclick: () => { act.select(one.name); show(one.name); } }, N(one)), one.room ? el('span', { class: 'num' }, N(one.room)) : null)));
    };
    const search = el('input', { type: 'search', value: wanted, placeholder: L('Найти комнату или вещь', 'Find a room or thing'), 'aria-label': L('Найти комнату или вещь', 'Find a room or thing'), oninput: (event) => { wanted = event.target.value; fill(); } });
    fill();
    return [el('div', { class: 'field' }, search), list];
  }
  const kind = { thing: L('вещь', 'thing'), room: L('комната', 'room'), door: L('дверь', 'door'), place: L('место', 'place'), zone: L('зона', 'zone'), map: L('этаж', 'storey') }[thing.kind];
  const parts = [el('div', { class: 'sec' }, el('div', { class: 'row' }, pill('v', kind), thing.state ? pill(thing.state === 'locked' ? 'bad' : thing.state === 'open' ? 'ok' : 'mute', doorState(thing)) : null, el('button', { class: 'lnk end', type: 'button', onclick: () => act.select(null) }, L('Весь список', 'Whole list'))),
    el('h2', { class: 'title' }, N(thing)), thing.object ? el('p', { class: 'sub' }, `${L(...thing.object)} · ${N(thing.room)}`) : null,
    el('div', { class: 'btns' }, may('drive') && thing.kind !== 'zone' && thing.kind !== 'map' ? button('', [I('pin'), L('Ехать сюда', 'Drive here')], () => act.go(thing)) : null, may('drive') && thing.kind !== 'zone' && thing.kind !== 'map' ? button('', [I('ahead'), L('Путь', 'Way')], () => act.way(thing)) : null, thing.kind !== 'map' && may('edit') ? button('', [I('pen'), L('Править', 'Edit')], act.edit) : null))];
  if (thing.rule) { const zone = S.drawing?.zones?.find((one) => one.name === thing.name); parts.push(el('div', { class: `note ${zone?.in_force ? 'warn' : ''}` }, el('span', null, thing.rule), zone ? el('span', { class: 'sub' }, zone.in_force ? L('действует сейчас', 'in force now') : L('сейчас не действует', 'not in force now'), zoneTime(zone) ? ` · ${zoneTime(zone)}` : '') : null)); }
  const believed = thing.believed;
  const seen = believed?.last_seen ? L(`видели ${when(believed.last_seen)}`, `seen ${when(believed.last_seen)}`) : L('не видели', 'never seen');
  if (believed && !believed.is_surveyed) parts.push(el('div', { class: 'note warn' }, el('b', null, L('Скорее всего, стоит не там', 'Probably stands elsewhere')), el('span', null, placeWords(believed.place)), el('span', { class: 'sub' }, `${surely(believed.confidence)} · ${seen}`)));
  else if (believed) parts.push(el('p', { class: 'sub' }, `${L('Здесь по карте', 'Here by the map')} · ${surely(believed.confidence)} · ${seen}`));
  if (believed?.carried !== null && believed?.carried !== undefined) parts.push(el('div', { class: 'note warn' }, believed.carried ? `${L('Отдано:', 'Given to:')} ${believed.carried}` : L('У робота в руке', 'In the robot’s hand')));
  const properties = Object.entries(thing.properties ?? {});
  if (properties.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Свойства', 'Properties')), el('dl', { class: 'kv' }, properties.map(([name, value]) => [el('dt', null, name), el('dd', null, value)]))));
  if (thing.things) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Здесь', 'Here'), el('span', { class: 'num' }, String(thing.things.length))), el('div', { class: 'acts' }, thing.things.map(([name]) => nameButton(name)))));
  const relations = thing.relations.filter((relation) => relation.args.length > 1).slice(0, 120);
  if (relations.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Отношения', 'Relations'), el('span', { class: 'num' }, String(relations.length))), el('ul', { class: 'rel' }, relations.map((relation) => relationRow(relation, thing)))));
  if (thing.kind === 'thing') parts.push(whyNot(thing, act));
  if (thing.story?.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Где бывала', 'Where it was')), el('ul', { class: 'list' }, thing.story.slice(-10).reverse().map((one) => el('li', null, I(one.source === 'seen' ? 'eye' : 'map'), el('span', { class: 'g' }, one.place ? placeWords(one.place) : L('не на месте', 'not there'), el('div', { class: 'sub' }, `${when(one.at)} · ${one.source === 'seen' ? `${one.observer}, ${Math.round(one.sure * 100)} %` : `${L('карта', 'map')} ${one.revision}, ${one.user}`}`)))))));
  if (thing.changes?.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Правки на карте', 'Edits on the map')), el('ul', { class: 'list' }, thing.changes.slice(-10).reverse().map((one) => el('li', null, I('clock'), el('span', { class: 'g' }, L(`ревизия ${one.revision}`, `revision ${one.revision}`), el('div', { class: 'sub' }, `${one.user} · ${when(one.at)}`)), one.revision > 1 ? el('button', { class: 'lnk', type: 'button', 'aria-label': L(`Что изменила ревизия ${one.revision}`, `What revision ${one.revision} changed`), onclick: () => act.compare(one.revision - 1, one.revision) }, L('что', 'what')) : null)))));
  return parts;
}
const surely = (share) => L(`уверенность ${Math.round(share * 100)} %`, `${Math.round(share * 100)} % sure`);
const placeWords = (where) => (where?.on_map ? `${S.lang === 'en' && where.area_en ? where.area_en : where.area} (${num(where.on_map.at[0], 0)}; ${num(where.on_map.at[1], 0)})` : '?');
const when = (at) => new Date(at).toLocaleString(S.lang === 'ru' ? 'ru' : 'en-GB', { dateStyle: 'short', timeStyle: 'short' });

function relationRow(relation, thing) {
  const others = relation.args.map((arg) => (arg === thing.name ? el('span', { class: 'own' }, N(thing)) : typeof arg === 'string' && Number.isNaN(Number(arg)) ? nameButton(arg) : el('span', { class: 'num' }, String(arg))));
  // The relation stands where a verb would: «Чашка-1 находится сверху на Стол-1».
  const row = el('li', null, el('span', null, others[0], el('span', { class: 'v' }, ` ${relation.relation.toLowerCase().replaceAll('_', ' ')} `), others.slice(1).flatMap((one, i) => [i ? ' ' : null, one])));
  const why = el('button', { class: 'why', type: 'button', 'aria-expanded': 'false' }, L('почему', 'why'));
  why.addEventListener('click', async () => {
    const open = row.querySelector('.pf');
    why.setAttribute('aria-expanded', String(!open));
    if (open) { open.remove(); reasons(); paint(); return; }
    const proof = await ask('/api/why', { relation: relation.relation, of: relation.args.join(','), lang: S.lang }).catch((error) => ({ words: error.message, about: [], measures: [] }));
    if (!row.isConnected) return;
    reasons(proof.about, proof.measures); S.marked = []; paint();
    row.append(el('div', { class: 'pf' }, ground(proof)));
  });
  row.append(why);
  return row;
}

/** A reason: the sentence, what was measured, and the rules that made it of that. */
function ground(proof) {
  const measured = proof.measures.filter((m) => m.text && !proof.words.includes(m.text));
  const rules = (proof.steps ?? []).map((step) => el('li', null, el('b', null, `${step.relation}(${step.args.join(', ')})`), (step.compared ?? []).map((c) => el('div', null, `${c.text}: ${c.left} ${c.op} ${c.right}`))));
  if (proof.rule) rules.push(el('li', null, el('b', null, proof.rule), (proof.failed ?? []).map((c) => el('div', null, `${c.text}: ${c.left} ${c.op} ${c.right}`))));
  return [el('p', null, proof.words, /[.!?]$/.test(proof.words) ? '' : '.'), measured.length ? el('ul', null, measured.map((m) => el('li', { class: m.fails ? 'bad' : null }, m.text))) : null,
    rules.length ? el('details', null, el('summary', null, L('по каким правилам', 'by which rules')), el('ul', null, rules)) : null];
}

/** Why something is not so with another: a relation and a name. */
function whyNot(thing, act) {
  const list = el('datalist', { id: 'others' }, [...S.drawing?.things ?? [], ...S.drawing?.rooms ?? []].filter((one) => one.name !== thing.name).slice(0, 400).map((one) => el('option', { value: N(one) })));
  const relation = el('select', { id: 'not-relation', 'aria-label': L('Отношение', 'Relation') }), words = (name) => name.toLowerCase().replaceAll('_', ' ');
  const fill = () => relation.replaceChildren(...S.kinds.relations.map((names) => el('option', { value: L(...names), selected: names.includes(S.reason?.relation) }, words(L(...names)))));
  if (S.kinds) fill(); else ask('/api/kinds', {}).then((kinds) => { S.kinds = kinds; fill(); }).catch(() => {});
  const other = el('input', { id: 'not-other', list: 'others', 'aria-label': L('С чем', 'With what'), placeholder: L('с чем', 'with what'), value: S.reason?.other ?? '' });
  return el('form', { class: 'sec draft', onsubmit: (event) => { event.preventDefault(); if (relation.value && other.value.trim()) act.whyNot(relation.value, other.value.trim()); } },
    el('h2', null, L('Почему не…', 'Why not…')), el('div', { class: 'four' }, relation, other), list, el('div', { class: 'btns' }, el('button', { class: 'btn' }, [I('why'), L('Спросить', 'Ask')])),
    S.reason ? el('div', { class: 'pf' }, ground(S.reason)) : null);
}

function mapTab(act) {
  const parts = [];
  if (S.edit) parts.push(editSection(act));
  if (S.proposals.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Видно не там', 'Seen elsewhere'), el('span', { class: 'num' }, String(S.proposals.length))), S.proposals.map((one) => el('div', { class: 'note warn' }, el('b', null, nameButton(one.name)),
    el('div', { class: 'pair' }, el('div', null, el('small', null, L('на карте', 'on the map')), el('div', null, one.surveyed ? placeWords(one.surveyed) : L('нет такого', 'no such thing'))), el('div', null, el('small', null, `${L('видели', 'seen')} · ${Math.round(one.confidence * 100)} %`), el('div', null, placeWords(one.place)))),
    may('edit') ? el('div', { class: 'btns' }, button('pri', L('Так и есть', 'That is so'), () => act.decide(one.name, 'confirm')), button('', L('Нет, как на карте', 'No, as on the map'), () => act.decide(one.name, 'reject'))) : null))));
  if (S.edits.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Предложил помощник', 'Proposed by an assistant'), el('span', { class: 'num' }, String(S.edits.length))), S.edits.map((one) => el('div', { class: `note ${one.fault ? 'bad' : 'warn'}` }, el('b', null, one.reason || L('без объяснения', 'without a reason')),
    one.fault ? el('span', null, (S.lang === 'en' && one.fault.message_en) || one.fault.message) : el('ul', { class: 'diff' }, some(one.differences)),
    el('span', { class: 'sub' }, L(`сделано на ревизии ${one.on}`, `made on revision ${one.on}`)),
    may('edit') ? el('div', { class: 'btns' }, one.fault ? null : button('pri', L('Записать', 'Write'), () => act.judge(one.id, 'confirm')), button('', L('Отклонить', 'Reject'), () => act.judge(one.id, 'reject'))) : null))));
  const edits = S.history.slice().reverse();
  parts.push(el('div', { class: 'sec' }, el('div', { class: 'row' }, el('h2', null, L('История', 'History')), may('edit') ? el('span', { class: 'end btns' }, button('', [I('undo'), L('Отменить', 'Undo')], act.undo), button('', [I('redo'), L('Вернуть', 'Redo')], act.redo)) : null),
    el('ul', { class: 'rev' }, edits.slice(0, 60).map((one) => el('li', { class: one.revision === S.asOf ? 'at' : '' }, el('span', { class: 'r' }, String(one.revision)),
      el('span', null, revisionWords(one), el('div', { class: 'sub' }, `${one.user} · ${when(one.at)}`), one.told ? el('ul', { class: 'diff' }, some(one.told, 20)) : null),
      el('span', { class: 'btns' }, el('button', { class: 'lnk', type: 'button', onclick: () => act.told(one) }, L('что', 'what')), el('button', { class: 'lnk', type: 'button', onclick: () => act.asOf(one.revision) }, L('показать', 'show')), S.asOf !== null && one.revision !== S.asOf ? el('button', { class: 'lnk', type: 'button', onclick: () => act.compare(Math.min(S.asOf, one.revision), Math.max(S.asOf, one.revision)) }, L(`сравнить с ${S.asOf}`, `compare with ${S.asOf}`)) : null))))));
  if (S.asOf !== null && may('edit')) parts.push(button('dan', L(`Вернуть карту к ревизии ${S.asOf}`, `Return the map to revision ${S.asOf}`), act.restore));
  if (may('edit')) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Позвать ещё кого-то', 'Invite somebody')), el('div', { class: 'btns' }, [['look', L('смотреть', 'to look')], ['drive', L('управлять', 'to drive')], ['edit', L('править', 'to edit')]].map(([role, text]) => button('', text, () => act.invite(role)))), S.invited ? el('p', { class: 'sub mono wrap' }, S.invited) : null));
  return parts;
}
const KINDS = { import: ['импорт', 'import'], edit: ['правка', 'edit'], undo: ['отмена', 'undo of'], redo: ['возврат', 'redo of'] };
const revisionWords = (one) => `${L(...(KINDS[one.kind] ?? [one.kind, one.kind]))}${one.undoes ? ` ${one.undoes}` : ''}${one.reason ? `: ${one.reason}` : ''}`;
/** The first of many, and how many more there are. */
const some = (all, most = 6) => [all.slice(0, most).map(difference), all.length > most ? el('li', null, el('span', { class: 'sub' }, L(`и ещё ${all.length - most}`, `and ${all.length - most} more`))) : null];
/** Numbers are told to the millimetre. */
const rounded = (text) => text.replace(/\d+\.\d+/g, (n) => num(n).replace(/[.,]0$/, ''));
const difference = (d) => el('li', { class: d.fate === 'deleted' ? 'm' : 'p' }, el('span', null, rounded(L(d.ru, d.en))));

function editSection(act) {
  const edit = S.edit, parts = [el('div', { class: 'row' }, pill('v', L(`Правка на ревизии ${edit.on}`, `Edit on revision ${edit.on}`)))];
  if (edit.tool === 'plan') return el('div', { class: 'sec' }, pill('v', L('Рисунок под картой', 'Picture beneath the map')), pictureForm());
  const drawn = edit.tool ? toolForm() : null;
  if (drawn) parts.push(drawn);
  else if (edit.tool && !edit.name) parts.push(el('p', { class: 'sub' }, hint()));
  else if (!edit.name) parts.push(el('p', { class: 'sub' }, L('Выберите вещь, дверь, комнату, место или зону: на карте или в списке на вкладке «Вещь». Вещи, места и зоны можно тащить; стрелки на карте двигают на 1 см, с Shift на 10, R поворачивает.', 'Choose a thing, a door, a room, a place or a zone: on the map, or in the list of tab Thing. Drag things, places and zones; arrows on the map move them 1 cm, with Shift 10, R turns.')));
  else parts.push(el('h2', { class: 'title' }, N(edit.name)));
  if (edit.at) parts.push(el('dl', { class: 'kv' }, el('dt', null, 'X'), el('dd', null, `${num(edit.from.x)} → ${num(edit.at.x)} ${L('см', 'cm')}`), el('dt', null, 'Y'), el('dd', null, `${num(edit.from.y)} → ${num(edit.at.y)} ${L('см', 'cm')}`), el('dt', null, L('Поворот', 'Turn')), el('dd', null, `${num(edit.at.angle_deg, 0)}°`)));
  if (edit.name && edit.kind === 'thing') parts.push(el('div', { class: 'btns' }, button('', [I('turn'), L('Повернуть', 'Turn')], () => act.turn(15)), button('', [I('plus'), L('Ещё такую', 'One more')], act.add), button('', L('Назвать', 'Rename'), act.rename), button('dan', L('Убрать', 'Remove'), act.remove)));
  if (edit.name && edit.kind === 'door') parts.push(el('div', { class: 'btns' }, [['open', L('Открыта', 'Open')], ['closed', L('Закрыта', 'Closed')], ['locked', L('Заперта', 'Locked')]].map(([state, text]) => button('', text, () => act.door(state))), button('', L('Назвать', 'Rename'), act.rename), button('dan', L('Убрать', 'Remove'), act.remove)));
  if (edit.name && edit.kind === 'room') parts.push(edit.parts ? el('p', { class: 'sub' }, hint()) : null, el('div', { class: 'btns' }, button('', L('Назвать', 'Rename'), act.rename), button('', [I('zone'), L('Закрыть для робота', 'Shut to the robot')], act.shut), button('dan', L('Убрать', 'Remove'), act.remove)));
  if (edit.name && edit.kind === 'room' && edit.parts) parts.push(cornerFields());
  if (edit.name && edit.kind === 'place') parts.push(el('div', { class: 'btns' }, button('', L('Назвать', 'Rename'), act.rename), button('dan', L('Убрать', 'Remove'), act.remove)));
  if (edit.name && edit.kind === 'zone') parts.push(el('p', { class: 'sub' }, L(edit.zone.rule, edit.zone.rule_en)), el('div', { class: 'btns' }, edit.zone.in_force ? button('', [I('clock'), L('Кончается сейчас', 'Ends now')], act.ends) : null, button('', L('Назвать', 'Rename'), act.rename), button('dan', L('Убрать', 'Remove'), act.remove)));
  if (edit.asking) parts.push(el('form', { class: 'sec', onsubmit: (event) => { event.preventDefault(); edit.asking.done($('#newname').value.trim()); } }, el('div', { class: 'field' }, el('input', { id: 'newname', value: edit.asking.value, 'aria-label': L('Имя', 'Name'), maxlength: '120' })), el('div', { class: 'btns' }, el('button', { class: 'btn pri' }, L('Дальше', 'Go on')))));
  parts.push(el('div', { id: 'verdict', class: 'sec' }, verdict(act)));
  return el('div', { class: 'sec' }, parts);
}

/** What the server says of the edit as it is, and the way on. */
export function verdict(act) {
  const { edit } = S, parts = [];
  if (!edit) return parts;
  if (edit.wrong) parts.push(el('div', { class: 'note bad', role: 'alert' }, el('b', null, L('Так нельзя', 'This cannot be')), edit.wrong.map((text) => el('span', null, text))));
  if (edit.steps?.length) {
    if (edit.tried) parts.push(el('div', { class: 'note ok' }, el('b', null, L('Всё верно', 'All is right')), el('ul', { class: 'diff' }, some(edit.tried.differences.filter((d) => !/SIDES/i.test(d.table) || edit.tried.differences.length < 7))), edit.tried.told.map((w) => el('span', null, w.message)), edit.tried.left_behind.length ? el('span', null, `${L('Остаётся на месте', 'Stays behind')}: ${edit.tried.left_behind.map(N).join(', ')}`) : null));
    if (edit.theirs) parts.push(el('div', { class: 'note warn', role: 'alert' }, el('b', null, L('Пока вы правили, карта изменилась', 'The map changed while you edited')), edit.theirs.map((one) => el('div', null, `${one.revision}, ${one.user}: `, one.differences.map((d) => L(d.ru, d.en)).join('; '))), el('div', { class: 'btns' }, button('pri', L('Записать поверх их правки', 'Write on top of theirs'), act.onTop), button('', L('Оставить их', 'Keep theirs'), act.drop))));
    else parts.push(el('div', { class: 'btns' }, button('pri wide', [L('Записать', 'Write'), ' ', el('kbd', null, 'Enter')], act.write, { id: 'write', disabled: Boolean(edit.wrong) }), button('wide', [L('Бросить', 'Drop'), ' ', el('kbd', null, 'Esc')], act.drop)));
  }
  return parts;
}
