#include "classic/patch_places.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/simd.h"
#include "signal/patch_distance.h"

namespace gramloom {

namespace {

/// What a pixel counts that is known where a place has none: as if it differed by this variance.
constexpr float unseen = 0.1f;

GRAMLOOM_INLINE float squared_difference(const KnownPixel& pixel, const float* value) {
  const FeaturePixel d = pixel.value - *reinterpret_cast<const FeaturePixel*>(value);
  const FeaturePixel squares = d * d;
  return pixel.weight * ((squares[0] + squares[1]) + (squares[2] + squares[3]));
}

}  // namespace

GRAMLOOM_SIMD void compare(const WantedPatch& wanted, const GrowthPlaces& places, std::size_t first,
                           std::size_t last, float limit, float* costs) {
  float least = std::numeric_limits<float>::infinity();
  const PatchSource& source = *places.source;
  const std::ptrdiff_t row = std::ptrdiff_t{source.features.width} * field_features;
  const auto known = static_cast<std::ptrdiff_t>(wanted.pixels.size());
  const float scale = wanted.weight > 0 ? patch_area / wanted.weight : 0;
  const KnownPixel* pixels = wanted.pixels.data();
  for (std::size_t i = first; i < last; ++i) {
    const PatchOrigin o = places.origins[i];
    float cost = 0;
    if (wanted.guide_weight > 0)
      for (std::size_t plane = 0; plane < source.guide.size(); ++plane) {
        const Image& asked = wanted.guide->wanted[plane];
        cost += wanted.guide_weight * squared_distance(asked.at(wanted.x, wanted.y),
                                                       std::ptrdiff_t{asked.width} * field_features,
                                                       source.guide[plane].at(o.x, o.y), row);
      }
    const float* from = places.features.at(o.x + growth_context, o.y + growth_context);
    const unsigned char* valid =
        places.inside[i] != 0
            ? nullptr
            : places.valid.data() + places.index(o.x + growth_context, o.y + growth_context);
    for (std::ptrdiff_t k = 0; k < known && cost < limit * least;) {
      float sum = 0;
      for (const std::ptrdiff_t end = std::min(known, k + 16); k < end; ++k)
        sum += valid && valid[pixels[k].offset] == 0
                   ? pixels[k].weight * unseen
                   : squared_difference(pixels[k], from + pixels[k].offset * field_features);
      cost += scale * sum;
    }
    costs[i] = cost;
    least = cost < least ? cost : least;
  }
}

GrowthPlaces growth_places(const PatchSource& source, std::size_t most) {
  GrowthPlaces places{.source = &source};
  const Size size = source.origins();
  const auto count = source.usable.empty()
                         ? std::ssize(source.sketches)
                         : std::ranges::count_if(source.usable, [](auto v) { return v != 0; });
  const std::size_t step = (static_cast<std::size_t>(count) + most - 1) / most;
  std::size_t i = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (source.is_usable({x, y}) && i++ % step == 0) places.origins.push_back({x, y});

  // A pixel may be used where a usable patch has it.
  const Size wide{source.features.width + 2 * growth_context,
                  source.features.height + 2 * growth_context};
  cv::Mat1b first(wide.height, wide.width, std::uint8_t{0}), valid, inside;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      first(y + growth_context, x + growth_context) = source.is_usable({x, y}) ? 1 : 0;
  cv::dilate(first, valid, cv::Mat::ones(field_patch, field_patch, CV_8U),
             cv::Point(field_patch - 1, field_patch - 1));
  constexpr int side = field_patch + 2 * growth_context;
  cv::erode(valid, inside, cv::Mat::ones(side, side, CV_8U), cv::Point(0, 0), 1,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  for (const PatchOrigin o : places.origins) places.inside.push_back(inside(o.y, o.x));
  places.valid.assign(valid.datastart, valid.dataend);
  places.features = Image(wide, field_features);
  for (int y = 0; y < source.features.height; ++y)
    std::copy_n(source.features.at(0, y), source.features.width * field_features,
                places.features.at(growth_context, y + growth_context));
  return places;
}

}  // namespace gramloom
