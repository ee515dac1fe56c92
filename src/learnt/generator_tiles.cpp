// The part of learnt/ that needs oneDNN: pictures of generators, tile by tile.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "core/threads.h"
#include "learnt/learnt_module.h"
#include "learnt/level_axis.h"
#include "learnt/level_network.h"
#include "learnt/noise.h"
#include "signal/normal_colours.h"

namespace gramloom {

namespace {

// No tile is larger. All are equally large, also those that stick out a little: their networks are
// made once.
constexpr int longest_tile = 192;

int tile_length(int length) {
  const int count = (length + longest_tile - 1) / longest_tile;
  return (length + count - 1) / count;
}

// A level's picture on a rectangle that begins at (x, y): channels interleaved.
struct Part {
  std::int64_t x = 0, y = 0;
  Image values;
};

struct Axes {
  std::vector<LevelAxis> x, y;
};

// The sizes of what is made of each level for a tile.
std::vector<Size> sizes_of(const GeneratorDescription& description, const Axes& axes, Size tile) {
  std::vector<Size> sizes(description.levels.size());
  Size size = tile;
  for (std::size_t k = sizes.size(); k-- > 0;) {
    const int border = 2 * description.levels[k].layers;
    sizes[k] = {size.width + border, size.height + border};
    size = {coarser_count(axes.x[k], sizes[k].width), coarser_count(axes.y[k], sizes[k].height)};
  }
  return sizes;
}

// Makes tiles, one after the other.
class TileMaker {
 public:
  TileMaker(const GeneratorModel& model, const Generation& wanted, const Axes& axes, Size tile)
      : model_(model), wanted_(wanted), axes_(axes), tile_(tile) {
    const auto sizes = sizes_of(model.description, axes, tile);
    for (int k = 0; k < model.level_count(); ++k)
      levels_.emplace_back(model, k, sizes[static_cast<std::size_t>(k)],
                           wanted.share_map.empty() ? std::span<const float>(wanted.shares)
                                                    : std::span<const float>());
  }

  // The finest level at [x, x + width) × [y, y + height) of the tile.
  Part make(std::int64_t x, std::int64_t y) {
    return make_level(model_.level_count() - 1, x, y, tile_);
  }

 private:
  // The picture of level k there.
  Part make_level(int k, std::int64_t x, std::int64_t y, Size size) {
    LevelNetwork& network = levels_[static_cast<std::size_t>(k)];
    const int border = model_.description.levels[static_cast<std::size_t>(k)].layers;
    const ChannelPlanes& input = network.input();
    const std::int64_t left = x - border, top = y - border;
    if (k > 0) lay_coarser(k, left, top, input);
    lay_noise(k, left, top, input);
    const ChannelPlanes& added = network.run(shares_at(k, left, top, input.size));
    Part part{x, y, Image(size, model_.description.channels)};
    for (int row = 0; row < size.height; ++row)
      for (int column = 0; column < size.width; ++column) {
        const std::size_t pixel =
            static_cast<std::size_t>(row + border) * static_cast<std::size_t>(input.size.width) +
            static_cast<std::size_t>(column + border);
        float* to = part.values.at(column, row);
        for (int c = 0; c < part.values.channels; ++c)
          to[c] = *added.at(c, pixel) + (k > 0 ? *input.at(c, pixel) : 0);
      }
    return part;
  }

