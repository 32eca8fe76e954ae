// What all modules share: the state, the language, icons, elements, requests.

/** All that the page knows. */
export const S = {
  lang: 'ru', theme: 'light', tab: 'talk',
  /** What `GET /api/state` said last. */
  state: null,
  /** Of a storey by its name: what `GET /api/drawing` said. */
  drawing: null, floor: null, map: null,
  robot: null, trail: [], follow: false,
  /** A plan that waits for a word, the task that is driven, and its directives. */
  plan: null, task: null, step: 0, queue: [], ended: [], lease: null,
  selected: null, thing: null, marked: [], proof: null,
  /** Where on the map a reason was measured: of the answer of `GET /api/why`. */
  measures: [],
  /** What `GET /api/kinds` said, once it was asked for. */
  kinds: null,
  /** What was asked of what is selected: the answer of `GET /api/why`. */
  reason: null,
  linked: 'begin', stoppedBy: null, stopping: false, paused: null,
  asOf: null, history: [], proposals: [], edits: [], changes: null,
  /** What would open a way that there is not: the answer of `GET /api/route`. */
  barred: null, favourites: [],
  layers: { names: true, things: true, zones: true, belief: true, places: true, frames: false, dead: false, network: false, relations: true },
  edit: null, toast: null, written: 0,
};

export const L = (ru, en) => (S.lang === 'ru' ? ru : en);
/** Of something with `name` and `name_en`, or of a name on this map, the name to be shown. */
export const N = (of) => {
  if (!of) return '';
  if (typeof of !== 'string') return (S.lang === 'en' && of.name_en) || of.name || '';
  return (S.lang === 'en' && english.get(of)) || of;
};
const english = new Map();
export const names = (all) => { for (const one of all) if (one.name && one.name_en) english.set(one.name, one.name_en); };
export const num = (value, digits = 1) => {
  const text = Number(value).toFixed(digits);
  return S.lang === 'ru' ? text.replace('.', ',') : text;
};
export const length = (cm) => (cm >= 100 ? `${num(cm / 100)} ${L('м', 'm')}` : `${num(cm, 0)} ${L('см', 'cm')}`);
/** A measurement, to the millimetre. */
export const exact = (cm) => (cm >= 1000 ? length(cm) : `${num(cm)} ${L('см', 'cm')}`);
/** Marks on the map what a reason speaks of, or nothing any more. */
export const reasons = (about = null, measures = []) => { S.proof = about; S.measures = measures; };
export const seconds = (s) => `${num(s, s < 10 ? 1 : 0)} ${L('с', 's')}`;
export const $ = (selector) => document.querySelector(selector);

const SVG = 'http://www.w3.org/2000/svg';
const put = (element, attributes, children) => {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  for (const child of children.flat(4)) if (child !== null && child !== undefined && child !== false && child !== '') element.append(child);
  return element;
};
/** An element; texts become text, never markup. */
export const el = (name, attributes, ...children) => put(document.createElement(name), attributes, children);
export const sv = (name, attributes, ...children) => put(document.createElementNS(SVG, name), attributes, children);

