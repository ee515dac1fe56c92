#include "learnt/level_network.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "signal/onednn.h"

namespace gramloom {

namespace {

using dnnl::memory;

const dnnl::engine& cpu() {
  static const dnnl::engine engine(dnnl::engine::kind::cpu, 0);
  return engine;
}

memory::desc plain(memory::dims shape, memory::format_tag tag) {
  return {std::move(shape), memory::data_type::f32, tag};
}

// Whole blocks: convolutions of oneDNN are slow on others.
int in_blocks(int channels) {
  const int block = channel_block();
  return (channels + block - 1) / block * block;
}

memory::desc planes_of(Size size, int channels) {
  return plain({1, in_blocks(channels), size.height, size.width},
               channel_block() == 16 ? memory::format_tag::nChw16c : memory::format_tag::nChw8c);
}

// Weights with zeros for the channels that fill the last blocks.
std::vector<float> in_whole_blocks(const std::vector<float>& weights, int inputs, int outputs,
                                   int filter) {
  const auto own = static_cast<std::size_t>(inputs) * static_cast<std::size_t>(filter);
  const auto row = static_cast<std::size_t>(in_blocks(inputs)) * static_cast<std::size_t>(filter);
  std::vector<float> padded(static_cast<std::size_t>(in_blocks(outputs)) * row);
  for (std::size_t o = 0; o < static_cast<std::size_t>(outputs); ++o)
    std::copy_n(weights.begin() + static_cast<std::ptrdiff_t>(o * own), own,
                padded.begin() + static_cast<std::ptrdiff_t>(o * row));
  return padded;
}

// A material's value of a channel, mixed.
float mix(const std::vector<float>& values, std::size_t channels, std::size_t channel,
          const float* shares, std::size_t materials) {
  float sum = 0;
  for (std::size_t m = 0; m < materials; ++m) sum += shares[m] * values[m * channels + channel];
  return sum;
}

}  // namespace

ChannelPlanes::ChannelPlanes(Size size_, int channels_)
    : size(size_),
      channels(channels_),
      block(channel_block()),
      memory(planes_of(size_, channels_), cpu()) {
  std::memset(memory.get_data_handle(), 0, memory.get_desc().get_size());
}

float* ChannelPlanes::at(int channel, std::size_t pixel) const {
  const auto plane = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  return static_cast<float*>(memory.get_data_handle()) +
         (static_cast<std::size_t>(channel / block) * plane + pixel) *
             static_cast<std::size_t>(block) +
         channel % block;
}

LevelNetwork::LevelNetwork(const GeneratorModel& model, int level, Size size,
                           std::span<const float> shares)
    : model_(model),
      level_(level),
      mixed_(shares.empty()),
      size_(size),
      engine_(cpu()),
      stream_(engine_) {
  const PlainLevel plain = plain_level(model, level, shares);
  input_ = ChannelPlanes(size, plain.layers.front().inputs);
  for (ChannelPlanes& planes : hidden_) planes = ChannelPlanes(size, plain.out.inputs);
  output_ = ChannelPlanes(size, plain.out.outputs);
  for (const PlainLayer& layer : plain.layers)
    layers_.push_back(make_layer(layer, !mixed_, !layers_.empty()));
  layers_.push_back(make_layer(plain.out, false, false));
}

LevelNetwork::Layer LevelNetwork::make_layer(const PlainLayer& given, bool activated,
                                             bool residual) {
  const int inputs = given.inputs, outputs = given.outputs, kernel = given.kernel;
  const std::vector<float>&weights = given.weights, &bias = given.bias;
  dnnl::post_ops after;
  if (activated) append_relu(after, leaky_slope);
  if (activated && residual)
    after.append_binary(dnnl::algorithm::binary_add, planes_of(size_, outputs));
  dnnl::primitive_attr attributes;
  attributes.set_post_ops(after);
  // A scratchpad of its own: oneDNN's is shared by all primitives of a thread.
  attributes.set_scratchpad_mode(dnnl::scratchpad_mode::user);
  const memory::dims shape{in_blocks(outputs), in_blocks(inputs), kernel, kernel};
  const memory::dims around{kernel / 2, kernel / 2};
  const ConvolutionShape described{planes_of(size_, inputs),
                                   plain(shape, memory::format_tag::any),
                                   plain({in_blocks(outputs)}, memory::format_tag::x),
                                   planes_of(size_, outputs),
                                   {1, 1},
                                   {0, 0},
                                   around};
  const auto made =
      describe_forward(engine_, dnnl::algorithm::convolution_direct, described, attributes);
  Layer layer{dnnl::convolution_forward(made), memory(made.weights_desc(), engine_),
              memory(plain({in_blocks(outputs)}, memory::format_tag::x), engine_),
              memory(made.scratchpad_desc(), engine_)};
  std::vector<float> padded = in_whole_blocks(weights, inputs, outputs, kernel * kernel);
  memory as_given(plain(shape, memory::format_tag::oihw), engine_, padded.data());
  dnnl::reorder(as_given, layer.weights).execute(stream_, as_given, layer.weights);
  stream_.wait();
  std::memset(layer.bias.get_data_handle(), 0, layer.bias.get_desc().get_size());
  if (activated || kernel == 1)  // else activate() adds it
    std::memcpy(layer.bias.get_data_handle(), bias.data(), bias.size() * sizeof(float));
  return layer;
}

void LevelNetwork::execute(const Layer& layer, const ChannelPlanes& from, const ChannelPlanes& to,
                           const ChannelPlanes* added) {
  std::unordered_map<int, memory> arguments{{DNNL_ARG_SRC, from.memory},
                                            {DNNL_ARG_WEIGHTS, layer.weights},
                                            {DNNL_ARG_BIAS, layer.bias},
                                            {DNNL_ARG_DST, to.memory},
                                            {DNNL_ARG_SCRATCHPAD, layer.scratchpad}};
  if (added) arguments[DNNL_ARG_ATTR_MULTIPLE_POST_OP(1) | DNNL_ARG_SRC_1] = added->memory;
  layer.convolution.execute(stream_, arguments);
  stream_.wait();
}

// What the convolution's primitive does where the shares are constant.
void LevelNetwork::activate(int layer, const ChannelPlanes& values, const ChannelPlanes* added,
                            PixelShares shares) const {
  const std::string name = fmt::format("levels.{}.", level_);
  const auto& bias = model_.values(fmt::format("{}layers.{}.bias", name, layer));
  const auto materials = static_cast<std::size_t>(model_.material_count());
  static const std::vector<float> none;
  const auto& scales =
      materials > 1 ? model_.values(fmt::format("{}scales.{}", name, layer)) : none;
  const auto& shifts =
      materials > 1 ? model_.values(fmt::format("{}shifts.{}", name, layer)) : none;
  const float bias_scale = residual_scale(layer);
  const auto pixels =
      static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
  const int block = values.block;
  for (int first = 0; first < values.channels; first += block)
    for (std::size_t p = 0; p < pixels; ++p) {
      float* v = values.at(first, p);
      const float* before = added ? added->at(first, p) : nullptr;
      for (int c = 0; c < std::min(block, values.channels - first); ++c) {
        const auto channel = static_cast<std::size_t>(first + c);
        float scale = 1, shift = 0;
        for (std::size_t m = 0; materials > 1 && m < materials; ++m) {
          scale += shares[p * materials + m] * scales[m * bias.size() + channel];
          shift += shares[p * materials + m] * shifts[m * bias.size() + channel];
        }
        const float x = scale * (v[c] + bias_scale * bias[channel]) + bias_scale * shift;
        v[c] = (x > 0 ? x : leaky_slope * x) + (before ? before[c] : 0);
      }
    }
}

void LevelNetwork::shift_output(PixelShares shares) const {
  const auto materials = static_cast<std::size_t>(model_.material_count());
  if (materials < 2) return;
  const auto& shifts = model_.values(fmt::format("levels.{}.out_shifts", level_));
  const auto pixels =
      static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
  const auto channels = static_cast<std::size_t>(output_.channels);
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t p = 0; p < pixels; ++p)
      *output_.at(static_cast<int>(c), p) +=
          mix(shifts, channels, c, &shares[p * materials], materials);
}

const ChannelPlanes& LevelNetwork::run(PixelShares shares) {
  const ChannelPlanes* from = &input_;
  const int count = static_cast<int>(layers_.size()) - 1;
  for (int i = 0; i < count; ++i) {
    const ChannelPlanes* added = i == 0 ? nullptr : from;
    const ChannelPlanes& to = hidden_[i % 2];
    execute(layers_[static_cast<std::size_t>(i)], *from, to, mixed_ ? nullptr : added);
    if (mixed_) activate(i, to, added, shares);
    from = &to;
  }
  execute(layers_.back(), *from, output_, nullptr);
  if (mixed_) shift_output(shares);
  return output_;
}

}  // namespace gramloom
