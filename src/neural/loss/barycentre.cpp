#include "neural/loss/barycentre.h"

#include <span>

#include "core/threads.h"
#include "signal/quantile.h"

namespace gramloom::neural {

at::Tensor barycentre(const std::vector<at::Tensor>& sorted, const std::vector<float>& shares,
                      std::int64_t count) {
  const std::int64_t rows = sorted.front().size(0);
  at::Tensor mean = at::zeros({rows, count}, at::kFloat);
  float* to = mean.data_ptr<float>();
  const auto values = static_cast<std::size_t>(count);
  parallel_for(rows, 1, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> own(values);
    for (std::int64_t r = begin; r < end; ++r)
      for (std::size_t e = 0; e < sorted.size(); ++e) {
        if (shares[e] == 0) continue;
        const std::int64_t length = sorted[e].size(1);
        const std::span<const float> row(sorted[e].data_ptr<float>() + r * length,
                                         static_cast<std::size_t>(length));
        Quantiles(row, values).get(0, own);
        for (std::size_t i = 0; i < values; ++i)
          to[r * count + static_cast<std::int64_t>(i)] += shares[e] * own[i];
      }
  });
  return mean;
}

}  // namespace gramloom::neural
