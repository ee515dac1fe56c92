#include "neural/loss/patch_sample.h"

#include <memory>

#include "core/threads.h"
#include "neural/loss/multiply.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t run_length = 64;
constexpr std::int64_t runs_at_once = 16;  // whose patches are multiplied: few enough for the cache

}  // namespace

PatchSample::PatchSample(const PatchPositions& positions, std::int64_t most, Random random) {
  const std::int64_t rows = (positions.count() + most - 1) / most;  // of which one is taken
  for (std::int64_t first = 0; first < positions.rows; first += rows)
    for (std::int64_t x = 0; x < positions.columns; x += run_length) {
      const std::int64_t y = first + random.below(static_cast<std::uint32_t>(rows));
      if (y >= positions.rows) continue;  // as likely as any row that there is
      const std::int64_t length = std::min(run_length, positions.columns - x);
      runs.push_back({x, y, length, count});
      count += length;
    }
}

PatchSample PatchSample::in_rows(std::int64_t begin, std::int64_t end) const {
  PatchSample result;
  for (const PatchRun& run : runs) {
    if (run.y < begin || run.y >= end) continue;
    result.runs.push_back({run.x, run.y - begin, run.length, result.count});
    result.count += run.length;
  }
  return result;
}

at::Tensor project_sample(const at::Tensor& picture, const at::Tensor& filters, Tile wraps,
                          const PatchSample& sample) {
  const PatchPositions p(picture, filters.size(2), wraps);
  const at::Tensor pixels = picture.contiguous(), weights = filters.contiguous();
  at::Tensor result = at::empty({filters.size(0), sample.count}, at::kFloat);
  const float *source = pixels.data_ptr<float>(), *filter = weights.data_ptr<float>();
  float* target = result.data_ptr<float>();
  parallel_for(std::ssize(sample.runs), runs_at_once, [&](std::int64_t begin, std::int64_t end) {
    const InThisThread in_this_thread;
    const PatchRun* runs = sample.runs.data();
    const std::int64_t place = runs[begin].place,
                       count = runs[end - 1].place + runs[end - 1].length - place;
    const auto patches =
        std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(p.taps() * count));
    for (std::int64_t r = begin; r < end; ++r) {
      float* line = patches.get() + runs[r].place - place;
      for_each_tap(p, runs[r].y, runs[r].x, [&](std::int64_t row, std::int64_t column) {
        for_each_piece(p.width, column, runs[r].length,
                       [&](std::int64_t first, std::int64_t to, std::int64_t some) {
                         std::copy_n(source + row + first, some, line + to);
                       });
        line += count;
      });
    }
    multiply('N', Matrix<const float>{filter, p.taps()}, Matrix<const float>{patches.get(), count},
             Matrix<float>{target + place, sample.count}, filters.size(0), count, p.taps());
  });
  return result;
}

}  // namespace gramloom::neural
