#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "neural/group.h"

namespace gramloom::neural {

/// Which of how many processes this one is, and how they find each other.
struct GroupPlace {
  int rank = 0;
  int size = 1;
  /// "HOST:PORT", where process 0 listens and the others call; or the path of a file in a folder
  /// that all of them see, which is there for these processes alone.
  std::string meeting;
  /// How long one waits for another that neither answers nor is gone.
  std::chrono::seconds patience{1800};
};

/// Waits for the others. They talk by Gloo, over TCP. Throws GroupLost when they do not come.
std::shared_ptr<Group> join_group(const GroupPlace& place);

}  // namespace gramloom::neural
