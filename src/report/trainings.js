// What a training has shown of itself: pictures on the way to each model, and its losses.

function lossesOf({ name, trace }) {
  const points = trace.loss.map((loss, i) => [trace.steps[i], loss]).filter(([, loss]) => loss > 0);
  if (points.length < 2) return null;
  const [width, height, left, right, top, bottom] = [640, 200, 52, 628, 20, 164];
  const x = scaleOf([0, ...points.map(([step]) => step)], left, right, { zero: true });
  const y = scaleOf(points.map(([, loss]) => loss), bottom, top, { log: true });
  const svg = frame(width, height, `losses of ${name}`);
  svg.classList.add('loss');
  axisX(svg, x, bottom, top, 'steps');
  axisY(svg, y, left, right, 'loss');
  svg.append(el('path', { fill: 'none', stroke: 'currentColor', 'stroke-width': 1.2,
    d: points.map(([step, loss], i) => `${i ? 'L' : 'M'}${x(step).toFixed(1)},${y(loss).toFixed(1)}`).join('') }));
  return svg;
}

function trainingOf(model) {
  const { name, file, trace, trace_file: traceFile, samples } = model;
  const seconds = trace?.seconds.at(-1), steps = trace?.steps.at(-1);
  return el('section', { class: 'row training', 'aria-label': name }, el('h3', {}, name),
    el('p', { class: 'note' }, el('a', { href: address(file) }, file.split('/').at(-1)),
      trace && [` · ${plural(steps, 'step')} in ${duration(seconds)} s · `,
        el('a', { href: address(traceFile) }, 'losses')]),
    samples.length > 0 && el('div', { class: 'samples' }, samples.map((sample) => el('figure', {},
      el('a', { href: address(sample.file) }, el('img', { src: address(sample.file), loading: 'lazy', decoding: 'async',
        width: sample.width, height: sample.height, alt: '' })),
      el('figcaption', {}, sample.step === null ? 'held out' : `step ${sample.step}`)))),
    trace && el('figure', {}, lossesOf(model)));
}

function drawTrainings() {
  byId('training').hidden = byId('to-training').hidden = data.trainings.length === 0;
  fill('training-rows', data.trainings.map(trainingOf));
}
