// A picture of a floor plan beneath the map, to draw after: moved, turned and scaled. It stays in this browser and is no part of
// the map.
import { S, L, $, el, announce, length } from './base.js';
import { paint, under, view } from './map.js';

/** Of each storey: the picture, the map cm of its left top corner, cm a pixel, degrees, opacity. */
const laid = new Map();
let render = () => {};
export const begin = (redraw) => { render = redraw; };
export const here = () => laid.get(S.map) ?? null;

const STORE = 'plans';
function store() {
  return new Promise((done, failed) => {
    const asked = indexedDB.open('orthoframe', 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore(STORE);
    asked.onsuccess = () => done(asked.result);
    asked.onerror = () => failed(asked.error);
  });
}
const KEY = () => `${S.state?.name ?? ''}/${S.map}`;
async function keep() {
  const plan = here();
  try {
    const all = (await store()).transaction(STORE, 'readwrite').objectStore(STORE);
    if (plan) { const { file, x, y, scale, angle, opacity } = plan; all.put({ file, x, y, scale, angle, opacity }, KEY()); } else all.delete(KEY());
  } catch { /* it is a convenience */ }
}
/** Brings back what was laid beneath this storey. */
export async function recall() {
  const map = S.map;
  if (!map || laid.has(map)) return;
  try {
    const all = (await store()).transaction(STORE).objectStore(STORE), asked = all.get(KEY());
    const kept = await new Promise((done) => { asked.onsuccess = () => done(asked.result); asked.onerror = () => done(null); });
    if (!kept || laid.has(map)) return;
    laid.set(map, { ...kept, image: await createImageBitmap(kept.file) });
    paint(); render();
  } catch { /* there is none */ }
}

async function lay(file) {
  if (!file) return;
  try {
    const image = await createImageBitmap(file), w = view.w / view.k;
    // As wide as what is in view, until somebody says how large it is.
    laid.set(S.map, { file, image, x: view.x + w * 0.1, y: -view.y - view.h / view.k * 0.1, scale: (w * 0.8) / image.width, angle: 0, opacity: 0.6 });
    announce(L('Рисунок подложен', 'The picture is laid beneath'));
  } catch { announce(L('Это не рисунок, который браузер читает', 'This is no picture that the browser can read'), true); S.toast = L('Рисунок не читается: нужен PNG, JPEG или WebP.', 'The picture cannot be read: PNG, JPEG or WebP is needed.'); }
  keep(); paint(); render();
}

/** Draws the picture where the map is looked at. */
export function draw() {
  const canvas = $('#plan'), plan = here();
  $('.canvas').classList.toggle('traced', Boolean(plan));
  if (!plan) { if (canvas.width > 1) canvas.width = 1; return; }
  const ratio = devicePixelRatio || 1, w = Math.round(view.w * ratio), h = Math.round(view.h * ratio);
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const on = canvas.getContext('2d');
  on.setTransform(1, 0, 0, 1, 0, 0); on.clearRect(0, 0, w, h);
  const k = view.k * ratio;
  on.setTransform(k, 0, 0, k, (plan.x - view.x) * k, (-plan.y - view.y) * k);
  on.rotate((-plan.angle * Math.PI) / 180); on.scale(plan.scale, plan.scale);
  on.globalAlpha = plan.opacity; on.drawImage(plan.image, 0, 0);
}

/** A press on the map with the picture in hand: it is dragged, or two points of it are marked. */
export function grab(event) {
  const plan = here();
  if (S.edit?.tool !== 'plan' || !plan) return null;
  const begun = under(event), { x, y } = plan;
  return {
    move(next) { const at = under(next); plan.x = x + at[0] - begun[0]; plan.y = y + at[1] - begun[1]; S.edit.marks = []; paint(); },
    end() { keep(); render(); },
    click(at) { S.edit.marks = [...(S.edit.marks ?? []).slice(-1), under(at)]; paint(); render(true); },
  };
}
/** The two marks are so many cm apart: the picture grows or shrinks about the first. */
function scaleTo(cm) {
  const plan = here(), [a, b] = S.edit.marks ?? [];
  if (!plan || !b || !(cm > 0)) return;
  const by = cm / Math.hypot(b[0] - a[0], b[1] - a[1]);
  plan.scale *= by;
  for (const [axis, at] of [['x', a[0]], ['y', a[1]]]) plan[axis] = at + (plan[axis] - at) * by;
  S.edit.marks = [a, [a[0] + (b[0] - a[0]) * by, a[1] + (b[1] - a[1]) * by]];
  keep(); paint(); render(true);
}

export function form() {
  const plan = here(), marks = S.edit.marks ?? [];
  const number = (name, label, more) => el('label', null, el('span', null, label), el('input', { type: 'number', id: `f-plan-${name}`, value: Math.round(plan[name] * 100) / 100, ...more, onchange: (event) => { plan[name] = Number(event.target.value); keep(); paint(); } }));
  const parts = [el('p', { class: 'sub' }, L('Рисунок остаётся в этом браузере: он помогает чертить и в карту не входит.', 'The picture stays in this browser: it helps to draw, and is no part of the map.')),
    el('label', null, el('span', null, L('Файл рисунка', 'Picture file')), el('input', { type: 'file', id: 'f-plan', accept: 'image/png,image/jpeg,image/webp', onchange: (event) => lay(event.target.files[0]) }))];
  if (plan) {
    parts.push(el('p', { class: 'sub' }, marks.length < 2 ? L('Отметьте щелчками две точки, расстояние между которыми знаете, или тяните рисунок.', 'Click two points whose distance you know, or drag the picture.') : L(`Отмечено: ${length(Math.hypot(marks[1][0] - marks[0][0], marks[1][1] - marks[0][1]))}. Сколько на самом деле?`, `Marked: ${length(Math.hypot(marks[1][0] - marks[0][0], marks[1][1] - marks[0][1]))}. How far is it really?`)),
      el('label', null, el('span', null, L('На самом деле, см', 'Really, cm')), el('input', { type: 'number', id: 'f-plan-cm', min: 1, disabled: marks.length < 2, onchange: (event) => scaleTo(Number(event.target.value)) })),
      el('div', { class: 'four' }, number('x', `X, ${L('см', 'cm')}`), number('y', `Y, ${L('см', 'cm')}`), number('scale', L('см/точку', 'cm/pixel'), { step: 'any', min: 0.001 }), number('angle', L('Поворот, °', 'Turn, °'))),
      el('label', null, el('span', null, L('Заметность', 'Opacity')), el('input', { type: 'range', id: 'f-plan-opacity', min: 0.1, max: 1, step: 0.05, value: plan.opacity, oninput: (event) => { plan.opacity = Number(event.target.value); keep(); paint(); } })),
      el('div', { class: 'btns' }, el('button', { class: 'btn', type: 'button', onclick: () => { laid.delete(S.map); keep(); paint(); render(); } }, L('Убрать рисунок', 'Take the picture away'))));
  }
  return el('form', { class: 'draft', onsubmit: (event) => event.preventDefault() }, parts);
}
