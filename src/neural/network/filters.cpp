#include <cmath>

#include "neural/network/network.h"
#include "neural/normal_numbers.h"
#include "neural/settings.h"
#include "neural/tensor_data.h"

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
  const auto tensors = read_weights(description, shapes, file);
  std::vector<FilterWeights> result;
  for (const auto& shape : shapes)
    result.push_back({to_tensor(tensors.at(weight_name(shape.layer))),
                      to_tensor(tensors.at(bias_name(shape.layer)))});
  return result;
}

}  // namespace gramloom::neural
