#include "learnt/export_onnx.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "io/json_text.h"
#include "learnt/noise.h"

namespace gramloom {

namespace {

// --- protocol buffers: fields one after the other, each behind its number and what it holds
// --------

class Message {
 public:
  Message& number(int field, std::uint64_t value) {
    key(field, 0);
    varint(value);
    return *this;
  }
  Message& real(int field, float value) {
    key(field, 5);
    append(&value, sizeof value);
    return *this;
  }
  Message& text(int field, std::string_view bytes) {
    key(field, 2);
    varint(bytes.size());
    bytes_ += bytes;
    return *this;
  }
  Message& message(int field, const Message& inner) { return text(field, inner.bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  void key(int field, unsigned type) { varint(static_cast<unsigned>(field) << 3 | type); }
  void varint(std::uint64_t value) {
    for (; value > 127; value >>= 7) bytes_ += static_cast<char>((value & 127) | 128);
    bytes_ += static_cast<char>(value);
  }
  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

// --- ONNX: the numbers of fields are those of onnx.proto
// ---------------------------------------------

constexpr int float_type = 1, int64_type = 7;

template <class T>
Message tensor(const std::string& name, const std::vector<std::int64_t>& shape,
               const std::vector<T>& values) {
  Message message;
  for (const std::int64_t side : shape) message.number(1, static_cast<std::uint64_t>(side));
  message.number(2, std::is_same_v<T, float> ? float_type : int64_type).text(8, name);
  std::string raw(values.size() * sizeof(T), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  return message.text(9, raw);
}

Message described(const std::string& name, int channels, const std::string& height,
                  const std::string& width) {
  Message shape;
  shape.message(1, Message().number(1, 1));
  shape.message(1, Message().number(1, static_cast<std::uint64_t>(channels)));
  shape.message(1, Message().text(2, height));
  shape.message(1, Message().text(2, width));
  const Message type = Message().number(1, float_type).message(2, shape);
  return Message().text(1, name).message(2, Message().message(1, type));
}

Message attribute(const std::string& name, float value) {
  return Message().text(1, name).real(2, value).number(20, 1);
}
Message attribute(const std::string& name, std::uint64_t value) {
  return Message().text(1, name).number(3, value).number(20, 2);
}
Message attribute(const std::string& name, const std::vector<int>& values) {
  Message message;
  message.text(1, name);
  for (const int value : values) message.number(8, static_cast<std::uint64_t>(value));
  return message.number(20, 7);
}

// A graph that grows: each function adds a node, and returns the name of what it puts out.
class Graph {
 public:
  std::string node(const std::string& kind, const std::vector<std::string>& inputs,
                   const std::vector<Message>& attributes = {}, std::string output = "") {
    if (output.empty()) output = fmt::format("{}_{}", kind, count_++);
    Message message;
    for (const std::string& input : inputs) message.text(1, input);
    message.text(2, output).text(3, "make_" + output).text(4, kind);
    for (const Message& own : attributes) message.message(5, own);
    graph_.message(1, message);
    return output;
  }
  template <class T>
  std::string constant(const std::vector<std::int64_t>& shape, const std::vector<T>& values) {
    const std::string name = fmt::format("constant_{}", constants_++);
    graph_.message(5, tensor(name, shape, values));
    return name;
  }
  std::string convolution(const std::string& from, const PlainLayer& layer,
                          const std::string& output = "") {
    const std::string weights =
        constant({layer.outputs, layer.inputs, layer.kernel, layer.kernel}, layer.weights);
    const std::string bias = constant({layer.outputs}, layer.bias);
    return node("Conv", {from, weights, bias},
                {attribute("kernel_shape", std::vector{layer.kernel, layer.kernel}),
                 attribute("strides", std::vector{1, 1}),
                 attribute("pads", std::vector(4, layer.kernel / 2)),
                 attribute("dilations", std::vector{1, 1}), attribute("group", std::uint64_t{1})},
                output);
  }
  // Twice as large, linearly: weights 3/4 and 1/4.
  std::string enlarged(const std::string& from, int channels) {
    constexpr float line[] = {0.25f, 0.75f, 0.75f, 0.25f};
    std::vector<float> weights(static_cast<std::size_t>(channels * channels) * 16, 0.0f);
    for (int c = 0; c < channels; ++c)
      for (int i = 0; i < 16; ++i)
        weights[static_cast<std::size_t>(c * channels + c) * 16 + static_cast<std::size_t>(i)] =
            line[i / 4] * line[i % 4];
    return node(
        "ConvTranspose", {from, constant({channels, channels, 4, 4}, weights)},
        {attribute("kernel_shape", std::vector{4, 4}), attribute("strides", std::vector{2, 2}),
         attribute("pads", std::vector{1, 1, 1, 1}), attribute("dilations", std::vector{1, 1}),
         attribute("group", std::uint64_t{1})});
  }
  Message& message() { return graph_; }

 private:
  Message graph_;
  int count_ = 0;
  int constants_ = 0;
};

// How far from the border the zeros around pictures are seen in the finest one.
int margin_of(const PlainGenerator& generator) {
  int margin = 0;
  for (int k = 0; k < generator.level_count(); ++k)
    margin = (k == 0 ? 0 : 2 * margin + 1) +
             static_cast<int>(generator.levels[static_cast<std::size_t>(k)].layers.size());
  return margin;
}

std::string add_level(Graph& graph, const PlainGenerator& generator, int k,
                      const std::string& coarser) {
  const PlainLevel& level = generator.levels[static_cast<std::size_t>(k)];
  const std::string noise = fmt::format("noise_{}", k);
  std::string enlarged, values = noise;
  if (k > 0) {
    enlarged = graph.enlarged(coarser, generator.channels);
    values = graph.node("Concat", {enlarged, noise}, {attribute("axis", std::uint64_t{1})});
  }
  for (std::size_t i = 0; i < level.layers.size(); ++i) {
    const std::string sum = graph.convolution(values, level.layers[i]);
    const std::string active = graph.node("LeakyRelu", {sum}, {attribute("alpha", leaky_slope)});
    values = i == 0 ? active : graph.node("Add", {active, values});
  }
  const std::string added = graph.convolution(values, level.out);
  return k == 0 ? added : graph.node("Add", {added, enlarged});
}

// mean + axes · P, clamped to [low, high]: low + r(x − low), then high − r(high − x), where r is
// ReLU. Not every runtime clamps each channel to its own bounds.
void add_colours(Graph& graph, const PlainGenerator& generator, const std::string& values) {
  const int channels = generator.channels;
  const auto count = static_cast<std::size_t>(channels);
  PlainLayer above{channels, channels, 1, generator.axes, generator.mean};
  PlainLayer below{channels, channels, 1, std::vector<float>(count * count, 0.0f), generator.high};
  for (std::size_t c = 0; c < count; ++c) {
    above.bias[c] -= generator.low[c];
    below.weights[c * count + c] = -1;
    below.bias[c] -= generator.low[c];
  }
  PlainLayer last = below;
  last.bias = generator.high;
  const std::string over_low = graph.node("Relu", {graph.convolution(values, above)});
  const std::string under_high = graph.node("Relu", {graph.convolution(over_low, below)});
  graph.convolution(under_high, last, "picture");
}

std::string documentation(const PlainGenerator& generator) {
  std::string text = fmt::format("{}: a texture generator. Output: {}.", generator.title,
                                 channel_names(generator));
  if (!generator.licence.empty())
    text += fmt::format(" Licence of what it has learnt: {}.", generator.licence);
  const int last = generator.level_count() - 1, margin = margin_of(generator);
  return text + fmt::format(
                    R"(
Inputs: noise_k, of level k = 0 (coarse) to {} (fine), uniform in [-sqrt 3, sqrt 3), a value for each
channel c, pixel (x, y) and seed. Any will do; those of gramloom are PCG4D (Jarzynski and Olano 2020) in
32-bit arithmetic without sign: of (v0, v1, v2, v3) = (x, y, seed, {} k + floor(c / 4)),
  v = v * 1664525 + 1013904223
  v0 += v1 * v3, v1 += v2 * v0, v2 += v0 * v1, v3 += v1 * v2 (one after the other)
  v ^= v >> 16
  v0 += v1 * v3, v1 += v2 * v0, v2 += v0 * v1, v3 += v1 * v2
and the noise is floor(v[c mod 4] / 256) * 2 sqrt 3 / 2^24 - sqrt 3.
Places: noise_0 is n values long from place a on, on each axis, noise_k then 2^k n from place 2^k a on, and
the output is as long as the last. There are zeros around it: its first and last {} pixels are wrong, and
to be left out. So for a picture of L pixels from place 0 on, let f = 2^{}, a = -ceil({} / f) and
n = ceil(L / f) - 2 a, and take L pixels behind the first -a f. A picture whose sides are multiples of f
tiles where the places of noise_k wrap at its side times 2^k / f.)",
                    last, noise_groups_per_level, margin, last, margin);
}

std::string metadata(const PlainGenerator& generator) {
  Json noise = Json::array();  // channels of each level
  for (const PlainLevel& level : generator.levels) noise.push_back(level.noise);
  return to_text(
      Json{{"channels", generator.channels}, {"margin", margin_of(generator)}, {"noise", noise}});
}

}  // namespace

std::string export_onnx(const PlainGenerator& generator, const std::string& program) {
  Graph graph;
  std::string values;
  for (int k = 0; k < generator.level_count(); ++k) values = add_level(graph, generator, k, values);
  add_colours(graph, generator, values);
  graph.message().text(2, "generator");
  for (int k = 0; k < generator.level_count(); ++k)
    graph.message().message(11, described(fmt::format("noise_{}", k),
                                          generator.levels[static_cast<std::size_t>(k)].noise,
                                          fmt::format("height_{}", k), fmt::format("width_{}", k)));
  graph.message().message(12, described("picture", generator.channels, "height", "width"));
  Message model;
  model.number(1, 6).text(2, program).text(6, valid_utf8(documentation(generator)));
  model.message(7, graph.message()).message(8, Message().text(1, "").number(2, 11));
  model.message(14, Message().text(1, "gramloom").text(2, metadata(generator)));
  return model.bytes();
}

OnnxFrame onnx_frame(const PlainGenerator& generator, int length) {
  const int last = generator.level_count() - 1, scale = 1 << last;
  const int margin = margin_of(generator);
  const int before = (margin + scale - 1) / scale;
  return {-before, (length + scale - 1) / scale + 2 * before, before * scale};
}

}  // namespace gramloom
