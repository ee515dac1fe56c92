#include "signal/united.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/threads.h"

namespace gramloom {

namespace {

/// Between exemplars: one masked pixel is enough on every level, as a coarse pixel over it is
/// masked.
constexpr int gap = 1;

void paste(const Image& from, int left, int first, Image& to) {
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x)
      std::copy_n(from.at(x, y), from.channels, to.at(left + x, y) + first);
}

Size joined_size(const std::vector<Exemplar>& exemplars) {
  Size size{(static_cast<int>(exemplars.size()) - 1) * gap, 0};
  for (const Exemplar& exemplar : exemplars) {
    size.width += exemplar.image.width;
    size.height = std::max(size.height, exemplar.image.height);
  }
  return size;
}

/// Of the channels that tell exemplars apart: so much that the favoured one is taken however alike
/// its neighbours are, and near equal weights what fits.
constexpr float weight_of_shares = 2;

/// Weights in proportion.
void copy_shares(const float* weights, int count, float* to) {
  float sum = 0;
  for (int i = 0; i < count; ++i) sum += weights[i];
  for (int i = 0; i < count; ++i) to[i] = weight_of_shares * weights[i] / sum;
}

/// The target's guide with a channel for each exemplar's share behind it.
Image with_shares(const Target& target) {
  const int own = target.guide.channels;
  const int count = target.weights.channels;
  Image guide(target.size, own + count);
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x) {
      if (own > 0) std::copy_n(target.guide.at(x, y), own, guide.at(x, y));
      copy_shares(map_at(target.weights, x, y), count, guide.at(x, y) + own);
    }
  return guide;
}

}  // namespace

United::United(const Request& request) : target_guide_(&request.target.guide) {
  const std::vector<Exemplar>& exemplars = request.exemplars;
  one_ = &exemplars.front();
  left_ = {0};
  if (exemplars.size() == 1 && one_->mask.empty()) return;

  const bool weighed = exemplars.size() > 1 && !request.target.weights.empty();
  const int own = one_->guide.channels;
  const Size size = joined_size(exemplars);
  joined_.layers = one_->layers;
  joined_.image = Image(size, one_->image.channels);
  joined_.mask = Image(size, 1, 0.0f);
  if (const int channels = own + (weighed ? static_cast<int>(exemplars.size()) : 0); channels > 0)
    joined_.guide = Image(size, channels);
  int left = 0;
  left_.clear();
  for (std::size_t i = 0; i < exemplars.size(); ++i) {
    const Exemplar& exemplar = exemplars[i];
    const Size part = exemplar.image.size();
    paste(exemplar.image, left, 0, joined_.image);
    paste(exemplar.mask.empty() ? Image(part, 1, 1.0f) : exemplar.mask, left, 0, joined_.mask);
    if (own > 0) paste(exemplar.guide, left, 0, joined_.guide);
    if (weighed)
      paste(Image(part, 1, weight_of_shares), left, own + static_cast<int>(i), joined_.guide);
    left_.push_back(left);
    left += part.width + gap;
  }
  joined_.image = extended(joined_.image, joined_.mask);
  if (!joined_.guide.empty()) joined_.guide = extended(joined_.guide, joined_.mask);
  if (weighed) guide_ = with_shares(request.target);
}

Source United::source(int x, int y) const {
  const auto exemplar = std::ranges::upper_bound(left_, x) - left_.begin() - 1;
  return {x - left_[static_cast<std::size_t>(exemplar)], y, static_cast<int>(exemplar)};
}

void United::name_sources(SourceMap& sources) const {
  if (left_.size() == 1) return;
  for (Source& pixel : sources.pixels)
    pixel = source(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
}

Image extended(const Image& image, const Image& mask) {
  if (std::ranges::all_of(mask.pixels, [](float v) { return v > 0.5f; })) return image;
  // The distance transform labels each pixel by the nearest zero, which are the usable ones.
  cv::Mat1b unusable(mask.height, mask.width);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) unusable(y, x) = *mask.at(x, y) > 0.5f ? 0 : 1;
  cv::Mat1f distance;
  cv::Mat1i nearest;
  cv::distanceTransform(unusable, distance, nearest, cv::DIST_L2, cv::DIST_MASK_5,
                        cv::DIST_LABEL_PIXEL);
  std::vector<const float*> pixel_of(1);  // labels begin with 1
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (unusable(y, x) == 0) {
        const auto label = static_cast<std::size_t>(nearest(y, x));
        if (pixel_of.size() <= label) pixel_of.resize(label + 1);
        pixel_of[label] = image.at(x, y);
      }
  Image result = image;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (unusable(y, x) != 0)
        std::copy_n(pixel_of[static_cast<std::size_t>(nearest(y, x))], image.channels,
                    result.at(x, y));
  return result;
}

std::vector<unsigned char> usable_origins(const Image& mask, Size image, Size patch) {
  const int columns = image.width - patch.width + 1;
  const int rows = image.height - patch.height + 1;
  if (columns < 1 || rows < 1) return {};
  std::vector<unsigned char> usable(
      static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1);
  if (mask.empty()) return usable;
  cv::Mat1b allowed(mask.height, mask.width);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) allowed(y, x) = *mask.at(x, y) > 0.5f ? 1 : 0;
  // An erosion anchored at the first pixel: 1 where the whole patch from there on is allowed.
  cv::Mat1b whole;
  cv::erode(allowed, whole, cv::Mat::ones(patch.height, patch.width, CV_8U), cv::Point(0, 0));
  for (int y = 0; y < rows; ++y)
    std::copy_n(whole.ptr<unsigned char>(y), columns,
                usable.begin() + static_cast<std::ptrdiff_t>(y) * columns);
  return usable;
}

Image halved_mask(const Image& mask) {
  Image half(std::max(1, mask.width / 2), std::max(1, mask.height / 2), 1);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      const int right = std::min(2 * x + 1, mask.width - 1);
      const int below = std::min(2 * y + 1, mask.height - 1);
      *half.at(x, y) = std::min(std::min(*mask.at(2 * x, 2 * y), *mask.at(right, 2 * y)),
                                std::min(*mask.at(2 * x, below), *mask.at(right, below)));
    }
  return half;
}

}  // namespace gramloom