const P = {
  stop: '<path d="M8 3h8l5 5v8l-5 5H8l-5-5V8z"/><rect x="9" y="9" width="6" height="6" fill="currentColor" stroke="none"/>',
  talk: '<path d="M4 5h16v11H11l-5 4v-4H4z"/>', task: '<path d="M4 6l1.5 1.5L8 5M4 12l1.5 1.5L8 11M4 18l1.5 1.5L8 17M12 6h8M12 12h8M12 18h8"/>',
  thing: '<path d="M12 3l8 4.5v9L12 21l-8-4.5v-9z"/><path d="M4 7.5l8 4.5 8-4.5M12 12v9"/>', map: '<path d="M9 4L3 6.5v13L9 17l6 3 6-2.5v-13L15 7z"/><path d="M9 4v13M15 7v13"/>',
  hand: '<path d="M5 4l14 7-6 2-2 6z"/>', pin: '<path d="M12 21s7-6.2 7-11.5A7 7 0 0 0 5 9.500C5 14.800 12 21 12 21z"/><circle cx="12" cy="9.500" r="2.400"/>', pen: '<path d="M4 20l1-4L16 5l3 3L8 19z"/><path d="M13.500 7.500l3 3"/>',
  layers: '<path d="M12 4l9 5-9 5-9-5z"/><path d="M3 14l9 5 9-5"/>', plus: '<path d="M12 5v14M5 12h14"/>', minus: '<path d="M5 12h14"/>', fit: '<path d="M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5"/>',
  follow: '<circle cx="12" cy="12" r="6"/><path d="M12 2v5M12 17v5M2 12h5M17 12h5"/><circle cx="12" cy="12" r="1" fill="currentColor"/>', check: '<path d="M5 12.500l4.500 4.500L19 7"/>', x: '<path d="M6 6l12 12M18 6L6 18"/>',
  up: '<path d="M6 15l6-6 6 6"/>', down: '<path d="M6 9l6 6 6-6"/>', send: '<path d="M12 19V5M6 11l6-6 6 6"/>', door: '<path d="M6 21V4h10v17M3 21h18M16 4l3 2v15"/><circle cx="13" cy="12.500" r=".9" fill="currentColor" stroke="none"/>',
  lock: '<rect x="5" y="11" width="14" height="9" rx="1.500"/><path d="M8 11V8a4 4 0 0 1 8 0v3"/>', undo: '<path d="M9 6L4 11l5 5"/><path d="M4 11h10a6 6 0 0 1 0 12" transform="translate(0 -3)"/>', redo: '<path d="M15 6l5 5-5 5"/><path d="M20 11H10a6 6 0 0 0 0 12" transform="translate(0 -3)"/>',
  play: '<path d="M8 5l11 7-11 7z"/>', ahead: '<path d="M12 21V4M6 10l6-6 6 6"/>', right: '<path d="M6 21v-7a4 4 0 0 1 4-4h9M14 5l5 5-5 5"/>', take: '<path d="M5 14h14v6H5zM12 3v8M8.500 8l3.500 3.500L15.500 8"/>', moon: '<path d="M19.500 14.500A8 8 0 0 1 9.500 4.500a8 8 0 1 0 10 10z"/>', sun: '<circle cx="12" cy="12" r="4"/><path d="M12 2v3M12 19v3M2 12h3M19 12h3M5 5l2 2M17 17l2 2M19 5l-2 2M7 17l-2 2"/>',
  why: '<path d="M8.500 9a3.500 3.500 0 1 1 5 3.200c-1 .5-1.500 1.100-1.500 2.300"/><circle cx="12" cy="18" r=".9" fill="currentColor" stroke="none"/>', warn: '<path d="M12 4l9.500 16h-19z"/><path d="M12 10v5"/><circle cx="12" cy="17.500" r=".8" fill="currentColor" stroke="none"/>', clock: '<circle cx="12" cy="12" r="8.500"/><path d="M12 7v5l3.500 2"/>', eye: '<path d="M2.500 12S6 5.500 12 5.500 21.500 12 21.500 12 18 18.500 12 18.500 2.500 12 2.500 12z"/><circle cx="12" cy="12" r="2.800"/>',
  move: '<path d="M12 3v18M3 12h18M12 3l-2.500 2.500M12 3l2.500 2.500M12 21l-2.500-2.500M12 21l2.500-2.500M3 12l2.500-2.500M3 12l2.500 2.500M21 12l-2.500-2.500M21 12l-2.500 2.500"/>', turn: '<path d="M19 12a7 7 0 1 1-2.200-5.100"/><path d="M17.500 3v4.200h-4.200"/>', room: '<path d="M4 4h16v16H4zM4 13h8M12 13v2.500M12 18.500V20"/>', zone: '<path d="M5 5h14v14H5z" stroke-dasharray="3 2.600"/>', img: '<path d="M4 5h16v14H4z"/><path d="M4 16l5-5 4 4 2.500-2.500L20 17"/>', file: '<path d="M6 3h8l4 4v14H6z"/><path d="M14 3v4h4"/>', off: '<path d="M3 3l18 18M5 12.500a10 10 0 0 1 4-2.400M2 9a14 14 0 0 1 4.500-2.700M19 12.500a10 10 0 0 0-3-2M22 9A14 14 0 0 0 11 5.200M9 16a4.500 4.500 0 0 1 5-.6"/><circle cx="12" cy="19.500" r="1" fill="currentColor"/>', star: '<path d="M12 4l2.400 5.200 5.600.6-4.200 3.800 1.200 5.600L12 16.300 7 19.200l1.200-5.600L4 9.800l5.600-.6z"/>', grip: '<path d="M9 6h.01M15 6h.01M9 12h.01M15 12h.01M9 18h.01M15 18h.01" stroke-width="2.400"/>',
};
/** An icon, for the eye alone. */
export const I = (name) => {
  const icon = sv('svg', { class: 'i', viewBox: '0 0 24 24', 'aria-hidden': 'true' });
  const parsed = new DOMParser().parseFromString(`<svg xmlns="${SVG}">${P[name]}</svg>`, 'image/svg+xml');
  icon.append(...parsed.documentElement.childNodes);
  return icon;
};

/** Says something to who hears the page instead of seeing it. */
export const announce = (text, urgent = false) => { $(urgent ? '#assertive' : '#polite').textContent = text; };

/** What the server refused, with its reason. */
export class Refused extends Error {
  constructor(status, body) {
    super((S.lang === 'en' && body.message_en) || body.message || String(status));
    this.status = status;
    this.body = body;
  }
}

/** No answer came: the line is down, which the page tells of itself. */
export class Gone extends Error {}

export async function api(path, body) {
  const request = body === undefined ? {} : { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) };
  let answer, text;
  try {
    answer = await fetch(path, { ...request, credentials: 'same-origin' });
    text = await answer.text();
  } catch (error) { throw new Gone(String(error)); }
  let value = {};
  try { value = JSON.parse(text); } catch { value = { message: text }; }
  if (!answer.ok) throw new Refused(answer.status, value);
  return value;
}
export const ask = (path, values) => api(`${path}?${new URLSearchParams(values)}`);
export const may = (role) => ['look', 'drive', 'edit'].indexOf(S.state?.role) >= ['look', 'drive', 'edit'].indexOf(role);
