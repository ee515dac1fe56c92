#include "train/lesson_pictures.h"

#include <algorithm>

namespace gramloom::train {

namespace {

// (1, channels, height, width) along the axes.
at::Tensor along(const Image& image, const ColourAxes& axes) {
  const std::int64_t channels = image.channels;
  const at::Tensor pixels =
      at::from_blob(const_cast<float*>(image.pixels.data()),
                    {std::int64_t{image.height} * image.width, channels}, at::kFloat);
  const at::Tensor mean =
      at::from_blob(const_cast<float*>(axes.mean.data()), {channels}, at::kFloat);
  const at::Tensor matrix =
      at::from_blob(const_cast<float*>(axes.to_axes.data()), {channels, channels}, at::kFloat);
  return (pixels - mean)
      .matmul(matrix.t())
      .view({1, image.height, image.width, channels})
      .permute({0, 3, 1, 2});
}

}  // namespace

LessonPictures lesson_pictures(const GeneratorLesson& lesson, int levels) {
  std::vector<Layer> layers;
  for (const GeneratorLayer& layer : lesson.description.layers)
    layers.push_back({layer.name, layer.kind, layer.first, layer.count, layer.green});
  LessonPictures pictures{colour_axes(lesson.exemplars, layers, lesson.recipe.whitening), {}};
  for (const Image& exemplar : lesson.exemplars) {
    std::vector<at::Tensor> pyramid{along(exemplar, pictures.axes)};
    for (int k = 1; k < levels; ++k) pyramid.push_back(at::avg_pool2d(pyramid.back(), 2));
    std::reverse(pyramid.begin(), pyramid.end());
    for (at::Tensor& level : pyramid) level = level.contiguous(at::MemoryFormat::ChannelsLast);
    pictures.pyramids.push_back(std::move(pyramid));
  }
  return pictures;
}

void add_colours(const LessonPictures& pictures, const std::vector<Image>& exemplars,
                 GeneratorModel& model) {
  const ColourAxes& axes = pictures.axes;
  ChannelRange range = channel_range(exemplars.front());
  for (const Image& exemplar : exemplars) {
    const ChannelRange own = channel_range(exemplar);
    for (std::size_t c = 0; c < own.low.size(); ++c) {
      range.low[c] = std::min(range.low[c], own.low[c]);
      range.high[c] = std::max(range.high[c], own.high[c]);
    }
  }
  const std::int64_t channels = axes.channels;
  model.tensors["colours.mean"] = {{channels}, axes.mean};
  model.tensors["colours.axes"] = {{channels, channels}, axes.axes};
  model.tensors["colours.low"] = {{channels}, range.low};
  model.tensors["colours.high"] = {{channels}, range.high};
}

}  // namespace gramloom::train
