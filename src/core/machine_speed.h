#pragma once

#include "core/cost.h"

namespace gramloom {

/// How fast this machine compares patches of pictures, with one thread and with thread_count() of
/// them: what most of the methods' time goes to. Takes a third of a second. Its `operations` are
/// not measured: a library of matrices knows them.
Speed measure_speed();

}  // namespace gramloom
