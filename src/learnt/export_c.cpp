#include "learnt/export_c.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "learnt/generator_model.h"
#include "learnt/noise.h"

namespace gramloom {

namespace {

// Channels in the code come in groups that a processor works on at once.
constexpr int group = 8;
constexpr int tile_side = 192;  // of what is made at once
int padded(int channels) { return (channels + group - 1) / group * group; }

std::string array(const std::string& name, const std::vector<float>& values) {
  std::string text = fmt::format("static const float {}[{}] = {{", name, values.size());
  std::size_t column = 100;
  for (const float value : values) {
    const std::string number = float_constant(value) + "f,";
    if (column + number.size() > 98) {
      text += "\n ";
      column = 1;
    }
    text += " " + number;
    column += number.size() + 1;
  }
  return text + "\n};\n";
}

// As convolve() reads them: [group of outputs][tap][input][output of the group], inputs and outputs
// padded with zeros.
std::vector<float> in_groups(const PlainLayer& layer, int inputs) {
  std::vector<float> weights;
  for (int first = 0; first < layer.outputs; first += group)
    for (int tap = 0; tap < layer.kernel * layer.kernel; ++tap)
      for (int i = 0; i < inputs; ++i)
        for (int o = first; o < first + group; ++o)
          weights.push_back(o < layer.outputs && i < layer.inputs ? layer.weight(o, i, tap) : 0);
  return weights;
}

std::vector<float> bias_of(const PlainLayer& layer) {
  std::vector<float> bias = layer.bias;
  bias.resize(static_cast<std::size_t>(padded(layer.outputs)), 0.0f);
  return bias;
}

std::string level_arrays(const PlainLevel& level, int k) {
  std::string text;
  for (std::size_t i = 0; i < level.layers.size(); ++i) {
    const PlainLayer& layer = level.layers[i];
    const int inputs = i == 0 ? layer.inputs : padded(layer.inputs);
    text += array(fmt::format("weights_{}_{}", k, i), in_groups(layer, inputs));
    text += array(fmt::format("bias_{}_{}", k, i), bias_of(layer));
  }
  // [output][input]
  std::vector<float> out;
  const int inputs = padded(level.out.inputs);
  for (int o = 0; o < level.out.outputs; ++o)
    for (int i = 0; i < inputs; ++i)
      out.push_back(i < level.out.inputs ? level.out.weight(o, i, 0) : 0);
  text += array(fmt::format("out_{}", k), out);
  text += array(fmt::format("out_bias_{}", k), level.out.bias);
  return text;
}

// The level's convolutions, from `input` to the last layer's values, which it returns.
std::string level_function(const PlainLevel& level, int k) {
  std::string text = fmt::format(
      "/* Leaves what level {0} adds behind the last convolution in `added`. */\n"
      "static void run_level_{0}(const float *input, int width, int height, float *one, float "
      "*other,\n                        float *added) {{\n",
      k);
  const int hidden = padded(level.out.inputs);
  std::string from = "input", to = "one";
  const auto count = static_cast<int>(level.layers.size());
  for (int i = 0; i < count; ++i) {
    text += fmt::format(
        "  convolve({}, width - {}, height - {}, {}, {}, weights_{}_{}, bias_{}_{}, "
        "{}, {});\n",
        from, 2 * i, 2 * i, i == 0 ? level.layers[0].inputs : hidden, hidden, k, i, k, i,
        i == 0 ? 0 : 1, to);
    from = to;
    to = from == "one" ? "other" : "one";
  }
  text += fmt::format(
      "  mix({}, (size_t)(width - {}) * (height - {}), {}, out_{}, out_bias_{}, "
      "added);\n}}\n\n",
      from, 2 * count, 2 * count, hidden, k, k);
  if (count == 1) text.insert(text.find("{\n") + 2, "  (void)other;\n");
  return text;
}

template <class Value>
std::string table(const char* name, const PlainGenerator& generator, const Value& value) {
  std::string text = fmt::format("static const int {}[LEVELS] = {{", name);
  for (int k = 0; k < generator.level_count(); ++k)
    text += fmt::format("{}{}", k > 0 ? ", " : "",
                        value(generator.levels[static_cast<std::size_t>(k)]));
  return text + "};\n";
}

constexpr const char* introduction = R"c(
   int NAME_generate(float *pixels, int width, int height, unsigned seed, int tile);

