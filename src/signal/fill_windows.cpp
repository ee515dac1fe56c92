#include "signal/fill_windows.h"

#include <algorithm>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/surroundings.h"
#include "core/threads.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// Holes nearer than twice this to each other are filled together: they see each other.
constexpr int context = 48;

Image cropped(const Image& image, const FillWindow& window, Size whole) {
  if (image.size() != whole) return image;  // empty, or 1×1
  Image part(window.size, image.channels);
  for (int y = 0; y < part.height; ++y)
    std::copy_n(image.at(window.left, window.top + y), part.width * image.channels, part.at(0, y));
  return part;
}

Request request_of(const Request& request, std::optional<std::size_t> same,
                   const FillWindow& window, std::uint64_t number) {
  const Size whole = request.target.size;
  Request part{{}, {}, request.random.stream(number)};
  for (std::size_t e = 0; e < request.exemplars.size(); ++e) {
    const Exemplar& exemplar = request.exemplars[e];
    if (e == same)
      part.exemplars.push_back({cropped(exemplar.image, window, whole), exemplar.layers,
                                cropped(exemplar.mask, window, whole),
                                cropped(exemplar.guide, window, whole)});
    else
      part.exemplars.push_back(exemplar);
  }
  const Target& target = request.target;
  part.target = {window.size,
                 Tile::none,
                 cropped(target.known, window, whole),
                 Image(window.size, 1, 0.0f),
                 cropped(target.guide, window, whole),
                 cropped(target.guide_weight, window, whole),
                 cropped(target.weights, window, whole),
                 {}};
  for (const std::size_t i : window.made)
    *part.target.mask.at(static_cast<int>(i) % whole.width - window.left,
                         static_cast<int>(i) / whole.width - window.top) = 1;
  // Holes of other windows: far away, but what they hold is nothing's.
  Image there = cropped(target.mask, window, whole);
  for (float& m : there.pixels) m = m > 0.5f ? 0.0f : 1.0f;
  part.target.known = extended(part.target.known, there);
  return part;
}

void place(FillWindow& window, const Box& box) {
  window.left = box.left;
  window.top = box.top;
  window.size = box.size();
}

/// Each pixel from its own place of that exemplar, if it is the same picture.
SourceMap own_sources(Size size, std::optional<std::size_t> same) {
  SourceMap sources(size);
  if (!same) return sources;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) *sources.at(x, y) = {x, y, static_cast<int>(*same)};
  return sources;
}

}  // namespace

std::optional<std::size_t> same_picture(const Request& request) {
  for (std::size_t e = 0; e < request.exemplars.size(); ++e)
    if (is_filled(request.exemplars[e], request.target)) return e;
  return std::nullopt;
}

std::vector<FillWindow> fill_windows(const Request& request, double most) {
  const Target& target = request.target;
  const auto same = same_picture(request);
  if (!same || target.tile != Tile::none) return {};
  const Size size = target.size;
  cv::Mat1b made(size.height, size.width), wide;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) made(y, x) = *target.mask.at(x, y) > 0.5f ? 1 : 0;
  cv::dilate(made, wide, cv::Mat::ones(2 * context + 1, 2 * context + 1, CV_8U));
  cv::Mat1i labels;
  const int count = cv::connectedComponents(wide, labels, 8, CV_32S);
  std::vector<FillWindow> windows(static_cast<std::size_t>(count - 1));
  std::vector<Box> boxes(windows.size(), {size.width, size.height, 0, 0});
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      if (made(y, x) == 0) continue;
      const auto label = static_cast<std::size_t>(labels(y, x) - 1);
      windows[label].made.push_back(static_cast<std::size_t>(y) *
                                        static_cast<std::size_t>(size.width) +
                                    static_cast<std::size_t>(x));
      Box& box = boxes[label];
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
             std::max(box.bottom, y + 1)};
    }
  double total = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Box box = with_surroundings(boxes[i], size);
    place(windows[i], box);
    total += area(box.size());
    if (!has_enough(request.exemplars[*same].mask, box)) return {};
  }
  if (total > most * area(size)) return {};
  return windows;
}

FillWindow window_about_holes(const Target& target) {
  FillWindow window;
  place(window, with_surroundings(box_of(target.mask), target.size));
  for (std::size_t i = 0; i < target.mask.pixels.size(); ++i)
    if (target.mask.pixels[i] > 0.5f) window.made.push_back(i);
  return window;
}

Texture fill_by_windows(const Request& request, const std::vector<FillWindow>& windows,
                        const std::function<Texture(const Request&, const Control&)>& fill,
                        const Control& control) {
  const auto same = same_picture(request);
  const Size size = request.target.size;
  Texture whole{request.target.known, {}, {}};
  const auto channels = static_cast<std::size_t>(whole.image.channels);
  std::once_flag copies;
  const auto fill_one = [&](std::size_t w, const Control& own) {
    const FillWindow& window = windows[w];
    const Texture part = fill(request_of(request, same, window, w), own);
    if (!part.source.empty())
      std::call_once(copies, [&] { whole.source = own_sources(size, same); });
    for (const std::size_t i : window.made) {
      const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
      std::copy_n(part.image.at(x - window.left, y - window.top), channels,
                  whole.image.pixels.begin() + static_cast<std::ptrdiff_t>(i * channels));
      if (part.source.empty()) continue;
      Source from = *part.source.at(x - window.left, y - window.top);
      if (from.exemplar == same)
        from = {static_cast<int>(from.x) + window.left, static_cast<int>(from.y) + window.top,
                static_cast<int>(*same)};
      whole.source.pixels[i] = from;
    }
  };
  // A single one has all threads to itself.
  if (windows.size() == 1) {
    fill_one(0, control);
    return whole;
  }
  const auto count = static_cast<std::int64_t>(windows.size());
  constexpr std::int64_t at_once = 8;  // whatever the threads
  for (std::int64_t first = 0; first < count; first += at_once) {
    control.step(first, count);
    parallel_for(std::min(at_once, count - first), 1, [&](std::int64_t begin, std::int64_t end) {
      for (auto w = first + begin; w < first + end; ++w) fill_one(static_cast<std::size_t>(w), {});
    });
  }
  control.step(count, count);
  return whole;
}

}  // namespace gramloom
