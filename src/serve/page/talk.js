// The talk: one line for questions and orders, answers with what they name on the map, the plan before it is driven.
import { S, L, N, I, $, el, api, ask, announce, reasons, Refused, may, length, seconds } from './base.js';
import { named, show, paint } from './map.js';

const log = [];
let suggestions = [];
let chosen = -1;
const said = [];
let back = 0;
const now = () => new Date().toLocaleTimeString(S.lang === 'ru' ? 'ru' : 'en-GB', { hour: '2-digit', minute: '2-digit' });

/** The name of something on the map, which it shows when pointed at. */
export function nameButton(name) {
  const mark = (on) => () => { S.marked = on ? [name] : []; paint(); };
  return el('button', { class: 'nm', type: 'button', onmouseenter: mark(true), onmouseleave: mark(false), onfocus: mark(true), onblur: mark(false),
    onclick: () => { hear.select(name); show(name); } }, N(name));
}
let hear = {};

/** Names of this map that an answer's data bear, each once. */
function mentioned(reply) {
  const found = new Set();
  const look = (value) => {
    if (typeof value === 'string') { if (named(value)) found.add(value); } else if (Array.isArray(value)) value.forEach(look);
  };
  look(reply.bindings);
  for (const fact of reply.facts ?? []) look(fact.args);
  return [...found].slice(0, 12);
}

/** Points on the map at what the facts of an answer rest on: the things, and what was measured of them. */
async function point(reply, about) {
  reasons(about); paint();
  const facts = (reply.facts ?? []).slice(0, 4);
  const all = await Promise.all(facts.map(({ relation, args }) => ask('/api/why', { relation, of: args.join(','), lang: S.lang }).catch(() => null)));
  if (S.proof !== about) return;
  reasons([...new Set([...about, ...all.flatMap((one) => one?.about ?? [])])], all.flatMap((one) => one?.measures ?? []));
  paint();
}

/** Notes something in the talk. */
export function note(entry) {
  log.push({ at: now(), ...entry });
  if (log.length > 200) log.shift();
  renderLog();
}

function turn(entry) {
  const answers = (entry.replies ?? []).map((reply) => {
    const about = mentioned(reply), proof = (reply.facts ?? []).flatMap((fact) => fact.proof ?? []);
    const why = el('ul', { class: 'pf', hidden: true }, proof.map((line) => el('li', null, line)));
    return [
      el('div', { class: 'a' }, reply.text),
      (about.length || proof.length) ? el('div', { class: 'acts' }, about.map(nameButton),
        proof.length ? el('button', { class: 'lnk', type: 'button', 'aria-expanded': 'false', onclick: (event) => { why.hidden = !why.hidden; event.target.setAttribute('aria-expanded', String(!why.hidden)); if (why.hidden) { reasons(); paint(); } else point(reply, about); } }, L('Почему?', 'Why?')) : null) : null,
      why,
    ];
  });
  return el('div', { class: `turn ${entry.cls ?? ''}` },
    el('div', { class: 'q' }, el('span', null, entry.q), el('time', null, entry.at)), answers,
    (entry.lines ?? []).map((line) => el('div', { class: 'a' }, line)),
    entry.caution ? el('div', { class: 'say' }, I('warn'), el('span', null, entry.caution)) : null,
    (entry.steps ?? []).map((step) => el('div', { class: 'say' }, I(step.icon ?? 'ahead'), el('span', null, step.text))));
}

export function renderLog() {
  const box = $('.log'); if (!box) return;
  box.replaceChildren(...log.map(turn));
  if (!log.length) box.append(examples());
  box.scrollTop = box.scrollHeight;
}

/** What can be said, where nothing was said yet. */
function examples() {
  const some = S.state?.demo
    ? [['Где лекарство?', 'Where is the medicine?'], ['Почему Книга-4 на Столе-1?', 'What is on Table 1?'], ['Сколько стульев в Комнате-Z?', 'How many chairs are in Room Z?'], ['Принеси лекарство', 'Bring the medicine']]
    : [['Где ты?', 'Where are you?'], ['Какие есть комнаты?', 'Which rooms are there?']];
  return el('div', { class: 'sec' }, el('p', { class: 'sub' }, L('Спрашивайте и приказывайте обычными словами, например:', 'Ask and order in plain words, such as:')),
    el('div', { class: 'chips' }, some.map(([ru, en]) => el('button', { class: 'chip', type: 'button', onclick: () => { $('#say').value = L(ru, en); $('#say').focus(); } }, L(ru, en)))));
}

/** Draws the column; what is being typed stays. */
export function renderTalk(handlers) {
  hear = handlers;
  const typed = $('#say')?.value ?? '', had = document.activeElement?.id === 'say';
  const input = el('input', { id: 'say', autocomplete: 'off', spellcheck: 'false', role: 'combobox', 'aria-expanded': 'false', 'aria-controls': 'sug', 'aria-autocomplete': 'list', maxlength: '2000',
    placeholder: L('Спросите или прикажите…', 'Ask or order…'), 'aria-label': L('Вопрос или приказ', 'A question or an order'), oninput: complete, onkeydown: keys });
  $('.talk').replaceChildren(
    el('div', { class: 'hd' }, el('h2', null, L('Разговор', 'Talk')), el('span', { class: 'hint' }, L('по-русски или по-английски', 'in Russian or English'))),
    el('div', { class: 'log', tabindex: '0', 'aria-label': L('Разговор', 'Talk') }),
    el('form', { class: 'compose', onsubmit: (event) => { event.preventDefault(); send(); } },
      el('div', { class: 'sug', id: 'sug', role: 'listbox', hidden: true, 'aria-label': L('Дополнения', 'Completions') }),
      el('div', { class: 'field' }, input, el('kbd', { 'aria-hidden': 'true' }, '/'), el('button', { class: 'send', 'aria-label': L('Сказать', 'Say') }, I('send')))));
  $('.talk').setAttribute('aria-label', L('Разговор', 'Talk'));
  input.value = typed;
  if (had) input.focus();
  renderLog();
}

