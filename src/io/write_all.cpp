#include "io/write_all.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace gramloom {

bool wait_for(int descriptor, short event) {
  if (errno == EINTR) return true;
  pollfd waiting{descriptor, event, 0};
  return errno == EAGAIN && (poll(&waiting, 1, -1) > 0 || errno == EINTR);
}

bool write_all(int descriptor, std::string_view text) {
  // Linux writes at most 2 GB a call.
  constexpr std::size_t most = 1 << 30;
  while (!text.empty()) {
    const ssize_t count = write(descriptor, text.data(), std::min(text.size(), most));
    if (count < 0 && wait_for(descriptor, POLLOUT)) continue;
    if (count < 0) return false;
    if (count == 0) {  // or it would be tried for ever
      errno = EIO;
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace gramloom
