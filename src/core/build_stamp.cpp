#include "core/build_stamp.h"

#include "core/build_stamp_value.h"

namespace gramloom {

std::string_view build_stamp() { return GRAMLOOM_BUILD_STAMP; }

}  // namespace gramloom
