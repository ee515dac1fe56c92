#include "jobs/frame_sequence.h"

namespace gramloom {

std::vector<std::vector<double>> poses_of(const FrameSequence& sequence) {
  std::vector<std::vector<double>> poses;
  for (int frame = 0; frame < sequence.frames; ++frame) {
    const bool last = frame > 0 && frame + 1 == sequence.frames;
    const double done = frame == 0 ? 0 : 1.0 * frame / (sequence.frames - 1);
    std::vector<double>& between = poses.emplace_back();
    for (std::size_t i = 0; i < sequence.pose.size(); ++i)
      between.push_back(last ? sequence.to[i]
                             : sequence.pose[i] + done * (sequence.to[i] - sequence.pose[i]));
  }
  return poses;
}

}  // namespace gramloom