 fills `pixels` with height rows of width pixels of @CHANNELS@ channels, from the top (@MEANING@).
 Each seed (32 bits) gives another picture. `tile`: 1 makes its left and right edges meet, 2 its
 upper and lower ones, 3 both. Returns 0; or 1 for a side below 1, or where memory is lacking (it
 needs about @MEMORY@ MB, whatever the size). No value is kept between calls: any number of threads
 may call it. Make a smaller part of a large picture by NAME_part(), whose pixels are the same.

 As a program (it writes .ppm, of 8 bits, or .pfm):
   cc -O3 -march=native -DGRAMLOOM_MAIN -o NAME NAME.c
   ./NAME WIDTH HEIGHT SEED TILE FILE

 The pictures are those of `gramloom run` with the method "generator": no value differs by more than
 @TOLERANCE@ of its channel's range. */
)c";

constexpr const char* before_arrays = R"c(
#include <stdlib.h>

int NAME_generate(float *pixels, int width, int height, unsigned seed, int tile);
int NAME_part(float *pixels, int left, int top, int width, int height, int whole_width,
              int whole_height, unsigned seed, int tile);

)c";

constexpr const char* convolution = R"c(
/* Eight channels at once: what compilers other than GCC and Clang make of the loop is their affair. */
#if defined(__GNUC__) && !defined(GRAMLOOM_NO_VECTORS)
typedef float Eight __attribute__((vector_size(32), aligned(4), may_alias));
#define ADD_TIMES(sum, value, weights) (sum) += (value) * *(const Eight *)(weights)
#define LOAD(sum, values) (sum) = *(const Eight *)(values)
#define AT(sum, i) ((sum)[i])
#else
typedef struct { float values[8]; } Eight;
#define ADD_TIMES(sum, value, weights) \
  do { int o_; for (o_ = 0; o_ < 8; ++o_) (sum).values[o_] += (value) * (weights)[o_]; } while (0)
#define LOAD(sum, from) \
  do { int o_; for (o_ = 0; o_ < 8; ++o_) (sum).values[o_] = (from)[o_]; } while (0)
#define AT(sum, i) ((sum).values[i])
#endif

/* 3 x 3, without a border: `to` has two rows and two columns less. Then a leaky ReLU, and what was
   there before. Four pixels at once: up to three beyond a row's end are read, and forgotten. */
static void convolve(const float *restrict from, int width, int height, int inputs, int outputs,
                     const float *restrict weights, const float *restrict bias, int residual,
                     float *restrict to) {
  int first, x, y, dy, i, o;
  for (first = 0; first < outputs; first += 8)
    for (y = 0; y < height - 2; ++y)
      for (x = 0; x < width - 2; x += 4) {
        const float *w = weights + (size_t)9 * inputs * first;
        Eight sums[4];
        LOAD(sums[0], bias + first);
        sums[1] = sums[2] = sums[3] = sums[0];
        for (dy = 0; dy < 3; ++dy) {
          const float *pixel = from + ((size_t)(y + dy) * width + x) * inputs;
          for (i = 0; i < 3 * inputs; ++i, w += 8) {
            ADD_TIMES(sums[0], pixel[i], w);
            ADD_TIMES(sums[1], pixel[i + inputs], w);
            ADD_TIMES(sums[2], pixel[i + 2 * inputs], w);
            ADD_TIMES(sums[3], pixel[i + 3 * inputs], w);
          }
        }
        for (i = 0; i < 4 && x + i < width - 2; ++i) {
          float *out = to + ((size_t)y * (width - 2) + x + i) * outputs + first;
          const float *before = from + ((size_t)(y + 1) * width + x + i + 1) * inputs + first;
          for (o = 0; o < 8; ++o) {
            const float value = AT(sums[i], o);
            out[o] = (value > 0 ? value : SLOPE * value) + (residual ? before[o] : 0);
          }
        }
      }
}

static void mix(const float *from, size_t pixels, int inputs, const float *weights,
                const float *bias, float *to) {
  for (; pixels > 0; --pixels, from += inputs, to += CHANNELS) {
    int c, i;
    for (c = 0; c < CHANNELS; ++c) {
      float sum = bias[c];
      for (i = 0; i < inputs; ++i) sum += weights[c * inputs + i] * from[i];
      to[c] = sum;
    }
  }
}

)c";

constexpr const char* drawing = R"c(
/* An axis of a level: its length where the picture tiles, half of the next finer level's, rounded
   up, and that of the next coarser one; or 0, where it has no end. */
typedef struct { long long length, coarser; } Axis;

