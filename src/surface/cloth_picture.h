#pragma once

#include "core/image.h"
#include "surface/arm.h"
#include "surface/cloth_sheet.h"

namespace gramloom {

/// How far a sheet around an arm lies outside the arm's tube (of radius 1), in radii; negative
/// inside. One channel; rows along the arm from its upper end, columns around it from the outside
/// of the elbow, so that the middle column is its inside; wraps in x. Where the sheet lies over
/// itself the outermost counts, and where there is none, `bare`.
Image displacement_picture(const ClothSheet& sheet, const ArmAxis& axis, Size size, double bare);

}  // namespace gramloom
