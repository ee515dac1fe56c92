#include "neural/flow/guided_patches.h"

#include <numeric>

#include "neural/quarter_means.h"

namespace gramloom::neural {

namespace {

// Vectors with `more` coordinates, which f(place, coordinates) sets.
template <class F>
Vectors longer(const Vectors& vectors, const std::vector<PatchPlace>& places, std::int64_t more,
               F&& f) {
  Vectors result(vectors.count, vectors.dimensions + more);
  for (std::int64_t i = 0; i < vectors.count; ++i) {
    std::copy_n(vectors.at(i), vectors.dimensions, result.at(i));
    f(places[static_cast<std::size_t>(i)], result.at(i) + vectors.dimensions);
  }
  return result;
}

}  // namespace

GuidedPatches::GuidedPatches(const Guidance& guidance, int side, double mean_square) {
  if (!guidance.guides()) return;
  means_ = quarter_means(guidance.guide, side);
  exemplar_means_ = quarter_means(guidance.exemplar_guide, side);
  // A patch's squared distance is a sum over pixels and channels, of mean square `mean_square`
  // each: in the unit of total variance 1 its mean is that sum / (side² · channels · mean_square).
  const auto channels = static_cast<double>(guidance.channels);
  const double unit = side * side * channels * mean_square / 4;  // 4 quarters are a mean
  weight_ = Image(guidance.guide.size(), 1);
  for (int y = 0; y < weight_.height; ++y)
    for (int x = 0; x < weight_.width; ++x) {
      const float w = *guidance.guide_weight.at((x + side / 2) % weight_.width,
                                                (y + side / 2) % weight_.height);
      *weight_.at(x, y) = static_cast<float>(unit) * w * w;
    }
}

Vectors GuidedPatches::queries(Vectors of_picture, const std::vector<PatchPlace>& places) const {
  if (means_.empty()) return of_picture;
  return longer(of_picture, places, means_.channels + 1, [&](PatchPlace p, float* to) {
    const float weight = *weight_.at(p.x, p.y), *mean = means_.at(p.x, p.y);
    for (int c = 0; c < means_.channels; ++c) to[c] = weight * mean[c];
    to[means_.channels] = -weight / 2;
  });
}

Vectors GuidedPatches::references(Vectors of_exemplar, const std::vector<PatchPlace>& places,
                                  float t) const {
  if (means_.empty()) return of_exemplar;
  return longer(of_exemplar, places, means_.channels + 1, [&](PatchPlace p, float* to) {
    const float* mean = exemplar_means_.at(p.x, p.y);
    for (int c = 0; c < means_.channels; ++c) to[c] = mean[c] / t;
    to[means_.channels] = std::inner_product(mean, mean + means_.channels, mean, 0.0f) / t;
  });
}

std::vector<float> squares_of(const Vectors& vectors) {
  std::vector<float> squares;
  for (std::int64_t i = 0; i < vectors.count; ++i) {
    const float* v = vectors.at(i);
    squares.push_back(std::inner_product(v, v + vectors.dimensions, v, 0.0f));
  }
  return squares;
}

double mean_square_of(const Image& image, const Image& usable) {
  const Image pixels = usable_pixels(image, usable);
  double sum = 0;
  for (const float v : pixels.pixels) sum += static_cast<double>(v) * v;
  return sum / static_cast<double>(pixels.pixels.size());
}

std::vector<PatchPlace> some_of(const std::vector<PatchPlace>& places, std::size_t most,
                                Random random) {
  if (places.size() <= most) return places;
  // Each is taken with the probability that is still wanted (Knuth, selection sampling).
  std::vector<PatchPlace> some;
  for (std::size_t i = 0; some.size() < most; ++i)
    if (random.uniform() * static_cast<float>(places.size() - i) <
        static_cast<float>(most - some.size()))
      some.push_back(places[i]);
  return some;
}

}  // namespace gramloom::neural
