// What changed against an earlier run (baseline.json): a card a job, and the earlier picture beside the
// new one or under it, behind a slider.

const cards = { shown: 60 };  // more on demand: pictures are what takes time

const wasOf = (job, label) => {
  const pictures = job?.before?.pictures ?? [];
  return pictures.find((picture) => picture.label === label) ?? (label === 'picture' ? pictures[0] : null);
};
const hasBefore = (subject) => (subject?.job?.before?.pictures ?? []).length > 0;
/** Whether the viewer shows this picture against its earlier self. */
const isBefore = (subject) => view.surface === 'before' && hasBefore(subject);

/** Jobs that changed, the worse ones first: {name, verdict, changes, subject or null}. */
function changedJobs() {
  const byJob = new Map();
  const entry = (name) => {
    if (!byJob.has(name))
      byJob.set(name, { name, verdict: 'same', changes: [], subject: subjectById.get(name) ?? null });
    return byJob.get(name);
  };
  const order = ['worse', 'changed', 'better', 'same'];
  for (const change of data.baseline.changes) {
    const job = entry(change.job);
    job.changes.push(change);
    if (order.indexOf(change.verdict) < order.indexOf(job.verdict)) job.verdict = change.verdict;
  }
  for (const job of data.jobs) if (job.before) entry(job.name);
  const worseFirst = (a, b) => order.indexOf(a.verdict) - order.indexOf(b.verdict);
  for (const job of byJob.values()) job.changes.sort(worseFirst);
  return [...byJob.values()].sort(worseFirst);
}

const changeText = ({ what, before, now }) => what === 'job'
  ? (before === '-' ? now : `${before}, now ${now}`)
  : [`${what}: `, before && `${before} → `, now].filter(Boolean).join('');

/** Scores that are others, by however little; those beyond the limits are told as changes already. */
function scoreChanges(job, told) {
  return scores.filter((score) => typeof job?.before?.scores?.[score.key] === 'number' &&
    valueOf(job, score.key) !== null && !told.has(score.key))
    .map((score) => `${score.label} ${show(score, job.before.scores[score.key])} → ${show(score, valueOf(job, score.key))}`)
    .filter((text) => { const [was, is] = text.split(' → '); return !was.endsWith(` ${is}`); });
}

function goneText(was) { return `The earlier picture is no longer there: ${was}`; }

function beforeFigures(subject) {
  if (!hasBefore(subject)) return null;
  const was = wasOf(subject.job, 'picture');
  const size = `--w:${subject.width};--h:${subject.height}`;
  const open = (label) => ({ type: 'button', class: 'picture', style: size, 'aria-label': label,
    onclick: () => openViewer(subject, 'before') });
  const picture = (file, label) => el('button', open(`${label}, ${describe(subject)}: compare`),
    el('img', { src: address(file), loading: 'lazy', decoding: 'async', alt: '', width: subject.width, height: subject.height }));
  return el('div', { class: 'before-and-now' },
    el('figure', {}, was.before ? picture(was.before, 'Before')
      : el('div', { class: 'picture empty', style: size }, el('span', {}, goneText(was.was))),
    el('figcaption', {}, 'before')),
    el('figure', {}, subject.views.length > 0 ? picture(subject.views[0].file, 'Now') : null,
      el('figcaption', {}, 'now')));
}

function changeCard({ name, verdict, changes, subject }) {
  const told = new Set(changes.map(({ what }) => what));
  const small = scoreChanges(subject?.job, told);
  return el('section', { class: 'change', 'aria-label': name },
    el('h3', {}, verdict !== 'same' && el('span', { class: `verdict ${verdict}` }, verdict), ' ',
      subject ? el('button', { type: 'button', class: 'link', onclick: () => openViewer(subject, 'before') }, name) : name),
    beforeFigures(subject),
    el('ul', {}, changes.map((change) => el('li', { class: change.verdict }, changeText(change))),
      small.length > 0 && el('li', { class: 'small' }, `within the limits: ${small.join(', ')}`)));
}

