// What stands beside the map and over it: the task, the thing, the map's history, and the card that says what matters now.
import { S, L, N, I, $, el, num, ask, may, length, seconds } from './base.js';
import { directives, doorState, show, paint } from './map.js';
import { nameButton, planInWords } from './talk.js';

const words = (step) => { const text = L(step.do_ru, step.do_en) ?? ''; return text.charAt(0).toUpperCase() + text.slice(1); };
/** `ДВЕРЬ_ИЗ_В_ОТКРЫТА_(а, б)` as a person reads it. */
const plainly = (fact) => { const [, name, args] = /^(.*?)_?\((.*)\)$/.exec(fact) ?? [null, fact, '']; return `${args}: ${name.toLowerCase().replaceAll('_', ' ')}`; };
const ENDS = {
  done: ['сделано', 'done'], already_true: ['уже так', 'already so'], no_plan: ['пути нет', 'no way'], stuck: ['застрял', 'stuck'], stopped: ['остановлено', 'stopped'],
  cancelled: ['отменено', 'cancelled'], declined: ['отклонено', 'declined'], failed: ['сбой', 'failed'], refused: ['нельзя', 'refused'], misheard: ['не понято', 'not understood'],
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
  if (S.asOf !== null) return one('past', 'clock', el('b', null, L('Прошлое', 'The past')), L(`Карта на ревизии ${S.asOf}`, `The map at revision ${S.asOf}`), null, [button('', L('К настоящему', 'Back to now'), act.now)]);
  if (S.plan) {
    const plan = S.plan.plan;
    return one('', 'task', [el('b', null, L('План', 'Plan')), el('span', null, `${length(plan.length_cm)} · ${seconds(plan.seconds)}`)], S.plan.text, planInWords(plan),
      [button('pri', [L('Ехать', 'Drive'), ' ', el('kbd', null, 'Enter')], act.confirm, { id: 'confirm' }), button('', [L('Не надо', 'Decline'), ' ', el('kbd', null, 'Esc')], act.decline)]);
  }
  if (S.task) {
    const all = directives(), step = all[S.step];
    return one(S.stopping ? 'stopd' : '', S.stopping ? 'stop' : icon(step), [el('b', null, L(`Шаг ${Math.min(S.step + 1, all.length)} из ${all.length}`, `Step ${Math.min(S.step + 1, all.length)} of ${all.length}`)), step ? el('span', null, `${length(step.length_cm)} · ${seconds(step.seconds)}`) : null], step ? words(step) : S.task.text, place());
  }
  if (S.stoppedBy) return one('stopd', 'stop', el('b', null, L('Остановлено', 'Stopped')), L('Робот стоит', 'The robot stands'), place(), [button('', L('Понятно', 'All right'), act.seen)]);
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
      el('div', { class: 'row' }, S.plan ? pill('warn', L('Ждёт подтверждения', 'Waits for a yes')) : S.stopping ? pill('bad', L('Останавливается', 'Stopping')) : pill('', L('Исполняется', 'Under way')), S.plan ? null : el('span', { class: 'sub' }, L(`шаг ${Math.min(at + 1, all.length)} из ${all.length}`, `step ${Math.min(at + 1, all.length)} of ${all.length}`))),
      el('h2', { class: 'title' }, running.text), meter,
      S.plan ? el('div', { class: 'btns' }, button('pri wide', L('Ехать', 'Drive'), act.confirm), button('wide', L('Не надо', 'Decline'), act.decline)) : null,
      el('ol', { class: 'steps' }, all.map((step, i) => el('li', { class: i < at ? 'done' : i === at ? 'cur' : '', 'aria-current': i === at ? 'step' : null }, el('span', { class: 'n' }, i < at ? I('check') : String(step.number)), el('span', null, words(step)), el('span', { class: 'num' }, `${step.length_cm > 0 ? `${length(step.length_cm)} · ` : ''}${seconds(step.seconds)}`))))));
    const rests = [...new Set((running.plan.events ?? []).flatMap((event) => L(event.assumptions, event.assumptions_en) ?? []))];
    if (rests.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('План держится на том, что', 'The plan rests on this')), el('ul', { class: 'list' }, rests.map((text) => el('li', null, I('door'), el('span', { class: 'g', title: text }, plainly(text)))))));
  } else {
    parts.push(el('div', { class: 'sec' }, el('div', { class: 'row' }, pill('mute', L('Задания нет', 'No task'))), el('h2', { class: 'title' }, L('Робот стоит', 'The robot stands')), el('p', { class: 'sub' }, place())));
  }
  parts.push(el('div', { class: 'sec' }, el('h2', null, L('Очередь', 'Queue'), el('span', { class: 'num' }, String(S.queue.length))),
    S.queue.length ? el('ul', { class: 'list' }, S.queue.map((task, i) => el('li', null, el('span', { class: 'g' }, task.text, el('div', { class: 'sub' }, task.by)),
      may('drive') && i > 0 ? el('button', { class: 'ib', type: 'button', 'aria-label': L(`Раньше: ${task.text}`, `Sooner: ${task.text}`), onclick: () => act.move(task.task, S.queue[i - 1].task) }, I('up')) : null,
      may('drive') ? el('button', { class: 'ib', type: 'button', 'aria-label': L(`Отменить: ${task.text}`, `Cancel: ${task.text}`), onclick: () => act.cancel(task.task) }, I('x')) : null))) : el('p', { class: 'sub' }, L('Пусто. Приказы, подтверждённые в пути, ждут здесь.', 'Empty. Orders confirmed on the way wait here.'))));
  const noted = S.waiting?.tasks ?? [];
  if (noted.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Отложено в хранилище', 'Kept in the store'), el('span', { class: 'num' }, String(noted.length))),
    el('ul', { class: 'list' }, noted.map((task) => el('li', null, el('span', { class: 'g' }, task.text, el('div', { class: 'sub' }, task.is_begun ? L('начато и прервано', 'begun and broken off') : task.by)))))));
  if (S.ended.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Было', 'Ended')), el('ul', { class: 'list' }, S.ended.slice(-8).reverse().map((task) => el('li', null, I(task.state === 'done' ? 'check' : task.state === 'stopped' ? 'stop' : 'x'),
    el('span', { class: 'g' }, task.text, el('div', { class: 'sub' }, `${ending(task.state)}${task.stopped_by ? ` – ${task.stopped_by === 'lease' ? L('кончилось право управления', 'the right to drive ended') : task.stopped_by}` : ''}`, task.state !== 'done' && task.text_end ? el('div', null, task.text_end) : null)),
    may('drive') ? el('button', { class: 'lnk', type: 'button', onclick: () => act.say(task.text) }, L('Ещё раз', 'Again')) : null)))));
  return parts;
}

