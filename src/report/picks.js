// Pictures that are picked: kept by the browser, and copied out of the run's folder by `gramloom pick`.

const picks = new Set();
const picksKey = `gramloom-picks:${location.pathname}`;
const fewPicks = 12;  // so many names stand in the command itself

/** What the browser keeps; pages on disk may have no store. */
const store = {
  get: (key) => { try { return localStorage.getItem(key); } catch { return null; } },
  set: (key, value) => { try { localStorage.setItem(key, value); } catch { /* none */ } },
};
const canPick = (subject) => subject?.job?.status === 'done' && subject.views.length > 0;

function readPicks() {
  let kept = [];
  try { kept = JSON.parse(store.get(picksKey) ?? '[]'); } catch { /* someone else's */ }
  for (const name of Array.isArray(kept) ? kept : [])
    if (canPick(subjectById.get(name))) picks.add(name);
}

function changePicks(change) {
  change();
  store.set(picksKey, JSON.stringify([...picks]));
  for (const button of document.querySelectorAll('[data-pick]'))
    button.setAttribute('aria-pressed', String(picks.has(button.dataset.pick)));
  if (picks.size === 0) chosen.picked = false;
  drawPicks();
}
const togglePick = (subject) => canPick(subject) &&
  changePicks(() => picks.delete(subject.id) || picks.add(subject.id));

const pickButton = (subject) => canPick(subject) && el('button', { type: 'button', class: 'pick', title: 'pick (p)',
  'data-pick': subject.id, 'aria-pressed': String(picks.has(subject.id)), 'aria-label': `Pick ${describe(subject)}`,
  onclick: () => togglePick(subject) });

/** In the order of the page, whatever that of the clicks. */
const pickedNames = () => data.jobs.map(({ name }) => name).filter((name) => picks.has(name));

function pickCommand() {
  const folder = location.protocol === 'file:'
    ? decodeURIComponent(location.pathname).replace(/\/[^/]*$/, '') : 'DIR';
  const names = pickedNames();
  return [data.run.command?.[0] ?? 'gramloom', 'pick', folder,
    ...(names.length <= fewPicks ? names : ['--list', 'picks.txt']), '--output', 'picked'].map(quoted).join(' ');
}

function downloadPicks() {
  const url = URL.createObjectURL(new Blob([pickedNames().join('\n') + '\n'], { type: 'text/plain' }));
  el('a', { href: url, download: 'picks.txt' }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

function drawPicks() {
  byId('picks').hidden = picks.size === 0;
  if (picks.size === 0) return;
  const command = pickCommand();
  fill('picks',
    el('strong', { 'aria-live': 'polite' }, `${picks.size} picked`),
    el('button', { type: 'button', 'aria-pressed': String(chosen.picked), onclick: () => {
      chosen.picked = !chosen.picked;
      update();
      drawPicks();
    } }, 'show these only'),
    el('code', { id: 'pick-command', title: command }, command), copyButton(() => command, 'Copy the command that copies the picked pictures'),
    el('button', { type: 'button', id: 'pick-list', onclick: downloadPicks,
      title: 'a text of their names, for --list' }, 'picks.txt'),
    el('button', { type: 'button', onclick: () => changePicks(() => { picks.clear(); if (chosen.picked) { chosen.picked = false; update(); } }) }, 'clear'));
}