typedef struct {
  Axis x[LEVELS], y[LEVELS];
  unsigned seed;
  float *input[LEVELS], *one[LEVELS], *other[LEVELS], *picture[LEVELS], *line[LEVELS];
} Work;

static void set_axis(Axis *axis, int length, int tiles) {
  long long own = length;
  int k;
  for (k = LEVELS - 1; k >= 0; --k) {
    axis[k].length = tiles ? own : 0;
    own = (own + 1) / 2;
    axis[k].coarser = tiles ? own : 0;
  }
}

/* Pixel x lies between the coarser level's pixel that is returned and the next, by `share` nearer
   to that. */
static long long between(Axis axis, long long x, float *share) {
  const long long fine = axis.length ? axis.length : 2, coarse = axis.length ? axis.coarser : 1;
  const long long above = (2 * x + 1) * coarse - fine, below = 2 * fine;
  const long long rest = (above % below + below) % below;
  *share = (float)rest / (float)below;
  return (above - rest) / below;
}

/* How many pixels of the coarser level any `count` pixels lie between, at most. */
static int coarser_most(Axis axis, int count) {
  const long long fine = axis.length ? axis.length : 2, coarse = axis.length ? axis.coarser : 1;
  return (int)((count * coarse + fine - 1) / fine) + 2;
}

static unsigned place(Axis axis, long long x) {
  return (unsigned)(axis.length ? (x % axis.length + axis.length) % axis.length : x);
}

/* Four channels of noise of a pixel: PCG4D (Jarzynski and Olano 2020), uniform, of variance 1. */
static void noise(unsigned x, unsigned y, unsigned z, unsigned w, float *to) {
  const float root = 1.7320508f, step = 2 * root / 16777216.0f;
  x = x * 1664525u + 1013904223u, y = y * 1664525u + 1013904223u;
  z = z * 1664525u + 1013904223u, w = w * 1664525u + 1013904223u;
  x += y * w, y += z * x, z += x * y, w += y * z;
  x ^= x >> 16, y ^= y >> 16, z ^= z >> 16, w ^= w >> 16;
  x += y * w, y += z * x, z += x * y, w += y * z;
  to[0] = (float)(x >> 8) * step - root;
  to[1] = (float)(y >> 8) * step - root;
  to[2] = (float)(z >> 8) * step - root;
  to[3] = (float)(w >> 8) * step - root;
}

/* The picture of level k on this rectangle, in work->picture[k]. */
static void make_level(Work *work, int k, long long left, long long top, int width, int height) {
  const int border = layers_of[k], inputs = noise_of[k] + (k > 0 ? CHANNELS : 0);
  const int across = width + 2 * border, down = height + 2 * border;
  const int first = k > 0 ? CHANNELS : 0; /* of the noise */
  const Axis x_axis = work->x[k], y_axis = work->y[k];
  float *input = work->input[k], *picture = work->picture[k];
  int x, y, c;
  left -= border, top -= border;
  if (k > 0) {
    float share;
    const long long x0 = between(x_axis, left, &share), y0 = between(y_axis, top, &share);
    const int columns = (int)(between(x_axis, left + across - 1, &share) - x0) + 2;
    const int rows = (int)(between(y_axis, top + down - 1, &share) - y0) + 2;
    float *line = work->line[k];
    make_level(work, k - 1, x0, y0, columns, rows);
    for (y = 0; y < down; ++y) {
      const long long row = between(y_axis, top + y, &share) - y0;
      const float *above = work->picture[k - 1] + (size_t)row * columns * CHANNELS;
      const float *below = above + (size_t)columns * CHANNELS;
      for (c = 0; c < columns * CHANNELS; ++c) line[c] = above[c] + share * (below[c] - above[c]);
      for (x = 0; x < across; ++x) {
        float nearer;
        const float *before = line + (between(x_axis, left + x, &nearer) - x0) * CHANNELS;
        float *to = input + ((size_t)y * across + x) * inputs;
        for (c = 0; c < CHANNELS; ++c)
          to[c] = before[c] + nearer * (before[c + CHANNELS] - before[c]);
      }
    }
  }
  for (y = 0; y < down; ++y)
    for (x = 0; x < across; ++x) {
      float *to = input + ((size_t)y * across + x) * inputs + first;
      for (c = 0; c < noise_of[k]; c += 4)
        noise(place(x_axis, left + x), place(y_axis, top + y), work->seed,
              (unsigned)(GROUPS * k + c / 4), to + c);
    }
  run_level(k, input, across, down, work->one[k], work->other[k], picture);
  if (k > 0)
    for (y = 0; y < height; ++y)
      for (x = 0; x < width; ++x) {
        const float *coarser = input + ((size_t)(y + border) * across + x + border) * inputs;
        float *to = picture + ((size_t)y * width + x) * CHANNELS;
        for (c = 0; c < CHANNELS; ++c) to[c] += coarser[c];
      }
}

