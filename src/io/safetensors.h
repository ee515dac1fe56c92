#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gramloom {

/// An array of any number of dimensions, row-major; no dimension is a single number.
struct TensorData {
  std::vector<std::int64_t> shape;
  std::vector<float> values;

  friend bool operator==(const TensorData&, const TensorData&) = default;
};

/// Says whether the tensor of this name is wanted.
using WantsTensor = std::function<bool(const std::string& name)>;

/// The tensors of a .safetensors file (github.com/huggingface/safetensors: 8 bytes little-endian
/// length, JSON header, data) that `wants` asks for; without `wants`, all. F16, BF16, F32 and F64
/// become float. The whole header is checked, wanted or not: throws Error with the path, and the
/// tensor's name where there is one, for a file that is missing, truncated or too long, a length
/// that lies, invalid JSON, duplicate names, a bad shape, offsets that leave the file, overlap,
/// leave a gap or disagree with shape and dtype; and for a wanted tensor of any other dtype.
std::map<std::string, TensorData> read_tensors(const std::filesystem::path& path,
                                               const WantsTensor& wants = {});

/// The texts of the header's metadata. Throws Error as read_tensors() does, and for metadata that
/// are not texts.
std::map<std::string, std::string> read_metadata(const std::filesystem::path& path);

/// Writes every tensor as F32, complete or not at all; `metadata` are texts for the header. The
/// same tensors give the same bytes. Throws Error with the path, also when values don't match a
/// shape.
void write_tensors(const std::filesystem::path& path,
                   const std::map<std::string, TensorData>& tensors,
                   const std::map<std::string, std::string>& metadata = {});

}  // namespace gramloom
