// What is known of one picture: its scores, its settings as a config, the command that makes it again.

function rankText(job, score) {
  const values = data.jobs.filter((other) => other.exemplar === job.exemplar)
    .map((other) => valueOf(other, score.key)).filter((value) => value !== null);
  if (score.higher === null || values.length < 2) return '';
  const value = valueOf(job, score.key);
  return `${1 + values.filter((other) => compare(score, other, value) < 0).length} of ${values.length}`;
}

function scoreList(job) {
  const there = scores.filter((score) => valueOf(job, score.key) !== null);
  if (there.length === 0) return null;
  return el('table', { class: 'own-scores' },
    el('caption', {}, 'Scores, and their rank among the results of this exemplar'),
    el('tbody', {}, there.map((score) => el('tr', {},
      el('th', { scope: 'row' }, score.label, ' ',
        el('span', { class: 'direction', title: direction(score) }, arrow(score))),
      el('td', {}, show(score, valueOf(job, score.key))),
      el('td', { class: 'rank' }, wasScore(job, score) || rankText(job, score))))));
}

/** Scores of maps have no columns: each kind of map has others. */
function mapScoreList(job) {
  const maps = Object.entries(job.map_metrics ?? {});
  if (maps.length === 0) return null;
  const help = new Map(data.map_metrics.map((metric) => [metric.name, metric.meaning]));
  return el('table', { class: 'own-scores' },
    el('caption', {}, 'Scores of its maps; 0 is as the exemplar\'s'),
    el('tbody', {}, maps.flatMap(([map, values]) => Object.entries(values).map(([name, value]) =>
      el('tr', {}, el('th', { scope: 'row', title: help.get(name) ?? '' }, `${map}: ${name}`),
        el('td', {}, value === null ? '' : String(Number(value.toPrecision(3)))))))));
}

/** A value as TOML. Quoted texts are the same in TOML and JSON, but for U+007F. */
function toToml(value) {
  if (value === 'inf' || value === '-inf') return value;
  if (Array.isArray(value)) return `[${value.map(toToml).join(', ')}]`;
  if (typeof value === 'object')
    return `{ ${Object.entries(value).map(([key, own]) => `${toToml(key)} = ${toToml(own)}`).join(', ')} }`;
  // As an integer it would be beyond TOML's.
  if (Number.isInteger(value) && !Number.isSafeInteger(value)) return value.toExponential();
  if (typeof value === 'string') return JSON.stringify(value).replaceAll('\x7f', '\\u007F');
  return String(value);
}

/** What a config leaves out: what is not set. */
const isSet = (value) => value !== null && value !== undefined && value !== '' &&
  !(Array.isArray(value) && value.length === 0) &&
  !(typeof value === 'object' && !Array.isArray(value) && Object.keys(value).length === 0);
const onlySet = (object) => Object.fromEntries(Object.entries(object)
  .filter(([, value]) => isSet(value)));
const tomlLines = (object) => Object.entries(object).filter(([, value]) => value !== null)
  .map(([key, value]) => `${key} = ${toToml(value)}`);

/** The exemplar as the config has it; none where the picture that is filled is the exemplar. */
function exemplarOf(job, exemplar) {
  const source = data.exemplars.find(({ name }) => name === job.exemplar);
  if (!exemplar || (job.settings.fill && !source?.image)) return [];
  const maps = Object.fromEntries(Object.entries(exemplar.maps ?? {})
    .map(([name, { image }]) => [name, source?.maps?.[name] ?? image]));
  const picture = { image: source?.image ?? exemplar.image, maps,
    mask: source?.mask ?? '', guide: source?.guide ?? '' };
  const pictures = source?.more?.length > 0
    ? { images: [picture, ...source.more].map(onlySet) } : picture;
  return ['', '[[exemplar]]', `name = ${toToml(job.exemplar)}`,
    ...tomlLines(onlySet({ ...pictures, max_side: exemplar.max_side ?? null }))];
}

