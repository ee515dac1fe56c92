#pragma once

#include <string_view>

namespace gramloom {

/// After a call that failed with errno: whether to try it again, when there is something to read or
/// room to write (POLLIN, POLLOUT).
bool wait_for(int descriptor, short event);

/// Writes `bytes` where the descriptor stands. False when that failed; errno says why.
bool write_all(int descriptor, std::string_view bytes);

}  // namespace gramloom