let wanted = '';
function thingTab(act) {
  const thing = S.thing;
  if (!thing) {
    const d = S.drawing; if (!d) return el('p', { class: 'sub' }, L('Карты нет.', 'There is no map.'));
    const list = el('ul', { class: 'list pick' });
    const fill = () => {
      const has = (one) => one.name && `${one.name} ${one.name_en ?? ''}`.toLowerCase().includes(wanted.toLowerCase());
      const all = [...d.rooms, ...d.doors, ...d.places, ...d.things].filter(has);
      list.replaceChildren(...all.slice(0, 300).map((one) => el('li', null, I(one.polygons && !one.kind ? 'room' : one.gap ? 'door' : one.kind ? 'thing' : 'pin'), el('button', { class: 'g lnk', type: 'button', onclick: () => { act.select(one.name); show(one.name); } }, N(one)), one.room ? el('span', { class: 'num' }, N(one.room)) : null)));
    };
    const search = el('input', { type: 'search', value: wanted, placeholder: L('Найти комнату или вещь', 'Find a room or thing'), 'aria-label': L('Найти комнату или вещь', 'Find a room or thing'), oninput: (event) => { wanted = event.target.value; fill(); } });
    fill();
    return [el('div', { class: 'field' }, search), list];
  }
  const kind = { thing: L('вещь', 'thing'), room: L('комната', 'room'), door: L('дверь', 'door'), place: L('место', 'place'), map: L('этаж', 'storey') }[thing.kind];
  const parts = [el('div', { class: 'sec' }, el('div', { class: 'row' }, pill('v', kind), thing.state ? pill(thing.state === 'locked' ? 'bad' : thing.state === 'open' ? 'ok' : 'mute', doorState(thing)) : null, el('button', { class: 'lnk end', type: 'button', onclick: () => act.select(null) }, L('Весь список', 'Whole list'))),
    el('h2', { class: 'title' }, N(thing)), thing.object ? el('p', { class: 'sub' }, `${L(...thing.object)} · ${N(thing.room)}`) : null,
    el('div', { class: 'btns' }, may('drive') ? button('', [I('pin'), L('Ехать сюда', 'Drive here')], () => act.go(thing)) : null, thing.kind === 'thing' || thing.kind === 'door' ? may('edit') ? button('', [I('pen'), L('Править', 'Edit')], act.edit) : null : null))];
  const believed = thing.believed;
  if (believed && !believed.is_surveyed) parts.push(el('div', { class: 'note warn' }, el('b', null, L('Скорее всего, стоит не там', 'Probably stands elsewhere')), el('span', null, placeWords(believed.place), ` · ${Math.round(believed.confidence * 100)} %`)));
  if (believed?.carried !== null && believed?.carried !== undefined) parts.push(el('div', { class: 'note warn' }, believed.carried ? `${L('Отдано:', 'Given to:')} ${believed.carried}` : L('У робота в руке', 'In the robot’s hand')));
  const properties = Object.entries(thing.properties ?? {});
  if (properties.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Свойства', 'Properties')), el('dl', { class: 'kv' }, properties.map(([name, value]) => [el('dt', null, name), el('dd', null, value)]))));
  if (thing.things) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Здесь', 'Here'), el('span', { class: 'num' }, String(thing.things.length))), el('div', { class: 'acts' }, thing.things.map(([name]) => nameButton(name)))));
  const relations = thing.relations.filter((relation) => relation.args.length > 1).slice(0, 120);
  if (relations.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Отношения', 'Relations'), el('span', { class: 'num' }, String(relations.length))), el('ul', { class: 'rel' }, relations.map((relation) => relationRow(relation, thing)))));
  if (thing.story?.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Где бывала', 'Where it was')), el('ul', { class: 'list' }, thing.story.slice(-10).reverse().map((one) => el('li', null, I(one.source.observer ? 'eye' : 'map'), el('span', { class: 'g' }, one.place ? placeWords(one.place) : L('не на месте', 'not there'), el('div', { class: 'sub' }, `${when(one.at)} · ${one.source.observer ? `${one.source.observer}, ${Math.round(one.source.sure * 100)} %` : `${L('карта', 'map')} ${one.source.revision}, ${one.source.user}`}`)))))));
  return parts;
}
const placeWords = (where) => (where ? `${S.lang === 'en' && where.room_en ? where.room_en : where.room} (${num(where.at[0], 0)}; ${num(where.at[1], 0)})` : '?');
const when = (at) => new Date(at).toLocaleString(S.lang === 'ru' ? 'ru' : 'en-GB', { dateStyle: 'short', timeStyle: 'short' });

function relationRow(relation, thing) {
  const others = relation.args.map((arg) => (arg === thing.name ? el('span', { class: 'v' }, '·') : typeof arg === 'string' && Number.isNaN(Number(arg)) ? nameButton(arg) : el('span', { class: 'num' }, String(arg))));
  const row = el('li', null, el('span', null, el('span', { class: 'v' }, `${relation.relation.toLowerCase().replaceAll('_', ' ')} `), others.flatMap((one, i) => [i ? ' ' : null, one])));
  const why = el('button', { class: 'why', type: 'button', 'aria-expanded': 'false' }, L('почему', 'why'));
  why.addEventListener('click', async () => {
    const open = row.querySelector('.pf');
    why.setAttribute('aria-expanded', String(!open));
    if (open) { open.remove(); S.proof = null; paint(); return; }
    const proof = await ask('/api/why', { relation: relation.relation, of: relation.args.join(','), lang: S.lang }).catch((error) => ({ steps: [], text: error.message }));
    const steps = proof.steps ?? [];
    S.proof = [...new Set(steps.flatMap((step) => step.args).filter((arg) => typeof arg === 'string'))]; paint();
    row.append(el('ul', { class: 'pf' }, steps.map((step) => el('li', null, el('b', null, `${step.relation}(${step.args.join(', ')})`), step.measured ? ` – ${L('измерено', 'measured')}` : '', (step.compared ?? []).map((c) => el('div', null, `${c.text}: ${c.left} ${c.op} ${c.right}`)))), proof.text ? el('li', null, proof.text) : null));
  });
  row.append(why);
  return row;
}

function mapTab(act) {
  const parts = [];
  if (S.edit) parts.push(editSection(act));
  if (S.proposals.length) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Видно не там', 'Seen elsewhere'), el('span', { class: 'num' }, String(S.proposals.length))), S.proposals.map((one) => el('div', { class: 'note warn' }, el('b', null, nameButton(one.name)), el('span', null, `${L('на карте', 'on the map')}: ${placeWords(one.surveyed)}`), el('span', null, `${L('видели', 'seen')}: ${placeWords(one.place)} · ${Math.round(one.confidence * 100)} %`),
    may('edit') ? el('div', { class: 'btns' }, button('pri', L('Так и есть', 'That is so'), () => act.decide(one.name, 'confirm')), button('', L('Нет, как на карте', 'No, as on the map'), () => act.decide(one.name, 'reject'))) : null))));
  const edits = S.history.slice().reverse();
  parts.push(el('div', { class: 'sec' }, el('div', { class: 'row' }, el('h2', null, L('История', 'History')), may('edit') ? el('span', { class: 'end btns' }, button('', [I('undo'), L('Отменить', 'Undo')], act.undo), button('', [I('redo'), L('Вернуть', 'Redo')], act.redo)) : null),
    el('ul', { class: 'rev' }, edits.slice(0, 60).map((one) => el('li', { class: one.revision === S.asOf ? 'at' : '' }, el('span', { class: 'r' }, String(one.revision)),
      el('span', null, revisionWords(one), el('div', { class: 'sub' }, `${one.user} · ${when(one.at)}`), one.told ? el('ul', { class: 'diff' }, one.told.map((d) => el('li', { class: d.fate === 'deleted' ? 'm' : 'p' }, el('span', null, S.lang === 'en' ? englishOf(d) : d.ru)))) : null),
      el('span', { class: 'btns' }, el('button', { class: 'lnk', type: 'button', onclick: () => act.told(one) }, L('что', 'what')), el('button', { class: 'lnk', type: 'button', onclick: () => act.asOf(one.revision) }, L('показать', 'show'))))))));
  if (S.asOf !== null && may('edit')) parts.push(button('dan', L(`Вернуть карту к ревизии ${S.asOf}`, `Return the map to revision ${S.asOf}`), act.restore));
  if (may('edit')) parts.push(el('div', { class: 'sec' }, el('h2', null, L('Позвать ещё кого-то', 'Invite somebody')), el('div', { class: 'btns' }, [['look', L('смотреть', 'to look')], ['drive', L('управлять', 'to drive')], ['edit', L('править', 'to edit')]].map(([role, text]) => button('', text, () => act.invite(role)))), S.invited ? el('p', { class: 'sub mono wrap' }, S.invited) : null));
  return parts;
}
const KINDS = { import: ['импорт', 'import'], edit: ['правка', 'edit'], undo: ['отмена', 'undo of'], redo: ['возврат', 'redo of'] };
const revisionWords = (one) => `${L(...(KINDS[one.kind] ?? [one.kind, one.kind]))}${one.undoes ? ` ${one.undoes}` : ''}${one.reason ? `: ${one.reason}` : ''}`;
/** A difference by its data: its sentence is Russian. */
export const englishOf = (d) => `${N(/«(.*)»/.exec(d.subject)?.[1] ?? d.subject)}: ${d.fate}${d.fields.length ? ` (${d.fields.map((f) => `${f.column} ${f.old ?? '–'} → ${f.new ?? '–'}`).join(', ')})` : ''}`;