/** The job's resolved settings as a config that makes this picture and no other. */
function configOf(job) {
  const { method = {}, exemplar, seed, files, guide, mix, turn, fill, surface, preview, previews = {},
    ...rest } = job.settings ?? {};
  if (fill) delete rest.size;  // it has that of its picture
  const asked = Object.keys({ guide, mix, turn, fill })
    .filter((section) => job.settings?.[section] && data.run.direction?.[section]);
  const shown = [preview, ...Object.entries(previews).map(([name, own]) => ({ name, ...own }))];
  return [`seeds = [${seed ?? job.seed}]`, ...tomlLines(rest),
    ...(surface ? ['', '[surface]', ...tomlLines(surface)] : []),
    ...shown.filter(Boolean).flatMap(({ files: hashes, ...own }) =>
      ['', '[[preview]]', ...tomlLines(onlySet(own))]),
    ...asked.flatMap((section) => ['', `[${section}]`, ...tomlLines(onlySet(data.run.direction[section]))]),
    ...exemplarOf(job, exemplar),
    '', '[[method]]', `name = ${toToml(job.method)}`, ...tomlLines(method)].join('\n') + '\n';
}

/** The command that makes this picture again, as its own record has it: another run may have had
 *  other options. Neural results and trainings depend on the threads. */
function commandOf(job) {
  const { config, set, threads } = job.origin;
  const same = threads > 0 ? ['--threads', String(threads)] : [];
  // A training's textures come with its models.
  if (data.run.command[1] === 'train')
    return [data.run.command[0], 'train', config || 'CONFIG', '--resume',
      ...set.flatMap((option) => ['--set', option]), ...same].map(quoted).join(' ');
  return [data.run.command[0] ?? 'gramloom', 'run', config || 'CONFIG', '--only', job.name,
    ...set.flatMap((option) => ['--set', option]),
    ...(job.kind === 'neural' ? same : [])]
    .map(quoted).join(' ');
}

function drawDetails(subject) {
  const job = subject.job;
  if (!job) return el('div', { class: 'details' },
    el('p', {}, `${subject.width} × ${subject.height} pixels, as the methods saw it.`),
    el('p', {}, subject.views.map(({ label, file }, i) =>
      [i ? ', ' : '', el('a', { href: address(file) }, i ? label : 'the picture')])));
  const settings = configOf(job);
  const command = commandOf(job);
  return el('div', { class: 'details' },
    el('p', {}, el('span', { class: job.status === 'done' ? '' : 'bad' }, job.status),
      job.seconds > 0 && ` in ${duration(job.seconds)} s`,
      job.peak_memory_mb > 0 && `, ${Math.round(job.peak_memory_mb)} MB`,
      job.kind === 'neural' && job.machine.threads > 0 && `, ${plural(job.machine.threads, 'thread')}`,
      `. ${subject.width} × ${subject.height} pixels.`),
    job.error && el('p', { class: 'bad error' }, job.error),
    job.score_error && el('p', { class: 'bad error' }, `not scored: ${job.score_error}`),
    view.label === 'copy map' && job.copy_map && el('p', { class: 'small' },
      'The copy map: where in the exemplar each pixel came from. Red grows to the right, green downwards, ' +
      'blue against both. A patch of smooth colour is a piece taken over whole; copied blocks are at full brightness.'),
    scoreList(job),
    mapScoreList(job),
    el('h3', {}, 'Make it again'),
    el('div', { class: 'code' }, el('code', { id: 'command' }, command),
      copyButton(() => command, 'Copy the command')),
    job.origin.edited && el('p', { class: 'small' },
      'The config has changed since: these settings are those of the picture.'),
    job.settings && [el('h3', {}, 'Its settings, as a config'),
      el('div', { class: 'code' }, el('pre', { id: 'settings', tabindex: '0' }, settings),
        copyButton(() => settings, 'Copy the settings')),
      data.run.config && el('p', { class: 'small' }, 'Paths are relative to the folder of ',
        el('code', {}, data.run.config), '.')],
    el('p', { class: 'small' }, 'Files: ',
      [...job.pictures.slice(0, job.pictures.length > 6 ? 1 : 6)  // not every frame of a sequence
        .map(({ label, file }) => [file, label]), [`${job.name}.json`, 'record'],
        [job.trace && `${job.name}.csv`, 'losses']].filter(([file, text]) => file &&
          (text !== 'record' || job.status !== 'waiting'))
        .map(([file, text], i) => [i ? ', ' : '', el('a', { href: address(file) }, text)])));
}
