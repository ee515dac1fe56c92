#include "jobs/one_job.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "jobs/interruption.h"
#include "jobs/run_job.h"
#include "jobs/texture_rows.h"
#include "jobs/unit_normals.h"
#include "neural/shares.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* usual_meeting = "127.0.0.1:29571";

std::string environment(const char* name) {
  const char* text = std::getenv(name);
  return text ? text : "";
}

// The process of a step of Slurm as "2/4"; "": this is none.
std::string process_of_slurm() {
  const std::string id = environment("SLURM_PROCID"), count = environment("SLURM_NTASKS");
  if (id.empty() || count.empty()) return "";
  return fmt::format("{}/{}", std::atoi(id.c_str()) + 1, count);
}

// Rows that are sent and written at a time.
int rows_at_once(const Image& image) {
  constexpr int values = 1 << 22;
  return std::max(1, values / std::max(1, image.width * image.channels));
}

std::span<std::byte> bytes_of(std::span<float> values) { return std::as_writable_bytes(values); }

std::span<float> rows_of(Image& image, int first, int count) {
  const auto row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  return std::span(image.pixels)
      .subspan(row * static_cast<std::size_t>(first), row * static_cast<std::size_t>(count));
}

int height_of(int height, int rank, int size) {
  return static_cast<int>(neural::begin_of_share(height, rank + 1, size) -
                          neural::begin_of_share(height, rank, size));
}

// To process 1.
void send_rows(const neural::Group& group, Image own) {
  const int at_once = rows_at_once(own);
  for (int y = 0; y < own.height; y += at_once)
    group.exchange({{0, bytes_of(rows_of(own, y, std::min(at_once, own.height - y)))}}, {});
}

void check_config(const Config& config) {
  const auto refuse = [&](bool asked, const char* what) {
    if (asked)
      throw ConfigError("{}: {} cannot be honoured with --one-job", config.file.string(), what);
  };
  const Direction& direction = config.direction;
  refuse(direction.fill.has_value(), "[fill]");
  refuse(direction.guide.has_value(), "[guide]");
  refuse(direction.mix.has_value(), "[mix]");
  refuse(direction.turn.has_value(), "[turn]");
  refuse(!config.previews.empty(), "[preview]");
  refuse(makes_any(config.surface), "[surface]");
}

const NeuralParams& neural_params(const Config& config, const Job& job) {
  const MethodEntry& method = config.methods[job.method];
  const auto* params = std::get_if<NeuralParams>(&method.method);
  if (!params)
    throw ConfigError("{}: method '{}' of kind '{}' is made by one process: not with --one-job",
                      method.place, method.name, kind_of(method.method));
  return *params;
}

RequestSize request_of_job(const Config& config, const Plan& plan, const Job& job) {
  RequestSize request = plan.exemplars[job.exemplar.value()].request;
  request.size = config.size;
  request.tile = config.tile;
  return request;
}

}  // namespace

neural::GroupPlace group_place(const OneJobOptions& asked, const fs::path& output) {
  const bool by_slurm = asked.process.empty();
  const std::string process = by_slurm ? process_of_slurm() : asked.process;
  if (process.empty())
    throw ConfigError(
        "--one-job: say which process of how many this is (--one-job 1/2, and --one-job 2/2 for "
        "the other one), or start them by srun");
  neural::GroupPlace place;
  try {
    const Shard shard = parse_shard(process);
    place.rank = shard.index - 1;
    place.size = shard.count;
  } catch (const Error&) {
    throw ConfigError("--one-job: '{}' is no process K of N, as K/N with K from 1 to N", process);
  }
  place.patience = std::chrono::seconds(asked.patience);
  place.meeting = asked.meeting.empty() ? usual_meeting : asked.meeting;
  if (by_slurm && asked.meeting.empty()) {  // on any machines, and a name that no other step has
    place.meeting =
        (output / fmt::format("one_job.{}.{}.{}", environment("SLURM_JOB_ID"),
                              environment("SLURM_STEP_ID"), environment("SLURM_RESTART_COUNT")))
            .string();
  }
  return place;
}