function editSection(act) {
  const edit = S.edit, parts = [el('div', { class: 'row' }, pill('v', L(`Правка на ревизии ${edit.on}`, `Edit on revision ${edit.on}`)))];
  if (!edit.name) parts.push(el('p', { class: 'sub' }, L('Выберите вещь или дверь на карте. Вещь можно тащить; стрелки двигают на 1 см, с Shift на 10, R поворачивает.', 'Choose a thing or a door on the map. Drag a thing; arrows move it 1 cm, with Shift 10, R turns it.')));
  else parts.push(el('h2', { class: 'title' }, N(edit.name)));
  if (edit.at) parts.push(el('dl', { class: 'kv' }, el('dt', null, 'X'), el('dd', null, `${num(edit.from.x)} → ${num(edit.at.x)} ${L('см', 'cm')}`), el('dt', null, 'Y'), el('dd', null, `${num(edit.from.y)} → ${num(edit.at.y)} ${L('см', 'cm')}`), el('dt', null, L('Поворот', 'Turn')), el('dd', null, `${num(edit.at.angle_deg, 0)}°`)));
  if (edit.name && edit.kind === 'thing') parts.push(el('div', { class: 'btns' }, button('', [I('turn'), L('Повернуть', 'Turn')], () => act.turn(15)), button('', [I('plus'), L('Ещё такую', 'One more')], act.add), button('', L('Назвать', 'Rename'), act.rename), button('dan', L('Убрать', 'Remove'), act.remove)));
  if (edit.name && edit.kind === 'door') parts.push(el('div', { class: 'btns' }, [['open', L('Открыта', 'Open')], ['closed', L('Закрыта', 'Closed')], ['locked', L('Заперта', 'Locked')]].map(([state, text]) => button('', text, () => act.door(state))), button('', L('Назвать', 'Rename'), act.rename)));
  if (edit.asking) parts.push(el('form', { class: 'sec', onsubmit: (event) => { event.preventDefault(); edit.asking.done($('#newname').value.trim()); } }, el('div', { class: 'field' }, el('input', { id: 'newname', value: edit.asking.value, 'aria-label': L('Имя', 'Name'), maxlength: '120' })), el('div', { class: 'btns' }, el('button', { class: 'btn pri' }, L('Дальше', 'Go on')))));
  if (edit.steps?.length) {
    if (edit.tried) parts.push(el('div', { class: 'note ok' }, el('b', null, L('Всё верно', 'All is right')), el('ul', { class: 'diff' }, edit.tried.differences.map((d) => el('li', { class: d.fate === 'deleted' ? 'm' : 'p' }, el('span', null, S.lang === 'en' ? englishOf(d) : d.ru)))), edit.tried.warnings.map((w) => el('span', null, w.message)), edit.tried.left_behind.length ? el('span', null, `${L('Остаётся на месте', 'Stays behind')}: ${edit.tried.left_behind.map(N).join(', ')}`) : null));
    if (edit.wrong) parts.push(el('div', { class: 'note bad', role: 'alert' }, el('b', null, L('Так нельзя', 'This cannot be')), edit.wrong.map((text) => el('span', null, text))));
    if (edit.theirs) parts.push(el('div', { class: 'note warn', role: 'alert' }, el('b', null, L('Пока вы правили, карта изменилась', 'The map changed while you edited')), edit.theirs.map((one) => el('div', null, `${one.revision}, ${one.user}: `, one.differences.map((d) => (S.lang === 'en' ? englishOf(d) : d.ru)).join('; '))), el('div', { class: 'btns' }, button('pri', L('Записать поверх их правки', 'Write on top of theirs'), act.onTop), button('', L('Оставить их', 'Keep theirs'), act.drop))));
    else parts.push(el('div', { class: 'btns' }, button('pri wide', [L('Записать', 'Write'), ' ', el('kbd', null, 'Enter')], act.write, { id: 'write', disabled: Boolean(edit.wrong) }), button('wide', [L('Бросить', 'Drop'), ' ', el('kbd', null, 'Esc')], act.drop)));
  }
  return el('div', { class: 'sec' }, parts);
}
