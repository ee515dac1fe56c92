#include "jobs/peers.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "io/image_file.h"
#include "jobs/exemplar_folder.h"
#include "jobs/score_files.h"
#include "runs/job_files.h"
#include "runs/job_maps.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// The peer's pictures of one exemplar.
std::vector<fs::path> pictures_of(const Peer& peer, const std::vector<fs::path>& in_folder,
                                  const std::string& exemplar) {
  const auto is_of = [&](const fs::path& file) { return file.stem().string() == exemplar; };
  std::vector<fs::path> pictures;
  std::ranges::copy_if(in_folder, std::back_inserter(pictures), is_of);
  std::error_code ignored;
  if (pictures.empty() && fs::is_directory(peer.folder / exemplar, ignored))
    pictures = pictures_in(peer.folder / exemplar);
  return pictures;
}

// The exemplars of the run's jobs, in their order; methods without one are not compared.
std::vector<std::string> exemplars_of(const RunOnDisk& run) {
  std::vector<std::string> exemplars;
  for (const JobOnDisk& job : run.jobs)
    if (!kept_exemplar(run.folder, job.record.exemplar).empty() &&
        std::ranges::find(exemplars, job.record.exemplar) == exemplars.end())
      exemplars.push_back(job.record.exemplar);
  return exemplars;
}

// A line of the sheet of scores; of no time is anything known.
ScoreRow row_of(const Peer& peer, const std::string& exemplar, int number, const Scores& scores,
                std::optional<double> diversity) {
  ScoreRow row{exemplar, peer.name, "", number, Status::done, {}, {}, {}};
  for (const Metric& metric : metrics()) {
    const auto found =
        std::ranges::find(scores.values, metric.name, &std::pair<std::string_view, double>::first);
    if (metric.name == "diversity")
      row.scores.push_back(diversity);
    else if (found == scores.values.end() || !std::isfinite(found->second))
      row.scores.push_back(std::nullopt);
    else
      row.scores.push_back(found->second);
  }
  return row;
}

std::optional<double> diversity_of(const std::vector<const ScoredImage*>& pictures,
                                   const Control& control) {
  if (pictures.size() < 2) return std::nullopt;
  std::vector<Image> images;
  for (const ScoredImage* picture : pictures) images.push_back(read_image(picture->name).image);
  return diversity(images, control);
}

// Scores a peer's pictures of one exemplar into `all`.
void score_pictures(const RunOnDisk& run, const Peer& peer, const std::string& exemplar,
                    const std::vector<fs::path>& pictures, PeerScores& all,
                    const Control& control) {
  const std::vector<std::string> names(pictures.begin(), pictures.end());
  const auto scored = score_files(run.folder / kept_exemplar(run.folder, exemplar), names,
                                  tile_of(run.run.settings), false, control);
  std::vector<const ScoredImage*> good;
  for (const ScoredImage& picture : scored)
    if (picture.error.empty())
      good.push_back(&picture);
    else
      all.missing.push_back(fmt::format("peer {}: {}", peer.name, picture.error));
  const auto diverse = diversity_of(good, control);
  for (int number = 1; const ScoredImage* picture : good)
    all.rows.push_back(row_of(peer, exemplar, number++, picture->scores, diverse));
}

void score_peer(const RunOnDisk& run, const Peer& peer, PeerScores& all, const Control& control) {
  std::vector<fs::path> in_folder;
  try {
    in_folder = pictures_in(peer.folder);
  } catch (const Error& error) {
    throw ConfigError("--peer {}: {}", peer.name, error.what());
  }
  const std::vector<std::string> exemplars = exemplars_of(run);
  bool any = false;
  for (const std::string& exemplar : exemplars) {
    const auto pictures = pictures_of(peer, in_folder, exemplar);
    any |= !pictures.empty();
    if (pictures.empty())
      all.missing.push_back(fmt::format("peer {}: {} has no picture of the exemplar '{}'",
                                        peer.name, peer.folder.string(), exemplar));
    else
      score_pictures(run, peer, exemplar, pictures, all, control);
  }
  if (!any)
    throw ConfigError("--peer {}: no picture in {} is called like an exemplar of the run ({})",
                      peer.name, peer.folder.string(), fmt::join(exemplars, ", "));
}

}  // namespace

Peer parse_peer(const std::string& option) {
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == option.size())
    throw ConfigError("--peer {}: must be NAME=FOLDER", option);
  return {option.substr(0, equals), option.substr(equals + 1)};
}

PeerScores score_peers(const RunOnDisk& run, const std::vector<Peer>& peers,
                       const Control& control) {
  std::set<std::string> taken;
  for (const JobOnDisk& job : run.jobs) taken.insert(job.record.method);
  for (const Peer& peer : peers)
    if (!taken.insert(peer.name).second)
      throw ConfigError("--peer {}: the name is taken by a method or another peer", peer.name);
  PeerScores all;
  for (const Peer& peer : peers) score_peer(run, peer, all, control);
  return all;
}

}  // namespace gramloom
