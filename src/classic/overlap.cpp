#include "classic/overlap.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/simd.h"

namespace gramloom {

namespace {

/// Output lines that are transformed back together: they stay in the first cache.
constexpr int block_lines = 32;

/// Frequencies are padded to a multiple of this with zeros.
constexpr int lanes = 16;
using Lanes __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias)) = float;

Image transposed_image(const Image& image) {
  Image result(image.height, image.width, image.channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.at(x, y), image.channels, result.at(y, x));
  return result;
}

/// sum += Σ a · conj(b) over `terms` spectra that follow each other in `a` and in `b`, for `lines`
/// sums of which each begins `a_step` values of `a` after the last. A spectrum has `count`
/// frequencies, a multiple of `lanes`, real parts first, then imaginary ones. Frequency by
/// frequency, so that what neighbouring lines share stays in the cache.
GRAMLOOM_SIMD void add_products(const float* a, std::ptrdiff_t a_step, const float* b, int terms,
                                float* sum, int lines, int count) {
  const Lanes* bv = reinterpret_cast<const Lanes*>(b);
  const int half = count / lanes;
  for (int f = 0; f < half; ++f)
    for (int line = 0; line < lines; ++line) {
      const Lanes* av = reinterpret_cast<const Lanes*>(a + line * a_step);
      Lanes* sums = reinterpret_cast<Lanes*>(sum + line * 2 * count);
      Lanes re = sums[f], im = sums[half + f];
      for (int i = f; i < f + 2 * half * terms; i += 2 * half) {
        re += av[i] * bv[i] + av[half + i] * bv[half + i];
        im += av[half + i] * bv[i] - av[i] * bv[half + i];
      }
      sums[f] = re;
      sums[half + f] = im;
    }
}

/// To and from OpenCV's packed spectrum of real values: Re 0, Re 1, Im 1, Re 2, Im 2, …
void split(const float* packed, int length, float* parts, int count) {
  parts[0] = packed[0];
  for (int f = 1; 2 * f <= length; ++f) {
    parts[f] = packed[2 * f - 1];
    if (2 * f < length) parts[count + f] = packed[2 * f];
  }
}

GRAMLOOM_SIMD void pack(const float* __restrict parts, int count, int length,
                        float* __restrict packed) {
  packed[0] = parts[0];
  for (int f = 1; 2 * f < length; ++f) {
    packed[2 * f - 1] = parts[f];
    packed[2 * f] = parts[count + f];
  }
  if (length % 2 == 0) packed[length - 1] = parts[length / 2];
}

GRAMLOOM_SIMD void subtract_twice(const float* __restrict from, float* __restrict errors,
                                  int count) {
  for (int i = 0; i < count; ++i) errors[i] -= 2 * from[i];
}

GRAMLOOM_SIMD void keep_positive(float* errors, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) errors[i] = errors[i] > 0 ? errors[i] : 0;
}

/// errors[u] = patch_energy + sum over the patch − sum over its unfilled part, for a row of
/// positions; the four pointers of each rectangle are the corners of a summed-area table.
GRAMLOOM_SIMD void energies(const double* const (&all)[4], const double* const (&inside)[4],
                            double patch_energy, float* __restrict errors, int count) {
  for (int u = 0; u < count; ++u)
    errors[u] = static_cast<float>(patch_energy + (all[3][u] - all[2][u] - all[1][u] + all[0][u]) -
                                   (inside[3][u] - inside[2][u] - inside[1][u] + inside[0][u]));
}

}  // namespace

int OverlapErrors::Spectra::frequencies() const {
  return (length / 2 + 1 + lanes - 1) / lanes * lanes;
}

const float* OverlapErrors::Spectra::at(int row, int channel) const {
  return values.ptr<float>(row) + channel * 2 * frequencies();
}

OverlapErrors::OverlapErrors(const Image& exemplar, Size patch)
    : patch_(patch),
      positions_{exemplar.width - patch.width + 1, exemplar.height - patch.height + 1},
      mean_(to_size(exemplar.channels)) {
  const double pixels = static_cast<double>(exemplar.width) * exemplar.height;
  for (std::size_t c = 0; c < mean_.size(); ++c) {
    double sum = 0;
    for (std::size_t i = c; i < exemplar.pixels.size(); i += mean_.size())
      sum += exemplar.pixels[i];
    mean_[c] = static_cast<float>(sum / pixels);
  }
  const Image values = centred(exemplar, {exemplar.width, 0, 0, 0});
  const std::size_t stride = to_size(exemplar.width + 1);
  energy_sums_.assign(stride * to_size(exemplar.height + 1), 0.0);
  for (int y = 0; y < exemplar.height; ++y) {
    double row = 0;
    for (int x = 0; x < exemplar.width; ++x) {
      const float* pixel = values.at(x, y);
      for (int c = 0; c < exemplar.channels; ++c) row += double{pixel[c]} * double{pixel[c]};
      const std::size_t above = to_size(y) * stride + to_size(x + 1);
      energy_sums_[above + stride] = energy_sums_[above] + row;
    }
  }
  variance_ = energy_sums_.back() / pixels;
  rows_ = spectra_of_rows(values, cv::getOptimalDFTSize(exemplar.width));
  columns_ = spectra_of_rows(transposed_image(values), cv::getOptimalDFTSize(exemplar.height));
}

float OverlapErrors::scale(const Sides& sides) const {
  const int inside =
      (patch_.width - sides.left - sides.right) * (patch_.height - sides.top - sides.bottom);
  return static_cast<float>(variance_ * (patch_.width * patch_.height - inside));
}