static float *numbers(size_t count, float **from) {
  float *here = *from;
  if (here) *from += count;
  return here;
}

/* Parts the memory among the levels, or counts what they need where there is none. */
static size_t share_out(Work *work, float *memory, int width, int height) {
  size_t sum = 0;
  int k;
  for (k = LEVELS - 1; k >= 0; --k) {
    const int across = width + 2 * layers_of[k], down = height + 2 * layers_of[k];
    const size_t pixels = (size_t)across * down + 8; /* convolve() reads beyond */
    const size_t wide = hidden_of[k], inputs = noise_of[k] + (k > 0 ? CHANNELS : 0);
    work->input[k] = numbers(pixels * inputs, &memory);
    work->one[k] = numbers(pixels * wide, &memory);
    work->other[k] = numbers(pixels * wide, &memory);
    work->picture[k] = numbers((size_t)width * height * CHANNELS, &memory);
    width = coarser_most(work->x[k], across);
    height = coarser_most(work->y[k], down);
    work->line[k] = numbers((size_t)width * CHANNELS, &memory);
    sum += pixels * (inputs + 2 * wide) + (size_t)across * down * CHANNELS + (size_t)width * CHANNELS;
  }
  return sum;
}

static float clamp(float value, float low, float high) {
  return value < low ? low : value > high ? high : value;
}

static void colour(const float *values, float *pixel) {
  int c, i;
  for (c = 0; c < CHANNELS; ++c) {
    float sum = colour_mean[c];
    for (i = 0; i < CHANNELS; ++i) sum += colour_axes[c * CHANNELS + i] * values[i];
    pixel[c] = clamp(sum, colour_low[c], colour_high[c]);
  }
}

/* The pixels from (left, top) on of a picture of whole_width x whole_height. */
int NAME_part(float *pixels, int left, int top, int width, int height, int whole_width,
              int whole_height, unsigned seed, int tile) {
  Work work;
  float *memory;
  int x, y, i, j;
  const int across = width < TILE ? width : TILE, down = height < TILE ? height : TILE;
  if (width < 1 || height < 1 || whole_width < 1 || whole_height < 1) return 1;
  set_axis(work.x, whole_width, tile & 1);
  set_axis(work.y, whole_height, tile & 2);
  work.seed = seed;
  memory = calloc(share_out(&work, NULL, across, down), sizeof(float));
  if (!memory) return 1;
  share_out(&work, memory, across, down);
  for (y = 0; y < height; y += TILE)
    for (x = 0; x < width; x += TILE) {
      const int columns = width - x < TILE ? width - x : TILE;
      const int rows = height - y < TILE ? height - y : TILE;
      make_level(&work, LEVELS - 1, (long long)left + x, (long long)top + y, columns, rows);
      for (j = 0; j < rows; ++j)
        for (i = 0; i < columns; ++i)
          colour(work.picture[LEVELS - 1] + ((size_t)j * columns + i) * CHANNELS,
                 pixels + ((size_t)(y + j) * width + x + i) * CHANNELS);
    }
  free(memory);
  return 0;
}

int NAME_generate(float *pixels, int width, int height, unsigned seed, int tile) {
  return NAME_part(pixels, 0, 0, width, height, width, height, seed, tile);
}

#ifdef GRAMLOOM_MAIN
#include <stdio.h>
#include <string.h>

static int write_picture(const float *pixels, int width, int height, const char *file) {
  const int grey = CHANNELS < 3, own = grey ? 1 : 3;
  const int floats = strlen(file) > 4 && !strcmp(file + strlen(file) - 4, ".pfm");
  FILE *out = fopen(file, "wb");
  int x, y, c;
  if (!out) return 1;
  if (floats)
    fprintf(out, "%s\n%d %d\n-1.0\n", grey ? "Pf" : "PF", width, height); /* little-endian */
  else
    fprintf(out, "%s\n%d %d\n255\n", grey ? "P5" : "P6", width, height);
  for (y = 0; y < height; ++y)
    for (x = 0; x < width; ++x) {
      const size_t row = floats ? height - 1 - y : y;
      const float *pixel = pixels + (row * width + x) * CHANNELS;
      if (floats)
        fwrite(pixel, sizeof(float), own, out);
      else
        for (c = 0; c < own; ++c) fputc((int)(clamp(pixel[c], 0, 1) * 255 + 0.5f), out);
    }
  x = ferror(out);
  return fclose(out) || x;
}

