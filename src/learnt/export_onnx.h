#pragma once

#include <string>

#include "learnt/plain_generator.h"

namespace gramloom {

/// A generator as an ONNX model (opset 11) of convolutions and sums, which onnxruntime and OpenCV's
/// dnn both run. Inputs noise_0, noise_1, …: (1, channels, height, width), a level each, coarse to
/// fine; output picture: (1, channels, height, width), clamped as generate()'s.
///
/// All levels' noise covers the same area: noise_k is 2^k times as long as noise_0 on each axis,
/// and begins 2^k times as far from place 0. The output is as large as the finest, with a margin to
/// be left out, where the zeros around pictures were seen: onnx_frame() says what to give for a
/// picture. Noise is that of learnt/noise.h at these places, or wraps where a picture is to tile
/// and its sides can be halved as often as there are levels after the first.
///
/// The file is written by hand: of protocol buffers, ONNX needs numbers, texts and nested messages,
/// a few lines; the package would bring a compiler and generated code for six messages.
std::string export_onnx(const PlainGenerator& generator, const std::string& program);

/// One axis of what the model is given for pixels [0, length) of a picture: noise_k goes from place
/// 2^k · first on, for 2^k · length places.
struct OnnxFrame {
  int first = 0;
  int length = 0;
  int skipped = 0;  // pixels of the output before the picture
};
OnnxFrame onnx_frame(const PlainGenerator& generator, int length);

}  // namespace gramloom
