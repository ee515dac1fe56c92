#include "neural/checkpoint.h"

#include <fmt/format.h>

#include <bit>

#include "core/error.h"
#include "io/safetensors.h"

namespace gramloom::neural {

namespace {

// All of a checkpoint lies in one safetensors file: tensors (pictures, vectors) as they are, and
// each double as its bits in four parts of 16, numbers that floats hold exactly.
TensorData to_data(const at::Tensor& tensor) {
  const at::Tensor values = tensor.contiguous();
  const float* first = values.data_ptr<float>();
  return {values.sizes().vec(), {first, first + values.numel()}};
}

at::Tensor to_tensor(const TensorData& data) {
  return at::from_blob(const_cast<float*>(data.values.data()), data.shape, at::kFloat).clone();
}

TensorData to_data(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  TensorData data{{4}, {}};
  for (int part = 0; part < 4; ++part)
    data.values.push_back(static_cast<float>(bits >> 16 * part & 0xffff));
  return data;
}

double to_double(const TensorData& data) {
  std::uint64_t bits = 0;
  for (std::size_t part = 0; part < 4; ++part)
    bits |= static_cast<std::uint64_t>(data.values.at(part)) << 16 * part;
  return std::bit_cast<double>(bits);
}

// The fingerprint is kept as the name of an empty tensor: read_tensors gives names and values.
const std::string fingerprint_prefix = "fingerprint ";

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  std::map<std::string, TensorData> tensors;
  tensors[fingerprint_prefix + checkpoint.fingerprint] = {{0}, {}};
  tensors["picture"] = to_data(checkpoint.picture);
  tensors["level"] = to_data(checkpoint.level);
  tensors["first_level"] = to_data(checkpoint.first_level);
  tensors["iteration"] = to_data(static_cast<double>(checkpoint.iteration));
  tensors["evaluations"] = to_data(static_cast<double>(checkpoint.evaluations));
  tensors["seconds"] = to_data(checkpoint.seconds);
  tensors["first_loss"] = to_data(checkpoint.first_loss);
  for (const auto& [name, tensor] : checkpoint.optimiser.tensors)
    tensors["optimiser." + name] = to_data(tensor);
  for (const auto& [name, number] : checkpoint.optimiser.numbers)
    tensors["optimiser_number." + name] = to_data(number);
  write_tensors(file, tensors);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file,
                                          const std::string& fingerprint) try {
  if (file.empty() || !std::filesystem::exists(file)) return {};
  const auto tensors = read_tensors(file);
  if (!tensors.contains(fingerprint_prefix + fingerprint)) return {};
  const auto number = [&](const char* name) { return to_double(tensors.at(name)); };
  Checkpoint checkpoint{fingerprint,
                        static_cast<int>(number("level")),
                        static_cast<int>(number("first_level")),
                        static_cast<std::int64_t>(number("iteration")),
                        static_cast<std::int64_t>(number("evaluations")),
                        number("seconds"),
                        number("first_loss"),
                        to_tensor(tensors.at("picture")),
                        {}};
  const std::string tensor_prefix = "optimiser.", number_prefix = "optimiser_number.";
  for (const auto& [name, data] : tensors) {
    if (name.starts_with(tensor_prefix))
      checkpoint.optimiser.tensors[name.substr(tensor_prefix.size())] = to_tensor(data);
    if (name.starts_with(number_prefix))
      checkpoint.optimiser.numbers[name.substr(number_prefix.size())] = to_double(data);
  }
  return checkpoint;
} catch (const Error&) {
  return {};
} catch (const std::out_of_range&) {
  return {};
}

}  // namespace gramloom::neural
