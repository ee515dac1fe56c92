// The table of scores: a row for each method (means) or for each job, sorted by any column.

const table = { rows: 'methods', column: null, reversed: false };

function meanRows() {
  return data.methods.filter((method) => chosen.methods.has(method)).map((method) => {
    const jobs = shownJobs().filter((job) => job.method === method);
    const values = new Map(scores.map((score) => {
      const there = jobs.map((job) => valueOf(job, score.key)).filter((value) => value !== null);
      return [score.key, there.length ? there.reduce((a, b) => a + b) / there.length : null];
    }));
    const done = jobs.filter((job) => job.status === 'done').length;
    return { method, jobs, values, group: '', note: done < jobs.length ? `${done} of ${jobs.length} done` : '' };
  }).filter((row) => row.jobs.length > 0);
}

function jobRows() {
  return shownJobs().map((job) => ({ method: job.method, job, group: job.exemplar,
    values: new Map(scores.map((score) => [score.key, valueOf(job, score.key)])),
    note: job.status === 'done' ? '' : job.status }));
}

/** The best value of a column, among the rows of one group: values compare within an exemplar. */
function bestOf(rows, score) {
  const bests = new Map();
  for (const group of new Set(rows.map((row) => row.group)))
    bests.set(group, best(score, rows.filter((row) => row.group === group)
      .map((row) => row.values.get(score.key))));
  return bests;
}

function sortRows(rows) {
  const { column, reversed } = table;
  if (column === null) return rows;
  const score = scores.find(({ key }) => key === column);
  const order = (a, b) => (score
    ? compare(score, a.values.get(column), b.values.get(column))
    : String(textOf(a, column)).localeCompare(textOf(b, column), undefined, { numeric: true }));
  const missing = (row) => score && row.values.get(column) === null;
  // Missing values stay last, whichever way the column is sorted.
  return [...rows].sort((a, b) => missing(a) - missing(b) || (reversed ? -1 : 1) * order(a, b));
}
const textOf = (row, column) => (column === 'exemplar' ? row.group
  : column === 'method' ? row.method : String(row.job?.seed ?? ''));

function headCell(key, label, attributes = {}, mark = '') {
  const sorted = table.column === key;
  const score = scores.find((other) => other.key === key);
  // A score's first click puts the best on top.
  const ascending = sorted && (score?.higher ? table.reversed : !table.reversed);
  return el('th', { scope: 'col', 'aria-sort': sorted ? (ascending ? 'ascending' : 'descending') : null,
    ...attributes },
  el('button', { type: 'button', 'data-column': key, onclick: () => {
    table.reversed = sorted && !table.reversed;
    table.column = key;
    drawTable();
    byId('table').querySelector(`[data-column="${CSS.escape(key)}"]`).focus();
  } }, label, mark && el('span', { class: 'direction' }, mark)));
}

function groupsOf(list) {
  const groups = [];
  for (const score of list)
    if (groups.at(-1)?.name === score.group) groups.at(-1).count += 1;
    else groups.push({ name: score.group, count: 1 });
  return groups;
}

const helpOf = (score) => [score.meaning, score.range && `Range: ${score.range}`, direction(score),
  score.fooled_by && `Fooled by: ${score.fooled_by}`].filter(Boolean).join('. ');

function nameCells(row) {
  const open = (label) => el('button', { type: 'button', class: 'link',
    onclick: () => openViewer(subjectById.get(row.job.name)) }, label);
  const method = [swatch(row.method), row.job ? open(row.method) : row.method,
    row.note && el('span', { class: 'bad' }, ` ${row.note}`)];
  if (!row.job) return el('th', { scope: 'row' }, method);
  return [el('th', { scope: 'row' }, row.group), el('td', { class: 'text' }, method),
    seeds.length > 1 && el('td', {}, row.job.seed)];
}

function drawTable() {
  const byMethod = table.rows === 'methods';
  const rows = sortRows(byMethod ? meanRows() : jobRows());
  const several = byMethod && rows.some((row) => row.jobs.length > 1);
  fill('scores-note', scores.every((score) => score.group === 'cost') && 'This run has no scores, only costs. ',
  byMethod
    ? [several ? `Each value is the mean over ${chosen.exemplar ? 'seeds' : 'all exemplars shown'}. ` : '',
      'The best of each column is marked. An arrow says which way is better. ']
    : 'The best of each column is marked, among the results of one exemplar. ',
  'A click on a heading sorts.');
  fill('table-controls', segments('Rows', [['methods', 'a row for each method'],
    ['jobs', 'a row for each picture']], () => table.rows,
  (key) => { table.rows = key; table.column = null; drawTable(); }));
  const names = byMethod ? [['method', 'method']]
    : [['exemplar', 'exemplar'], ['method', 'method'], ...(seeds.length > 1 ? [['seed', 'seed']] : [])];
  const bests = new Map(scores.map((score) => [score.key, bestOf(rows, score)]));
  const same = (score) => new Set(rows.map((row) => show(score, row.values.get(score.key)))).size < 2;
  const cell = (row, score) => {
    const text = show(score, row.values.get(score.key));
    const top = bests.get(score.key).get(row.group);
    const isBest = top !== null && !same(score) && row.values.get(score.key) !== null && text === show(score, top);
    return el('td', { class: isBest ? 'best' : null, 'data-score': score.key }, text,
      isBest && el('span', { class: 'off-screen' }, ' best'));
  };
  fill('table', el('table', {},
    el('thead', {},
      el('tr', { class: 'groups' }, el('td', { colspan: names.length }),
        groupsOf(scores).map((group) => el('th', { scope: 'colgroup', colspan: group.count }, group.name))),
      el('tr', {}, names.map(([key, label]) => headCell(key, label, { class: 'text' })),
        scores.map((score) => headCell(score.key, score.label, { title: helpOf(score) }, arrow(score))))),
    el('tbody', {}, rows.map((row) => el('tr', {}, nameCells(row), scores.map((score) => cell(row, score)))))));
}
