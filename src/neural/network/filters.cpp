#include <cmath>
#include <set>

#include "io/safetensors.h"
#include "neural/network/network.h"
#include "neural/normal_numbers.h"

namespace gramloom::neural {

namespace {

// Rows of `filters` (outputs, size) made orthonormal, in groups of as many as there can be.
at::Tensor orthonormal_rows(const at::Tensor& filters) {
  std::vector<at::Tensor> groups;
  for (std::int64_t i = 0; i < filters.size(0); i += filters.size(1)) {
    const std::int64_t count = std::min(filters.size(1), filters.size(0) - i);
    const auto [q, r] = at::linalg_qr(filters.narrow(0, i, count).t());
    groups.push_back((q * at::sign(at::diagonal(r))).t());  // the signs make it unique
  }
  return at::cat(groups);
}

at::Tensor tensor_of(const std::filesystem::path& file,
                     const std::map<std::string, TensorData>& tensors, const std::string& name,
                     const std::vector<std::int64_t>& shape) {
  const auto found = tensors.find(name);
  if (found == tensors.end()) throw Error("{}: no tensor '{}'", file.string(), name);
  if (found->second.shape != shape)
    throw Error("{}: tensor '{}' has shape [{}], the network needs [{}]", file.string(), name,
                fmt::join(found->second.shape, ", "), fmt::join(shape, ", "));
  const auto& values = found->second.values;
  for (const float value : values)
    if (!std::isfinite(value))
      throw Error("{}: tensor '{}' holds a value that is no finite number", file.string(), name);
  return at::from_blob(const_cast<float*>(values.data()), shape, at::kFloat).clone();
}

}  // namespace

std::vector<FilterWeights> random_filters(const std::vector<FilterShape>& shapes,
                                          RandomWeights kind, std::uint64_t seed) {
  std::vector<FilterWeights> result;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& shape = shapes[i];
    const std::int64_t size = std::int64_t{shape.inputs} * shape.kernel * shape.kernel;
    at::Tensor filters = normal_numbers(Random(seed, i), {shape.outputs, size});
    filters = kind == RandomWeights::orthogonal
                  ? orthonormal_rows(filters) * std::sqrt(2.0)
                  : filters * std::sqrt(2.0 / static_cast<double>(size));
    result.push_back(
        {filters.reshape({shape.outputs, shape.inputs, shape.kernel, shape.kernel}), {}});
  }
  return result;
}

std::vector<FilterWeights> load_filters(const NetworkDescription& description,
                                        const std::vector<FilterShape>& shapes,
                                        const std::filesystem::path& file) {
  const auto name = [](std::size_t layer, const char* part) {
    return fmt::format("features.{}.{}", layer, part);
  };
  std::set<std::string> names;
  for (const auto& shape : shapes) {
    const auto& layer = description.layers[shape.layer];
    if (!std::holds_alternative<ConvolutionLayer>(layer.kind))
      throw Error(
          "{}: layer '{}' of network '{}' has filters of several scales, which only random "
          "weights can fill",
          file.string(), layer.name, description.name);
    names.insert(name(shape.layer, "weight"));
    names.insert(name(shape.layer, "bias"));
  }
  const auto tensors = read_tensors(file, [&](const std::string& n) { return names.contains(n); });
  std::vector<FilterWeights> result;
  for (const auto& shape : shapes)
    result.push_back({tensor_of(file, tensors, name(shape.layer, "weight"),
                                {shape.outputs, shape.inputs, shape.kernel, shape.kernel}),
                      tensor_of(file, tensors, name(shape.layer, "bias"), {shape.outputs})});
  return result;
}

}  // namespace gramloom::neural
