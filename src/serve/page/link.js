// The line to the server: events as they happen, resumed after a break, and what is asked anew when some were missed.
import { S, api, announce, L } from './base.js';

let source = null;
let last = null;
let heard = 0;
let hear = () => {};

/** Asks for everything, and hears what follows. */
export async function connect(handlers) {
  hear = handlers;
  await refresh();
  open();
  setInterval(() => {
    if (S.linked === 'yes' && Date.now() - heard > 7500) lost();
  }, 1000);
}

/** What the page begins with. */
export async function refresh() {
  let state = await api('/api/state');
  // What was heard meanwhile is newer than what was asked for.
  for (let again = 0; again < 5 && older(state.event, last); again += 1) state = await api('/api/state');
  last = state.event;
  S.state = state;
  // What is driven may have been planned anew since it began.
  S.task = state.task && S.task?.task === state.task.task ? S.task : state.task;
  S.queue = state.queue; S.paused = state.paused; S.ended = state.ended; S.lease = state.lease;
  S.robot = state.robot?.place ?? null;
  return state;
}

/** Of two ids of one run, whether the first was given before the second. */
const older = (a, b) => Boolean(b) && a.split('-')[0] === b.split('-')[0] && Number(a.split('-')[1]) < Number(b.split('-')[1]);

function open() {
  source?.close();
  source = new EventSource(`/api/events?after=${encodeURIComponent(last ?? '')}`);
  const on = (kind, work) => source.addEventListener(kind, (event) => {
    heard = Date.now();
    if (event.lastEventId) last = event.lastEventId;
    work(event.data ? JSON.parse(event.data) : null);
  });
  on('hello', () => {
    if (S.linked !== 'yes') { const was = S.linked; S.linked = 'yes'; hear.linked(was); }
  });
  on('gap', () => hear.gap());
  for (const kind of ['robot', 'directive', 'task', 'queue', 'proposed', 'known', 'revision', 'lease', 'stop', 'stopped']) on(kind, (data) => hear[kind]?.(data));
  source.onerror = () => {
    lost();
    // A server that is not there closes the line; one that is slow leaves it to the browser.
    if (source.readyState === EventSource.CLOSED) setTimeout(again, 1000);
  };
}

async function again() {
  try {
    await fetch('/api/tasks', { credentials: 'same-origin' }).then((answer) => {
      if (answer.status === 401) { S.linked = 'stranger'; hear.linked('no'); throw new Error('stranger'); }
    });
    open();
  } catch {
    if (S.linked !== 'stranger') setTimeout(again, 1000);
  }
}

function lost() {
  if (S.linked === 'no') return;
  S.linked = 'no';
  announce(L('Связи с роботом нет', 'No link to the robot'), true);
  hear.lost();
}
