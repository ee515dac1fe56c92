#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "runs/run_folder.h"
#include "runs/score_sheet.h"

namespace gramloom {

/// Another program's pictures of a run's exemplars: FOLDER/pebbles.png, or several of one,
/// FOLDER/pebbles/*.png, as seeds are several.
struct Peer {
  std::string name;
  std::filesystem::path folder;
};

/// "vgg19=FOLDER". Throws ConfigError.
Peer parse_peer(const std::string& option);

/// Peers' pictures scored as a run's are.
struct PeerScores {
  std::vector<ScoreRow> rows;        // of metrics(); the peer's name is the method's
  std::vector<std::string> missing;  // a line for each exemplar without pictures, each bad picture
};

/// Against the exemplars as the run keeps them, with the seams of the axes on which the run tiles.
/// Throws ConfigError for a folder without a picture of any exemplar and for a name that a method
/// or another peer has; Error when the run's exemplars cannot be read.
PeerScores score_peers(const RunOnDisk& run, const std::vector<Peer>& peers,
                       const Control& control);

}  // namespace gramloom
