#pragma once

#include <string>
#include <vector>

namespace gramloom {

/// Lets the threads of libgomp, which LibTorch and its libraries work with, sleep soon when there
/// is nothing to do (GOMP_SPINCOUNT): by default they spin for milliseconds after each loop, which
/// costs more than it saves, several times so beside other programs. Nothing happens when the user
/// has set GOMP_SPINCOUNT or OMP_WAIT_POLICY.
///
/// libgomp reads this when it is loaded. Where it already is, the program begins anew with the
/// same `arguments`: to be called before anything that must not happen twice.
void bound_spinning(const std::vector<std::string>& arguments);

}  // namespace gramloom