  // The coarser level's picture, twice as large, as the first channels of the input.
  void lay_coarser(int k, std::int64_t left, std::int64_t top, const ChannelPlanes& input) {
    const auto level = static_cast<std::size_t>(k);
    const Upsampling columns = upsampling(axes_.x[level], left, input.size.width);
    const Upsampling rows = upsampling(axes_.y[level], top, input.size.height);
    const Size size{coarser_count(axes_.x[level], input.size.width),
                    coarser_count(axes_.y[level], input.size.height)};
    const Part coarser = make_level(k - 1, columns.from.front(), rows.from.front(), size);
    const int channels = coarser.values.channels;
    std::vector<float> line(static_cast<std::size_t>(size.width * channels));
    for (int row = 0; row < input.size.height; ++row) {
      const auto r = static_cast<std::size_t>(row);
      const float* above = coarser.values.at(0, static_cast<int>(rows.from[r] - coarser.y));
      const float* below = above + line.size();
      const float down = rows.weights[r];
      for (std::size_t i = 0; i < line.size(); ++i)
        line[i] = above[i] + down * (below[i] - above[i]);
      for (int column = 0; column < input.size.width; ++column) {
        const auto c = static_cast<std::size_t>(column);
        const float* one = &line[static_cast<std::size_t>(columns.from[c] - coarser.x) *
                                 static_cast<std::size_t>(channels)];
        const float* next = one + channels;
        const std::size_t pixel = r * static_cast<std::size_t>(input.size.width) + c;
        for (int channel = 0; channel < channels; ++channel)
          *input.at(channel, pixel) =
              one[channel] + columns.weights[c] * (next[channel] - one[channel]);
      }
    }
  }

  // Its last channels.
  void lay_noise(int k, std::int64_t left, std::int64_t top, const ChannelPlanes& input) const {
    const auto level = static_cast<std::size_t>(k);
    const int first = k == 0 ? 0 : model_.description.channels;
    const int groups = model_.description.levels[level].noise / 4;
    std::size_t pixel = 0;
    for (int row = 0; row < input.size.height; ++row)
      for (int column = 0; column < input.size.width; ++column, ++pixel)
        for (int group = 0; group < groups; ++group) {
          const auto words =
              pcg4d(axes_.x[level].noise_at(left + column), axes_.y[level].noise_at(top + row),
                    wanted_.seed, static_cast<std::uint32_t>(k * noise_groups_per_level + group));
          for (int i = 0; i < 4; ++i)
            *input.at(first + 4 * group + i, pixel) =
                noise_value(words[static_cast<std::size_t>(i)]);
        }
  }

  // The shares of the materials at the pixels of level k, where they change from place to place.
  PixelShares shares_at(int k, std::int64_t left, std::int64_t top, Size size) {
    const Image& map = wanted_.share_map;
    if (map.empty()) return {};
    const auto level = static_cast<std::size_t>(k);
    const double halved = std::ldexp(1.0, model_.level_count() - 1 - k);
    shares_.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
                   static_cast<std::size_t>(map.channels));
    float* to = shares_.data();
    // Around the edges where the picture tiles, else the nearest.
    const auto place = [&](const LevelAxis& axis, std::int64_t at, int length, int wanted) {
      const double own = axis.length > 0 ? static_cast<double>(axis.length) : wanted / halved;
      const double x =
          static_cast<double>(axis.length > 0 ? std::int64_t{axis.noise_at(at)} : at) + 0.5;
      const double there = x * length / own - 0.5;
      return axis.length > 0 && there < 0 ? there + length
             : axis.length > 0            ? there
                                          : std::clamp(there, 0.0, length - 1.0);
    };
    for (int row = 0; row < size.height; ++row) {
      const double y = place(axes_.y[level], top + row, map.height, wanted_.size.height);
      const int y0 = std::min(static_cast<int>(y), map.height - 1);
      for (int column = 0; column < size.width; ++column, to += map.channels) {
        const double x = place(axes_.x[level], left + column, map.width, wanted_.size.width);
        const int x0 = std::min(static_cast<int>(x), map.width - 1);
        const float right = static_cast<float>(x - x0), down = static_cast<float>(y - y0);
        const int x1 =
            axes_.x[level].length > 0 ? (x0 + 1) % map.width : std::min(x0 + 1, map.width - 1);
        const int y1 =
            axes_.y[level].length > 0 ? (y0 + 1) % map.height : std::min(y0 + 1, map.height - 1);
        for (int m = 0; m < map.channels; ++m)
          to[m] = (1 - down) * ((1 - right) * map.at(x0, y0)[m] + right * map.at(x1, y0)[m]) +
                  down * ((1 - right) * map.at(x0, y1)[m] + right * map.at(x1, y1)[m]);
      }
    }
    return shares_;
  }

