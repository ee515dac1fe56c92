#pragma once

#include <algorithm>
#include <vector>

#include "core/request.h"
#include "signal/united.h"

namespace gramloom {

/// Several exemplars without weights are one material: each is to make about as much of the texture
/// as it has of all usable pixels. What fits best would often never leave the first one; so an
/// exemplar that has made its part gets worse the more it goes beyond. Weights that are everywhere
/// the same are such parts too: as a guide they would choose the one with the largest.
class ExemplarQuota {
 public:
  /// Of nothing: none goes beyond.
  ExemplarQuota() = default;
  /// Where a guide, other weights or known pixels tell what goes where there are no quotas either.
  ExemplarQuota(const Request& request, const United& united);

  /// What the target asks of the joined picture's guide (united.guide()), but for weights that are
  /// quotas.
  const Image& guide(const United& united) const { return empty() ? united.guide() : none_; }

  bool empty() const { return shares_.empty(); }
  /// Which exemplar this column of the joined picture is of.
  std::size_t exemplar_at(int column) const {
    return exemplar_[std::min(static_cast<std::size_t>(column), exemplar_.size() - 1)];
  }
  void add(std::size_t exemplar, double part) { made_[exemplar] += part; }
  /// What a place of each exemplar costs now, in terms of the error of places that have nothing in
  /// common. add() counts parts of the whole texture.
  std::vector<float> costs() const;

 private:
  Image none_;
  std::vector<double> shares_, made_;  // of each exemplar
  std::vector<std::size_t> exemplar_;  // of each column of the joined picture
};

}  // namespace gramloom