float OverlapErrors::noise(const Sides& sides) const { return 1e-5f * scale(sides); }

void OverlapErrors::compute(const Image& patch, const Sides& sides,
                            std::vector<float>& errors) const {
  const Image values = centred(patch, sides);
  double patch_energy = 0;
  for (const float value : values.pixels) patch_energy += double{value} * double{value};
  add_energies(sides, patch_energy, errors);
  const int below = patch.height - sides.bottom, right = patch.width - sides.right;
  subtract_correlations(rows_, values, {{0, sides.top}, {below, patch.height}}, positions_, false,
                        errors);
  // The corners belong to the rows.
  Image columns = transposed_image(values);
  for (int x = 0; x < patch.width; ++x)
    for (int y = 0; y < patch.height; ++y)
      if (y < sides.top || y >= below) std::fill_n(columns.at(y, x), patch.channels, 0.0f);
  subtract_correlations(columns_, columns, {{0, sides.left}, {right, patch.width}},
                        {positions_.height, positions_.width}, true, errors);
  keep_positive(errors.data(), errors.size());
}

OverlapErrors::Spectra OverlapErrors::spectra_of_rows(const Image& image, int length) {
  Spectra result{length, image.channels, {}};
  // Not zeros(): OpenCV sets its expressions up on first use, which looks like a race.
  result.values.create(image.height, image.channels * 2 * result.frequencies());
  result.values = 0.0f;
  cv::Mat lines(image.channels, length, CV_32F);
  for (int y = 0; y < image.height; ++y) {
    const float* row = image.at(0, y);
    if (std::all_of(row, row + image.width * image.channels, [](float v) { return v == 0; }))
      continue;  // the unfilled rows of a patch
    lines.setTo(0);
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) lines.at<float>(c, x) = image.at(x, y)[c];
    cv::dft(lines, lines, cv::DFT_ROWS);
    for (int c = 0; c < image.channels; ++c)
      split(lines.ptr<float>(c), length, result.values.ptr<float>(y) + c * 2 * result.frequencies(),
            result.frequencies());
  }
  return result;
}

/// image − mean where `sides` are filled, else 0.
Image OverlapErrors::centred(const Image& image, const Sides& sides) const {
  Image result(image.size(), image.channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (sides.covers(x, y, image.size()))
        for (int c = 0; c < image.channels; ++c)
          result.at(x, y)[c] = image.at(x, y)[c] - mean_[to_size(c)];
  return result;
}

void OverlapErrors::add_energies(const Sides& sides, double patch_energy,
                                 std::vector<float>& errors) const {
  errors.resize(to_size(positions_.width) * to_size(positions_.height));
  const int stride = positions_.width + patch_.width;  // exemplar's width + 1
  const auto corners = [&](int left, int top, int right, int bottom, const double*(&to)[4]) {
    const double* sums = energy_sums_.data();
    to[0] = sums + to_size(top) * to_size(stride) + left;
    to[1] = sums + to_size(top) * to_size(stride) + right;
    to[2] = sums + to_size(bottom) * to_size(stride) + left;
    to[3] = sums + to_size(bottom) * to_size(stride) + right;
  };
  const int right = patch_.width - sides.right, bottom = patch_.height - sides.bottom;
  for (int v = 0; v < positions_.height; ++v) {
    const double *all[4], *inside[4];
    corners(0, v, patch_.width, v + patch_.height, all);
    corners(sides.left, v + sides.top, right, v + bottom, inside);
    energies(all, inside, patch_energy, errors.data() + to_size(v) * to_size(positions_.width),
             positions_.width);
  }
}

/// errors −= 2 Σ exemplar · patch over the patch's rows in `bands`. valid: positions along a row,
/// and rows. When transposed, `exemplar` and `patch` are, and errors are not.
void OverlapErrors::subtract_correlations(const Spectra& exemplar, const Image& patch,
                                          const std::vector<Band>& bands, Size valid,
                                          bool transposed, std::vector<float>& errors) const {
  if (std::ranges::all_of(bands, [](Band b) { return b.first == b.last; })) return;
  const Spectra patch_spectra = spectra_of_rows(patch, exemplar.length);
  const int frequencies = exemplar.frequencies();
  const std::ptrdiff_t row_values = std::ptrdiff_t{2} * frequencies * patch.channels;
  cv::Mat1f sums(block_lines, 2 * frequencies);
  cv::Mat block(block_lines, exemplar.length, CV_32F), lines, across;
  for (int first = 0; first < valid.height; first += block_lines) {
    const int count = std::min(block_lines, valid.height - first);
    sums.setTo(0);
    for (const Band& band : bands)
      if (band.first < band.last)
        add_products(exemplar.at(first + band.first, 0), row_values,
                     patch_spectra.at(band.first, 0), (band.last - band.first) * patch.channels,
                     sums.ptr<float>(), count, frequencies);
    for (int line = 0; line < count; ++line)
      pack(sums.ptr<float>(line), frequencies, exemplar.length, block.ptr<float>(line));
    lines = block.rowRange(0, count);
    cv::dft(lines, lines, cv::DFT_ROWS | cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    if (!transposed) {
      for (int line = 0; line < count; ++line)
        subtract_twice(lines.ptr<float>(line),
                       errors.data() + to_size(first + line) * to_size(valid.width), valid.width);
      continue;
    }
    cv::transpose(lines.colRange(0, valid.width), across);
    for (int v = 0; v < valid.width; ++v)
      subtract_twice(across.ptr<float>(v),
                     errors.data() + to_size(v) * to_size(valid.height) + first, count);
  }
}

}  // namespace gramloom
