#pragma once

#include <functional>
#include <opencv2/core.hpp>

#include "core/image.h"

namespace gramloom {

/// What a filter makes of `image`, of that size: it is given some channels at a time, as OpenCV's
/// filters promise no more than four.
Image filtered_in_groups(const Image& image, Size size,
                         const std::function<void(const cv::Mat& from, cv::Mat& to)>& filter);

}  // namespace gramloom
