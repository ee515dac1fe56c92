#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "learnt/generator_model.h"

namespace gramloom {

/// A convolution: weights as (outputs, inputs, kernel, kernel).
struct PlainLayer {
  int inputs = 0;
  int outputs = 0;
  int kernel = 3;
  std::vector<float> weights;
  std::vector<float> bias;

  float weight(int output, int input, int tap) const {
    return weights[static_cast<std::size_t>((output * inputs + input) * kernel * kernel + tap)];
  }
};

struct PlainLevel {
  int noise = 0;
  std::vector<PlainLayer> layers;  // of 3×3
  PlainLayer out;                  // of 1×1
};

/// A generator of one material, or of fixed shares of several, as numbers alone: what leaves the
/// program. The shares are folded into the weights, and the residual layers' 1 / √2 too:
///
///   u₁ = a(C₁ x),  u_{i+1} = u_i + a(C_{i+1} u_i),  N = O u_n
///
/// is what learnt/generator_model.h says, whose h_i are √2^{1−i} u_i: a leaky ReLU of c·x is c
/// times that of x, so that only biases and the last weights change. C and O add their bias.
struct PlainGenerator {
  int channels = 0;
  std::vector<PlainLevel> levels;              // the coarsest first
  std::vector<float> mean, axes, low, high;    // of the colours
  std::string title;                           // its materials, for people
  std::string licence;                         // of these, "" where nothing is known
  std::vector<GeneratorLayer> picture_layers;  // what its channels mean

  int level_count() const { return static_cast<int>(levels.size()); }
  std::size_t weight_count() const;
};

/// What the biases of a level's convolution are multiplied by, counted from 0: √2 for each before
/// it but the first.
float residual_scale(int layer);

/// `shares`: of each material, 1 in all; none: no material's scales and shifts are folded in.
PlainLevel plain_level(const GeneratorModel& model, int level, std::span<const float> shares);
PlainGenerator plain_generator(const GeneratorModel& model, std::span<const float> shares);

/// What its channels are, in words: "0 to 2 colour, 3 height (scalar)".
std::string channel_names(const PlainGenerator& generator);

/// A text in one line that ends no comment of C.
std::string comment_text(std::string text);

/// A number as a constant of C and GLSL: the shortest decimals that give the same float.
std::string float_constant(float value);

}  // namespace gramloom