let asked = 0;
async function complete() {
  const text = $('#say').value, number = ++asked;
  chosen = -1;
  const found = text.trim().length > 1 ? await ask('/api/complete', { text }).catch(() => []) : [];
  if (number !== asked) return;
  suggestions = found; renderSuggestions();
}
function renderSuggestions() {
  const box = $('#sug'), input = $('#say');
  box.hidden = !suggestions.length; input.setAttribute('aria-expanded', String(!box.hidden));
  box.replaceChildren(...suggestions.map((one, i) => el('div', { role: 'option', id: `sug-${i}`, 'aria-selected': String(i === chosen), onmousedown: (event) => { event.preventDefault(); take(i); } }, el('b', null, one.name.slice(0, one.typed)), el('span', null, one.name.slice(one.typed)))));
  if (chosen >= 0) input.setAttribute('aria-activedescendant', `sug-${chosen}`); else input.removeAttribute('aria-activedescendant');
}
function take(i) {
  const input = $('#say'), one = suggestions[i];
  input.value = input.value.slice(0, [...input.value].length - one.typed) + one.name;
  suggestions = []; chosen = -1; renderSuggestions(); input.focus();
}
function keys(event) {
  const input = $('#say');
  if (suggestions.length && (event.key === 'ArrowDown' || event.key === 'ArrowUp')) {
    event.preventDefault(); chosen = (chosen + (event.key === 'ArrowDown' ? 1 : suggestions.length)) % suggestions.length; renderSuggestions();
  } else if (suggestions.length && (event.key === 'Tab' || (event.key === 'Enter' && chosen >= 0))) { event.preventDefault(); take(Math.max(0, chosen)); }
  else if (event.key === 'Escape' && suggestions.length) { event.stopPropagation(); suggestions = []; renderSuggestions(); }
  else if (event.key === 'ArrowUp' && said.length) { event.preventDefault(); back = Math.min(said.length, back + 1); input.value = said[said.length - back]; }
  else if (event.key === 'ArrowDown' && back) { event.preventDefault(); back -= 1; input.value = back ? said[said.length - back] : ''; }
  else if (event.key === 'Enter' && !input.value.trim() && S.plan) { event.preventDefault(); hear.confirm(); }
}

/** Says what stands in the line, or a given text. */
export async function send(given) {
  const input = $('#say'), text = (given ?? input.value).trim();
  if (!text) return;
  if (given === undefined) { input.value = ''; said.push(text); back = 0; suggestions = []; renderSuggestions(); }
  const entry = { q: text, at: now(), replies: [], lines: ['…'] };
  log.push(entry); renderLog();
  try {
    const answer = await api('/api/say', { text, lang: S.lang });
    entry.lines = []; entry.replies = answer.replies; entry.caution = answer.caution;
    S.marked = answer.replies.flatMap(mentioned).slice(0, 8); reasons();
    // What was asked for its reason is shown with it.
    const asked = answer.replies.find((reply) => reply.kind === 'why');
    if (asked) point(asked, mentioned(asked));
    const barred = answer.replies.find((reply) => ['no_plan', 'stuck'].includes(reply.outcome));
    if (barred) hear.barred(barred);
    if (answer.task) {
      entry.cls = 'order'; entry.lines = [planInWords(answer.task.plan)];
      if (!may('drive')) entry.lines.push(L('Ваша роль – только смотреть.', 'Your role is to look only.')); else hear.planned(answer.task);
    }
    announce([...answer.replies.map((reply) => reply.text), ...entry.lines].join(' '));
  } catch (error) { entry.cls = 'bad'; entry.lines = [reason(error)]; announce(entry.lines[0], true); }
  renderLog(); paint();
}

/** Why something was refused, in words. */
export const reason = (error) => (error instanceof Refused ? [error.message, (S.lang === 'en' && error.body.help_en) || error.body.help].filter(Boolean).join(' ') : L('Сервер не отвечает.', 'The server does not answer.'));

export function planInWords(plan) {
  const n = plan.directives.length;
  const more = plan.more ? L(` Затем ещё приказов: ${plan.more}; их план – когда до них дойдёт.`, ` Then orders: ${plan.more}; planned when their turn comes.`) : '';
  const whole = `${length(plan.length_cm)}, ${seconds(plan.seconds)}`;
  const ends = plan.outcome === 'done' ? '' : ` ${L(plan.explanation ?? 'До конца не выйдет.', plan.explanation_en ?? 'It will not get to the end.')}`;
  return L(`План: шагов ${n}, ${whole}.${more}${ends}`, `Plan: ${n} ${n === 1 ? 'step' : 'steps'}, ${whole}.${more}${ends}`);
}
