#pragma once

#include "core/cost.h"

namespace gramloom {

/// The speed of this machine with thread_count() threads. Measured in about a second, and kept in
/// gramloom/speed.json of the user's cache folder (XDG_CACHE_HOME, or .cache in HOME). Measured
/// again for another processor, number of threads or version, and when it is older than a day: then
/// the best counts, as other work only slows a machine. Without `with_operations` nobody asks for
/// matrix products, which open LibTorch; where the neural part is not installed they are taken to
/// be as fast as all else is.
Speed machine_speed(bool with_operations);

}  // namespace gramloom
