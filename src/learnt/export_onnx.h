#pragma once

#include <string>

#include "learnt/plain_generator.h"

namespace gramloom {

/// A generator as an ONNX model (opset 11) of convolutions, slices and sums, which onnxruntime and
/// OpenCV's dnn both run. Inputs noise_0, noise_1, …: (1, channels, height, width), a level each,
/// coarse to fine; output picture: (1, channels, height, width), clamped as generate()'s.
///
/// No convolution has a border. Level k's noise is `2 · border_k` larger than its picture, and
/// pixel i of its picture is place o_k + i of the level; the next level's noise begins at place
/// 2 o_k + 1, and is two pixels smaller than twice the picture. onnx_frame() says where to begin
/// for a picture. Noise is that of learnt/noise.h at these places, or wraps where a picture is to
/// tile and its sides can be halved as often as there are levels after the first.
///
/// The file is written by hand: of protocol buffers, ONNX needs numbers, texts and nested messages,
/// a few lines; the package would bring a compiler and generated code for six messages.
std::string export_onnx(const PlainGenerator& generator, const std::string& program);

/// One axis of what the model is given for pixels [0, length) of a picture.
struct OnnxFrame {
  struct Level {
    int first = 0;   // the place of the first noise
    int length = 0;  // of the noise
  };
  std::vector<Level> levels;
  int skipped = 0;  // pixels of the output before the picture
};
OnnxFrame onnx_frame(const PlainGenerator& generator, int length);

}  // namespace gramloom
