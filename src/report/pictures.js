// A row of pictures for each exemplar, all at the same scale.

/** Everything that has a picture: {id, exemplar, job or null, title, width, height, views}. */
const jobsOf = new Map(data.exemplars.map(({ name }) => [name, []]));
for (const job of data.jobs) jobsOf.get(job.exemplar)?.push(job);
const subjects = data.exemplars.flatMap((exemplar) => [
  ...(exemplar.picture ? [{ id: exemplar.name, exemplar: exemplar.name, job: null,
    title: 'exemplar', view: exemplar.view, width: exemplar.picture.width, height: exemplar.picture.height,
    views: [{ label: 'picture', file: exemplar.picture.file }, ...exemplar.map_pictures] }] : []),
  ...jobsOf.get(exemplar.name).map((job) => ({
    id: job.name, exemplar: exemplar.name, job, title: jobLabel(job),
    width: job.width ?? 128, height: job.height ?? 128,
    views: [...job.pictures.slice(0, 1),
      ...(job.copy_map ? [{ label: 'copy map', file: job.copy_map }] : []),
      ...job.pictures.slice(1)],
  })),
]);
const subjectsOf = new Map(data.exemplars.map(({ name }) => [name, []]));
for (const subject of subjects) subjectsOf.get(subject.exemplar).push(subject);
const subjectById = new Map(subjects.map((subject) => [subject.id, subject]));
const describe = (subject) => subject.job
  ? `${subject.exemplar} by ${subject.title}` : `the exemplar ${subject.exemplar}`;

/** Why a job has no picture to show. */
function stateOf(job) {
  if (job.status === 'failed') return ['failed', job.error];
  if (job.status === 'done') return ['no picture', 'its file is missing or broken'];
  if (job.status === 'waiting') return ['waiting', 'not begun'];
  return [job.status, job.error];
}

function pictureOf(subject) {
  const size = `--w:${subject.width};--h:${subject.height}`;
  const open = { type: 'button', class: 'picture', style: size, 'data-id': subject.id,
    'aria-label': `Enlarge ${describe(subject)}`, onclick: () => openViewer(subject) };
  if (subject.views.length > 0)
    return el('button', open, el('img', { src: address(subject.views[0].file), loading: 'lazy',
      decoding: 'async', width: subject.width, height: subject.height, alt: describe(subject) }));
  const [state, why] = stateOf(subject.job);
  const failed = subject.job.status === 'failed';
  const first = failed && data.jobs.find((job) => job.status === 'failed') === subject.job;
  return el('button', { ...open, class: `picture empty ${failed ? 'failed' : ''}`,
    id: first ? 'first-failed' : null, 'aria-label': `${describe(subject)}: ${state}, ${why}` },
  el('strong', {}, state), el('span', {}, why));
}

function captionOf(subject, score, bestValue) {
  if (!subject.job)
    return el('figcaption', {}, el('span', { class: 'name' }, 'exemplar'),
      el('span', { class: 'value' }, `${subject.width} × ${subject.height}`));
  const value = score ? valueOf(subject.job, score.key) : null;
  const shown = value === null ? '' : show(score, value);
  const isBest = shown && bestValue !== null && shown === show(score, bestValue);
  return el('figcaption', {}, el('span', { class: 'name' }, swatch(subject.job.method), subject.title),
    pickButton(subject),
    subject.job.status === 'interrupted' && el('span', { class: 'bad' }, 'unfinished'),
    el('span', { class: isBest ? 'value best' : 'value', title: isBest ? 'best of this row' : null },
      shown));
}

function rowOf(exemplar) {
  const own = subjectsOf.get(exemplar.name);
  const results = own.filter((subject) => subject.job && isShown(subject.job));
  const score = chosenScore();
  const bestValue = score ? best(score, results.map(({ job }) => valueOf(job, score.key))) : null;
  const figure = (subject) => el('figure', {}, pictureOf(subject),
    captionOf(subject, score, bestValue));
  const source = own.find((subject) => !subject.job);
  return el('section', { class: 'row', 'aria-label': exemplar.name },
    el('h3', {}, exemplar.name),
    el('div', { class: source ? 'figures' : 'figures sourceless' },
      source && el('div', { class: 'source' }, figure(source)),
      el('div', { class: 'results' }, results.map(figure))));
}

/** CSS pixels a pixel: as asked, or what shows the widest picture well; never wider than the window. */
function scaleFor(available) {
  const widest = subjects.reduce((most, { width }) => Math.max(most, width), 1);
  const fits = available / widest;
  if (chosen.scale !== 'auto') return Math.min(Number(chosen.scale), fits);
  if (available < 640) {  // a phone: two a row where that leaves something to see
    const two = (available - 12) / 2 / widest;
    return two >= 1 ? Math.floor(two) : two >= 0.6 ? two : Math.min(1, fits);
  }
  if (widest > 256) return Math.min(1 / Math.ceil(widest / 256), fits);
  return Math.min(Math.max(1, Math.floor(160 / widest)), fits);
}

function applyScale() {
  const scale = scaleFor(byId('rows').clientWidth);
  document.documentElement.style.setProperty('--scale', scale);
  document.body.classList.toggle('smooth-rows', scale * devicePixelRatio < 1);
}

function drawRows() {
  const score = chosenScore();
  const help = score && [`Under each picture: ${score.label}, ${direction(score)}; the best of a row is bold. `,
    score.fooled_by && [el('a', { href: `#score-${score.key}` }, 'What fools it'), '. ']];
  fill('pictures-note', 'All at the same scale. A click enlarges, flips between any two, and tiles; p picks, ? lists the keys. ',
    help ?? '');
  const exemplars = shownExemplars();
  if (exemplars.length > 0) fill('rows', exemplars.map(rowOf));
  else fill('rows', el('p', { class: 'note' }, 'Nothing is chosen.'));
  applyScale();
}