  const GeneratorModel& model_;
  const Generation& wanted_;
  const Axes& axes_;
  Size tile_;
  std::vector<LevelNetwork> levels_;
  std::vector<float> shares_;
};

// Tile makers, lent to whichever thread asks.
class MakerPool {
 public:
  MakerPool(const GeneratorModel& model, const Generation& wanted, const Axes& axes, Size tile)
      : make_([&model, &wanted, &axes, tile] {
          return std::make_unique<TileMaker>(model, wanted, axes, tile);
        }) {}

  std::unique_ptr<TileMaker> borrow() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto maker = std::move(idle_.back());
        idle_.pop_back();
        return maker;
      }
    }
    return make_();
  }
  void give_back(std::unique_ptr<TileMaker> maker) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(maker));
  }

 private:
  std::function<std::unique_ptr<TileMaker>()> make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<TileMaker>> idle_;
};

// Colours of the picture, of values along the model's axes.
class Colours {
 public:
  explicit Colours(const GeneratorModel& model)
      : mean_(model.values("colours.mean")),
        axes_(model.values("colours.axes")),
        low_(model.values("colours.low")),
        high_(model.values("colours.high")) {
    for (const GeneratorLayer& layer : model.description.layers)
      if (layer.kind == MapKind::normal && layer.count == 3) normals_.push_back(layer.first);
  }

  void write(const float* values, float* pixel) const {
    const std::size_t channels = mean_.size();
    for (std::size_t c = 0; c < channels; ++c) {
      float sum = mean_[c];
      for (std::size_t i = 0; i < channels; ++i) sum += axes_[c * channels + i] * values[i];
      pixel[c] = std::clamp(sum, low_[c], high_[c]);
    }
    for (const int first : normals_) make_unit(pixel + first);
  }

 private:
  const std::vector<float>&mean_, &axes_, &low_, &high_;
  std::vector<int> normals_;  // their first channels
};

// oneDNN works in the thread that calls it: the tiles keep the cores busy.
class OneThread {
 public:
  OneThread() : before_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;

 private:
  int before_;
};

void generate_tiles(const GeneratorModel& model, const Generation& wanted, const WriteRows& write,
                    const Control& control) {
  const Size size = wanted.size;
  const int levels = model.level_count();
  const Axes axes{level_axes(size.width, tiles_x(wanted.tile), levels),
                  level_axes(size.height, tiles_y(wanted.tile), levels)};
  const Size tile{tile_length(size.width), tile_length(size.height)};
  const int columns = (size.width + tile.width - 1) / tile.width;
  const int rows = (size.height + tile.height - 1) / tile.height;
  const Colours colours(model);
  MakerPool makers(model, wanted, axes, tile);
  for (int row = 0; row < rows; ++row) {
    const int top = row * tile.height;
    const int height = std::min(tile.height, size.height - top);
    Image strip(Size{size.width, height}, model.description.channels);
    parallel_for(columns, 1, [&](std::int64_t begin, std::int64_t end) {
      const OneThread one;
      auto maker = makers.borrow();
      for (std::int64_t column = begin; column < end; ++column) {
        const int left = static_cast<int>(column) * tile.width;
        const Part part = maker->make(left, top);
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < std::min(tile.width, size.width - left); ++x)
            colours.write(part.values.at(x, y), strip.at(left + x, y));
      }
      makers.give_back(std::move(maker));
    });
    write(strip.pixels.data(), height);
    control.step(row + 1, rows);
  }
}

}  // namespace

extern "C" const LearntModule gramloom_learnt_module;
const LearntModule gramloom_learnt_module{generate_tiles};

}  // namespace gramloom
