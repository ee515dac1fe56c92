#pragma once

#include "neural/guidance.h"

namespace gramloom::neural {

/// The pixels of a picture that a fill makes, (channels, pixels): what an optimiser changes.
class MadePixels {
 public:
  /// Without a fill: none, and all() is true.
  explicit MadePixels(const Guidance& guidance);

  bool all() const { return !places_.defined(); }
  at::Tensor take(const at::Tensor& picture) const;
  void put(const at::Tensor& pixels, at::Tensor& picture) const;

 private:
  at::Tensor places_;
};

/// An image's pixels that are known become those very ones.
void copy_known(const Target& target, Image& image);

}  // namespace gramloom::neural
