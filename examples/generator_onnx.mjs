// A texture of an exported generator in onnxruntime, on the processor:
//   gramloom export MODEL --target onnx --output pebbles.onnx
//   npm install onnxruntime-node
//   node generator_onnx.mjs pebbles.onnx WIDTH HEIGHT SEED TILE pebbles.pfm
// TILE: 0, 1 (left and right edges meet), 2 (upper and lower) or 3; sides that tile must be multiples
// of 2 to the power of the levels after the first. The file's documentation says what is done here.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';

/** What the generator's levels are, coarse to fine: [{noise: channels, border}]. */
function levelsOf(file) {
  const text = readFileSync(file).toString('latin1');
  const from = text.indexOf('{"channels":', text.lastIndexOf('gramloom'));
  return JSON.parse(text.slice(from, text.indexOf('}]}', from) + 3)).levels;
}

/** One axis for pixels [0, length): where each level's noise begins and how long it is. */
function frameOf(levels, length) {
  let first = 0, end = length;
  for (let k = levels.length - 1; k > 0; --k) {
    first = Math.floor((first - 1 - levels[k].border) / 2);
    end = Math.ceil((end + 1 + levels[k].border) / 2);
  }
  const parts = levels.map(({ border }, k) => {
    if (k > 0) [first, end] = [2 * first + 1 + border, 2 * end - 1 - border];
    return { first: first - border, length: end - first + 2 * border };
  });
  return { parts, skipped: -first };
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

/** Noise of level k as (1, channels, height, width); `wrap`: the level's length, or 0. */
function noiseOf(k, level, x, y, seed, wrap) {
  const place = (i, length) => (length ? ((i % length) + length) % length : i);
  const values = new Float32Array(level.noise * y.length * x.length);
  for (let row = 0; row < y.length; ++row)
    for (let column = 0; column < x.length; ++column)
      for (let group = 0; group < level.noise / 4; ++group)
        noise(place(x.first + column, wrap.x), place(y.first + row, wrap.y), seed, 64 * k + group)
          .forEach((value, i) => {
            values[((4 * group + i) * y.length + row) * x.length + column] = value;
          });
  return values;
}

const [file, ...words] = process.argv.slice(2);
const [width, height, seed, tile] = words.map(Number);
const output = words[4];
// From where it is installed: beside this file, or in the folder that we are in.
const ort = createRequire(`${process.cwd()}/`)('onnxruntime-node');
const levels = levelsOf(file);
const [across, down] = [frameOf(levels, width), frameOf(levels, height)];
const inputs = {};
levels.forEach((level, k) => {
  const share = 2 ** (levels.length - 1 - k);
  const wrap = { x: tile & 1 ? width / share : 0, y: tile & 2 ? height / share : 0 };
  const [x, y] = [across.parts[k], down.parts[k]];
  inputs[`noise_${k}`] = new ort.Tensor('float32', noiseOf(k, level, x, y, seed, wrap),
    [1, level.noise, y.length, x.length]);
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
