#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "classic/patch_growth.h"
#include "classic/patch_vote.h"
#include "classic/quilting.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// As the quilt that a texture of one exemplar starts from (patchmatch.cpp).
constexpr QuiltingParams params{.patch_size = 12,
                                .overlap = 1.0 / 3,
                                .tolerance = 0.05,
                                .candidates = 1,
                                .variety = 0,
                                .guidance = 0};

/// Pixels that usable patches have.
Image usable_pixels(const PatchSource& source) {
  if (source.usable.empty()) return {};
  const Size size = source.origins();
  cv::Mat1b first(source.features.height, source.features.width, std::uint8_t{0}), used;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) first(y, x) = source.is_usable({x, y}) ? 1 : 0;
  cv::dilate(first, used, cv::Mat::ones(field_patch, field_patch, CV_8U),
             cv::Point(field_patch - 1, field_patch - 1));
  Image mask(source.features.size(), 1);
  std::ranges::copy(used, mask.pixels.begin());
  return mask;
}

/// Pictures of a guide as one.
Image joined(const std::vector<Image>& planes, Size size) {
  if (planes.empty()) return {};
  Image guide(size, field_features * static_cast<int>(planes.size()));
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (std::size_t plane = 0; plane < planes.size(); ++plane)
        std::copy_n(planes[plane].at(x, y), field_features,
                    guide.at(x, y) + plane * field_features);
  return guide;
}

/// Columns [first, end) of a picture.
Image columns(const Image& image, int first, int end) {
  if (image.empty()) return {};
  Image part(end - first, image.height, image.channels);
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.at(first, y), part.width * image.channels, part.at(0, y));
  return part;
}

bool fits_patch(const Exemplar& exemplar) {
  constexpr Size side{params.patch_size, params.patch_size};
  const auto whole = usable_origins(exemplar.mask, exemplar.image.size(), side);
  return std::ranges::any_of(whole, [](unsigned char usable) { return usable != 0; });
}

/// Exemplars of a quilt, and their first columns in the source.
struct Pieces {
  std::vector<Exemplar> exemplars;
  std::vector<int> left;
};

/// Those side by side apart, of which a quilt makes as much as each has, unless a guide tells what
/// goes where.
Pieces pieces_of(const PatchSource& source) {
  Exemplar whole{.image = source.features, .mask = usable_pixels(source)};
  whole.guide = joined(source.guide, whole.image.size());
  std::vector<int> ends = {whole.image.width}, firsts = {0};
  if (source.guide.empty() && !source.parts.empty()) {
    firsts = source.parts;
    ends.insert(ends.begin(), firsts.begin() + 1, firsts.end());
  }
  Pieces pieces;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    if (ends[i] <= firsts[i]) continue;
    Exemplar piece{.image = columns(whole.image, firsts[i], ends[i]),
                   .mask = columns(whole.mask, firsts[i], ends[i]),
                   .guide = columns(whole.guide, firsts[i], ends[i])};
    if (!fits_patch(piece)) continue;
    pieces.exemplars.push_back(std::move(piece));
    pieces.left.push_back(firsts[i]);
  }
  return pieces;
}

}  // namespace

bool quilt(PatchHole& hole, std::size_t level, const PatchSource& source, Random random) {
  const HoleLevel& wanted = hole.levels[level];
  Pieces pieces = pieces_of(source);
  if (pieces.exemplars.empty()) return false;
  Target target{.size = wanted.size, .tile = hole.window.tile};
  if (!wanted.guide.empty()) {
    target.guide = joined(wanted.guide, wanted.size);
    target.guide_weight = wanted.guide_weight;
    for (float& weight : target.guide_weight.pixels) weight = std::sqrt(weight);
  }
  const Texture texture =
      synthesise(params, {std::move(pieces.exemplars), std::move(target), random}, {});

  for (int y = 0; y < hole.canvas.height; ++y)
    for (int x = 0; x < hole.canvas.width; ++x)
      std::copy_n(texture.image.at(x % wanted.size.width, y % wanted.size.height), field_features,
                  hole.canvas.at(x, y));
  const Size origins = source.origins();
  constexpr int middle = field_patch / 2;
  PatchField& field = hole.field;
  for (int y = 0; y < field.size.height; ++y)
    for (int x = 0; x < field.size.width; ++x) {
      const Source from =
          *texture.source.at((x + middle) % wanted.size.width, (y + middle) % wanted.size.height);
      PatchOrigin origin{std::clamp(pieces.left[from.exemplar] + static_cast<int>(from.x) - middle,
                                    0, origins.width - 1),
                         std::clamp(static_cast<int>(from.y) - middle, 0, origins.height - 1)};
      while (!source.is_usable(origin))
        origin = {static_cast<int>(random.below(static_cast<std::uint32_t>(origins.width))),
                  static_cast<int>(random.below(static_cast<std::uint32_t>(origins.height)))};
      field.nearest[field.index(x, y)] = origin;
    }
  return true;
}

}  // namespace gramloom