int main(int count, char **words) {
  const int width = count == 6 ? atoi(words[1]) : 0, height = count == 6 ? atoi(words[2]) : 0;
  float *pixels;
  if (width < 1 || height < 1) {
    fprintf(stderr, "usage: %s WIDTH HEIGHT SEED TILE FILE\n", words[0]);
    return 2;
  }
  pixels = malloc((size_t)width * height * CHANNELS * sizeof(float));
  if (!pixels || NAME_generate(pixels, width, height, (unsigned)strtoul(words[3], NULL, 10),
                               atoi(words[4]))) {
    fprintf(stderr, "%s: out of memory\n", words[0]);
    return 1;
  }
  if (write_picture(pixels, width, height, words[5])) {
    fprintf(stderr, "%s: %s cannot be written\n", words[0], words[5]);
    return 1;
  }
  free(pixels);
  return 0;
}
#endif
)c";

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

// What NAME_part() takes, about: the finest level's values, and less of the coarser ones.
double memory_of(const PlainGenerator& generator) {
  double bytes = 0, side = tile_side;
  for (int k = generator.level_count() - 1; k >= 0; --k) {
    const PlainLevel& level = generator.levels[static_cast<std::size_t>(k)];
    side += 2.0 * static_cast<double>(level.layers.size());
    bytes += 4 * side * side *
             (level.layers[0].inputs + 2 * padded(level.out.inputs) + generator.channels);
    side = side / 2 + 2;
  }
  return bytes;
}

std::string comment(const PlainGenerator& generator, const std::string& program) {
  std::string text =
      fmt::format("/* {}: a texture generator of {} numbers, exported by {}.",
                  comment_text(generator.title), generator.weight_count(), comment_text(program));
  if (!generator.licence.empty())
    text += fmt::format("\n Licence of what it has learnt: {}.", comment_text(generator.licence));
  text += introduction;
  replace_all(text, "@CHANNELS@", fmt::format("{}", generator.channels));
  replace_all(text, "@MEANING@", comment_text(channel_names(generator)));
  replace_all(text, "@MEMORY@", fmt::format("{:.0f}", std::ceil(memory_of(generator) / 1e6)));
  replace_all(text, "@TOLERANCE@", fmt::format("{}", export_c_tolerance));
  return text;
}

std::string run_level(int levels) {
  std::string text =
      "static void run_level(int k, const float *input, int width, int height, float *one, float "
      "*other,\n                      float *added) {\n  switch (k) {\n";
  for (int k = 0; k < levels; ++k)
    text += fmt::format(
        "    case {}: run_level_{}(input, width, height, one, other, added); break;\n", k, k);
  return text + "  }\n}\n";
}

}  // namespace

std::string export_c(const PlainGenerator& generator, const std::string& name,
                     const std::string& program) {
  std::string text = comment(generator, program) + before_arrays;
  text += fmt::format(
      "enum {{ CHANNELS = {}, LEVELS = {}, TILE = {}, GROUPS = {} }};\n"
      "#define SLOPE {}f\n",
      generator.channels, generator.level_count(), tile_side, noise_groups_per_level,
      float_constant(leaky_slope));
  text += table("noise_of", generator, [](const PlainLevel& level) { return level.noise; });
  text +=
      table("layers_of", generator, [](const PlainLevel& level) { return level.layers.size(); });
  text += table("hidden_of", generator,
                [](const PlainLevel& level) { return padded(level.out.inputs); });
  text += "\n/* Of convolutions: [group of 8 outputs][tap][input][output]. */\n";
  for (int k = 0; k < generator.level_count(); ++k)
    text += level_arrays(generator.levels[static_cast<std::size_t>(k)], k);
  text += array("colour_mean", generator.mean) + array("colour_axes", generator.axes) +
          array("colour_low", generator.low) + array("colour_high", generator.high);
  text += convolution;
  for (int k = 0; k < generator.level_count(); ++k)
    text += level_function(generator.levels[static_cast<std::size_t>(k)], k);
  text += run_level(generator.level_count()) + drawing;
  replace_all(text, "NAME", name);
  return text;
}

}  // namespace gramloom
