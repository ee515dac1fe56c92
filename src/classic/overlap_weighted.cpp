#include "classic/overlap_weighted.h"

#include <algorithm>

#include "core/simd.h"
#include "core/threads.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

/// Blocks of about this side, or of this many patches: small ones stay in the cache, and much
/// smaller ones would overlap for the most part.
constexpr int block_side = 384;
constexpr int block_patches = 4;

/// sum += a · conj(b), of complex numbers whose parts follow each other.
GRAMLOOM_SIMD void add_products(const float* __restrict a, const float* __restrict b,
                                float* __restrict sum, int count) {
  for (int i = 0; i < 2 * count; i += 2) {
    sum[i] += a[i] * b[i] + a[i + 1] * b[i + 1];
    sum[i + 1] += a[i + 1] * b[i] - a[i] * b[i + 1];
  }
}

/// The same of a column of OpenCV's packed spectrum that is real but for its own transform: Re 0,
/// Re 1, Im 1, Re 2, …, and at an even number of rows a real one at the end.
void add_column_products(const cv::Mat& a, const cv::Mat& b, cv::Mat& sum, int column) {
  const auto add_real = [&](int row) {
    sum.at<float>(row, column) += a.at<float>(row, column) * b.at<float>(row, column);
  };
  add_real(0);
  for (int row = 1; row + 1 < a.rows; row += 2) {
    const float ar = a.at<float>(row, column), ai = a.at<float>(row + 1, column);
    const float br = b.at<float>(row, column), bi = b.at<float>(row + 1, column);
    sum.at<float>(row, column) += ar * br + ai * bi;
    sum.at<float>(row + 1, column) += ai * br - ar * bi;
  }
  if (a.rows % 2 == 0) add_real(a.rows - 1);
}

/// sum += a · conj(b), spectra as cv::dft packs those of real planes. cv::mulSpectrums() takes
/// several times as long.
void add_spectra(const cv::Mat& a, const cv::Mat& b, cv::Mat& sum) {
  const int pairs = (a.cols - 1) / 2;
  add_column_products(a, b, sum, 0);
  for (int row = 0; row < a.rows; ++row)
    add_products(a.ptr<float>(row) + 1, b.ptr<float>(row) + 1, sum.ptr<float>(row) + 1, pairs);
  if (a.cols > 1 && a.cols % 2 == 0) add_column_products(a, b, sum, a.cols - 1);
}

}  // namespace

WeightedErrors::Axis WeightedErrors::cover(int exemplar, int patch) {
  const int positions = exemplar - patch + 1;
  const int most = std::max(block_side, block_patches * patch) - patch + 1;
  const int blocks = (positions + most - 1) / most;
  const int valid = (positions + blocks - 1) / blocks;
  return {positions, valid, fast_length_up(valid + patch - 1)};
}

/// Of a plane in the upper left of a block, where all below `rows` is 0.
cv::Mat WeightedErrors::spectrum(const cv::Mat& plane, int rows) const {
  cv::Mat padded = cv::Mat::zeros(down_.length, across_.length, CV_32F);
  plane.copyTo(padded({0, 0, plane.cols, plane.rows}));
  cv::dft(padded, padded, 0, nonzero_rows(rows));
  return padded;
}

WeightedErrors::WeightedErrors(const Image& exemplar, Size patch)
    : patch_(patch),
      across_(cover(exemplar.width, patch.width)),
      down_(cover(exemplar.height, patch.height)) {
  std::vector<cv::Mat> planes;
  cv::Mat energy = cv::Mat::zeros(exemplar.height, exemplar.width, CV_32F);
  for (int c = 0; c < exemplar.channels; ++c) {
    cv::Mat plane = channel_plane(exemplar, c);
    mean_.push_back(static_cast<float>(cv::mean(plane)[0]));
    plane -= mean_.back();
    energy += plane.mul(plane);
    planes.push_back(plane);
  }
  variance_ = cv::mean(energy)[0];
  planes.push_back(energy);

  const int blocks = across_.count() * down_.count();
  spectra_.resize(to_size(blocks) * planes.size());
  parallel_for(blocks, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto block = static_cast<int>(begin); block < end; ++block) {
      const int left = block % across_.count() * across_.valid;
      const int top = block / across_.count() * down_.valid;
      const cv::Rect part(left, top, std::min(across_.length, exemplar.width - left),
                          std::min(down_.length, exemplar.height - top));
      for (std::size_t c = 0; c < planes.size(); ++c)
        spectra_[to_size(block) * planes.size() + c] = spectrum(planes[c](part), part.height);
    }
  });
}

void WeightedErrors::add_to(std::vector<float>& errors, const Image& patch,
                            const std::vector<float>& weights, float factor) const {
  const cv::Mat weight(patch.height, patch.width, CV_32F, const_cast<float*>(weights.data()));
  std::vector<cv::Mat> wanted;  // as spectra_: −2 · weight · patch, and the weight; empty: all 0
  double patch_energy = 0;
  for (int c = 0; c < patch.channels; ++c) {
    cv::Mat plane = channel_plane(patch, c);
    plane -= mean_[to_size(c)];
    const cv::Mat weighted = weight.mul(plane);
    patch_energy += weighted.dot(plane);
    wanted.push_back(cv::countNonZero(weighted) > 0 ? spectrum(weighted * -2, patch.height)
                                                    : cv::Mat());
  }
  wanted.push_back(spectrum(weight, patch.height));

  parallel_for(across_.count() * down_.count(), 1, [&](std::int64_t begin, std::int64_t end) {
    cv::Mat sum(down_.length, across_.length, CV_32F);
    for (auto block = static_cast<int>(begin); block < end; ++block) {
      const int left = block % across_.count() * across_.valid;
      const int top = block / across_.count() * down_.valid;
      const int rows = std::min(down_.valid, down_.positions - top);
      const int columns = std::min(across_.valid, across_.positions - left);
      const std::size_t first = to_size(block) * wanted.size();
      sum.setTo(0);
      for (std::size_t c = 0; c < wanted.size(); ++c)
        if (!wanted[c].empty()) add_spectra(spectra_[first + c], wanted[c], sum);
      cv::dft(sum, sum, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT, nonzero_rows(rows));
      for (int v = 0; v < rows; ++v) {
        const float* from = sum.ptr<float>(v);
        float* to = errors.data() + to_size(top + v) * to_size(across_.positions) + left;
        for (int u = 0; u < columns; ++u)
          to[u] += factor * std::max(0.0f, from[u] + static_cast<float>(patch_energy));
      }
    }
  });
}

}  // namespace gramloom
