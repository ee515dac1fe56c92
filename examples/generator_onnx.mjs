// A texture of an exported generator in onnxruntime, on the processor:
//   gramloom export MODEL --target onnx --output pebbles.onnx
//   npm install onnxruntime-node
//   node generator_onnx.mjs pebbles.onnx WIDTH HEIGHT SEED TILE pebbles.pfm
// TILE: 0, 1 (left and right edges meet), 2 (upper and lower) or 3; sides that tile must be multiples
// of 2 to the power of the levels after the first. The file's documentation says what is done here.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';

/** What gramloom has written of the generator: {channels, margin, noise: channels of each level}. */
function descriptionOf(file) {
  const text = readFileSync(file).toString('latin1');
  const from = text.lastIndexOf('{"channels":');
  return JSON.parse(text.slice(from, text.indexOf(']}', from) + 2));
}

/** One axis for pixels [0, length): where the coarsest noise begins, how long it is, what is left out. */
function frameOf({ margin, noise: levels }, length) {
  const scale = 2 ** (levels.length - 1), before = Math.ceil(margin / scale);
  return { first: -before, length: Math.ceil(length / scale) + 2 * before, skipped: before * scale };
}

/** Four channels of noise: PCG4D. */
function noise(x, y, seed, group) {
  let [a, b, c, d] = [x, y, seed, group].map((v) => (Math.imul(v, 1664525) + 1013904223) | 0);
  const mix = () => {
    a = (a + Math.imul(b, d)) | 0; b = (b + Math.imul(c, a)) | 0;
    c = (c + Math.imul(a, b)) | 0; d = (d + Math.imul(b, c)) | 0;
  };
  mix();
  a ^= a >>> 16; b ^= b >>> 16; c ^= c >>> 16; d ^= d >>> 16;
  mix();
  return [a, b, c, d].map((v) => (v >>> 8) * (2 * Math.sqrt(3) / 16777216) - Math.sqrt(3));
}

/** Noise of level k as a tensor; `wrap`: the level's length where the picture tiles, or 0. */
function noiseOf(k, channels, across, down, seed, wrap) {
  const place = (i, length) => (length ? ((i % length) + length) % length : i);
  const [columns, rows] = [across.length << k, down.length << k];
  const values = new Float32Array(channels * rows * columns);
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const x = place(across.first * 2 ** k + column, wrap.x), y = place(down.first * 2 ** k + row, wrap.y);
      for (let group = 0; group < channels / 4; ++group)
        noise(x, y, seed, 64 * k + group).forEach((value, i) => {
          values[((4 * group + i) * rows + row) * columns + column] = value;
        });
    }
  return new ort.Tensor('float32', values, [1, channels, rows, columns]);
}

const [file, ...words] = process.argv.slice(2);
const [width, height, seed, tile] = words.map(Number);
const output = words[4];
// From where it is installed: beside this file, or in the folder that we are in.
const ort = createRequire(`${process.cwd()}/`)('onnxruntime-node');
const description = descriptionOf(file);
const unit = 2 ** (description.noise.length - 1);
for (const [side, bit, name] of [[width, 1, 'width'], [height, 2, 'height']])
  if (tile & bit && side % unit !== 0) {
    console.error(`${name} ${side}: a side that tiles must be a multiple of ${unit}`);
    process.exit(2);
  }
const [across, down] = [frameOf(description, width), frameOf(description, height)];
const inputs = {};
description.noise.forEach((channels, k) => {
  const share = 2 ** (description.noise.length - 1 - k);
  const wrap = { x: tile & 1 ? width / share : 0, y: tile & 2 ? height / share : 0 };
  inputs[`noise_${k}`] = noiseOf(k, channels, across, down, seed, wrap);
});
const session = await ort.InferenceSession.create(file);
const started = performance.now();
const { picture } = await session.run(inputs);
console.log(`${picture.dims.join(' × ')} in ${((performance.now() - started) / 1000).toFixed(3)} s`);

// The rows of a .pfm begin at the bottom; of other than one channel the first three are shown.
const [, channels, rows, columns] = picture.dims;
const shown = channels < 3 ? 1 : 3;
const pixels = new Float32Array(width * height * shown);
for (let y = 0; y < height; ++y)
  for (let x = 0; x < width; ++x)
    for (let c = 0; c < shown; ++c)
      pixels[((height - 1 - y) * width + x) * shown + c] =
        picture.data[(c * rows + y + down.skipped) * columns + x + across.skipped];
writeFileSync(output, Buffer.concat([
  Buffer.from(`${shown === 1 ? 'Pf' : 'PF'}\n${width} ${height}\n-1.0\n`), Buffer.from(pixels.buffer)]));