void check_together(const Config& config, const std::string& only, int processes) {
  check_config(config);
  const Plan plan = make_plan(config, only);
  for (const PlannedJob& planned : plan.jobs) {
    if (!planned.selected) continue;
    const MethodEntry& method = config.methods[planned.job.method];
    const NeuralParams& params = neural_params(config, planned.job);
    if (!planned.error.empty()) continue;  // said when the job fails
    try {
      neural::check_shared(params, request_of_job(config, plan, planned.job), processes);
    } catch (const ConfigError& error) {
      throw ConfigError("{}: method '{}': {}", method.place, method.name, error.what());
    }
  }
}

void estimate_together(const Config& config, Plan& plan, int processes) {
  for (PlannedJob& planned : plan.jobs)
    if (planned.selected && planned.error.empty()) {
      planned.cost = estimate_share(neural_params(config, planned.job),
                                    request_of_job(config, plan, planned.job), processes);
      planned.finishing.bytes = 0;  // some rows at a time
    }
}

void say_next(const neural::Group& group, std::optional<int> job) {
  std::int32_t number = job.value_or(-1);
  group.first(std::span(&number, 1));
}

void say_unready(const neural::Group& group) { group.any(true); }

void begin_together(const neural::Group& group, const std::string& identity) {
  if (group.any(false)) throw Error("one of the {} processes cannot begin it", group.size());
  // Of this many bits of a hash the first process' are those of all.
  const auto own = static_cast<std::int32_t>(std::hash<std::string>()(identity) % (1u << 31));
  std::int32_t first = own;
  group.first(std::span(&first, 1));
  if (group.any(first != own))
    throw Error("the {} processes were to make different textures: their configs or files differ",
                group.size());
}

OwnRows make_together(const neural::Group& group, const Method& method, const Request& request,
                      const Control& control, const std::function<bool()>& stopped) {
  Texture rows = synthesise_rows(std::get<NeuralParams>(method), request, control, group);
  keep_normals_unit(rows, request.exemplars);
  return {std::move(rows.image), group.any(stopped())};
}

WrittenTexture write_together(const neural::Group& group, const Image& own, const Config& config,
                              const std::vector<ExemplarFile>& files, const fs::path& folder,
                              const std::string& name, const OutputFormats& formats,
                              const Json& settings, const Metadata& picture) {
  TextureRows writer(folder, name, config.size, formats, settings, picture);
  const int at_once = rows_at_once(own);
  for (int rank = 0; rank < group.size(); ++rank) {
    const int height = height_of(config.size.height, rank, group.size());
    for (int y = 0; y < height; y += at_once) {
      const int count = std::min(at_once, height - y);
      Image some(own.width, count, own.channels);
      const std::span<float> pixels = rows_of(some, 0, count);
      if (rank == group.rank())
        std::ranges::copy(rows_of(const_cast<Image&>(own), y, count), pixels.begin());
      else
        group.exchange({}, {{rank, bytes_of(pixels)}});
      writer.write(split_layers({std::move(some)}, files));
    }
  }
  return writer.finish();
}

bool work_for_first(const Config& config, const RunOptions& options) {
  const neural::Group& group = *options.group;
  ProgressBar bar(ProgressStyle::quiet);
  Plan plan = make_plan(config, options.only);
  estimate_together(config, plan, group.size());
  Run run{config, options, plan, bar};
  for (;;) {
    std::int32_t number = 0;
    group.first(std::span(&number, 1));
    if (number < 0) return true;
    if (static_cast<std::size_t>(number) >= plan.jobs.size()) {
      say_unready(group);
      throw Error("{}: process 1 has more jobs: their configs differ", config.file.string());
    }
    OwnRows rows = make_own_rows(run, plan.jobs[static_cast<std::size_t>(number)]);
    if (group.any(false)) send_rows(group, std::move(rows.image));  // the first wants them
    if (rows.stopped) return false;
  }
}

}  // namespace gramloom