function drawChanges() {
  byId('changes').hidden = byId('to-changes').hidden = !data.baseline;
  if (!data.baseline) return;
  const { folder, worse, changes, old } = data.baseline;
  const jobs = changedJobs();
  const pictures = data.jobs.filter((job) => job.before?.pictures.length > 0).length;
  fill('changes-note', `Compared with ${folder}: `,
    changes.length === 0 ? 'nothing is beyond the limits' : `${plural(changes.length, 'change')}, ${worse} for the worse`,
    old ? '. ' : `; ${plural(pictures, 'picture has', 'pictures have')} other bytes. `,
    old && 'An older gramloom made this comparison and did not note where the earlier pictures are: run again with --baseline to see them.',
    pictures > 0 && 'A click lays both over each other.');
  fill('change-cards', jobs.slice(0, cards.shown).map(changeCard),
    jobs.length > cards.shown && el('p', {}, el('button', { type: 'button', onclick: () => {
      cards.shown = jobs.length;
      drawChanges();
      applyScale();
    } }, `show all ${jobs.length}`)));
}

// --- in the viewer ---------------------------------------------------------------------------------------

const compareBy = { slider: true, cut: 50 };

function compareLayer(file, subject, label, attributes = {}) {
  return el('div', { class: 'layer', 'data-width': subject.width, 'data-height': subject.height, ...attributes },
    el('img', { src: address(file), alt: `${label}: ${describe(subject)}` }));
}

function setCut(cut) {
  compareBy.cut = cut;
  byId('stage').style.setProperty('--cut', `${cut}%`);
}

function drawBeforeStage(subject) {
  const was = wasOf(subject.job, view.label);
  const now = fileOf(subject);
  const tag = (text, side) => el('span', { class: `tag ${side}` }, text);
  const stage = (...children) => el('div', { id: 'stage', tabindex: '0', role: 'group', 'data-keep': 'stage',
    class: `stage compare ${compareBy.slider ? 'over' : 'beside'}`, style: `--cut:${compareBy.cut}%`,
    'aria-label': `${describe(subject)}, before and now` }, children);
  if (!was) return stage(el('div', { class: 'layer message plain' }, view.label === 'copy map'
    ? 'copy maps are not compared' : `${view.label}: the same bytes as before`));
  const old = was.before
    ? compareLayer(was.before, subject, 'before', { class: 'layer old' })
    : el('div', { class: 'layer old message' }, goneText(was.was));
  if (!was.before || !compareBy.slider)
    return stage(el('div', { class: 'half' }, old, tag('before', 'left')),
      el('div', { class: 'half' }, compareLayer(now, subject, 'now'), tag('now', 'left')));
  return stage(compareLayer(now, subject, 'now'), old, tag('before', 'left'), tag('now', 'right'),
    el('input', { id: 'cut', type: 'range', min: 0, max: 100, step: 'any', value: compareBy.cut, 'data-keep': 'cut',
      'aria-label': 'Left of it the earlier picture, right of it the new one',
      oninput: (event) => setCut(Number(event.target.value)) }));
}

function drawBeforeControls() {
  return el('div', { class: 'pair' }, segments('How they are compared',
    [[true, 'slider', 'one over the other'], [false, 'side by side', 'beside each other']],
    () => compareBy.slider, (slider) => { compareBy.slider = slider; redraw(() => {}); }));
}

/** The slider as wide as the picture it cuts. */
function fitBefore() {
  const input = byId('cut');
  const image = byId('stage').querySelector('.layer.old img');
  if (input && image) input.style.width = `calc(${image.style.width} + var(--thumb))`;
}

/** Scores that were others: for the list of scores. */
const wasScore = (job, score) => {
  const was = job.before?.scores?.[score.key];
  return typeof was === 'number' && show(score, was) !== show(score, valueOf(job, score.key)) ? `was ${show(score, was)}` : '';
};
