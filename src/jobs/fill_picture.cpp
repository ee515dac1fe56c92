#include "jobs/fill_picture.h"

#include <algorithm>

#include "core/variants.h"
#include "io/image_encode.h"
#include "jobs/loaded_request.h"
#include "jobs/machine.h"
#include "jobs/memory.h"
#include "jobs/results.h"
#include "jobs/written_config.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* fill_mark = "gramloom:filled";

void check_output_file(const FillWork& work, const Config& config) {
  try {
    stored_type(work.output.extension().string(), PixelType::uint8);
    if (is_lossy(work.output.extension().string()))
      throw Error("{} would not keep what is left as it is: choose another format, as .tif",
                  work.output.string());
    check_result(work.output, config, fill_mark);
  } catch (const Error& error) {
    throw ConfigError("fill: {}", error.what());
  }
}

// What is left must keep its values, and all channels must have a place.
void check_exact(const FillWork& work, const ExemplarFile& file) {
  const std::string extension = work.output.extension().string();
  const PixelType type = file.encoding.pixel_type;
  if (!keeps_values(extension, type))
    throw ConfigError(
        "fill: {} cannot hold the pixel type {} of {} and would change values: choose another "
        "format, as .tif",
        work.output.string(), to_word(type), work.picture.string());
  try {
    encoded_image(extension, Image(1, 1, file.channels), {});
  } catch (const Error& error) {
    throw ConfigError("fill: --output {}: {}", work.output.string(), error.what());
  }
}

// What the method refuses, or has no memory for.
void check_possible(const FillWork& work, const Method& method, const RequestSize& request) {
  std::string refusal;
  try {
    const Cost cost = estimate_method(method, request);
    if (const double free = available_memory(); cost.bytes > free)
      refusal = fmt::format("needs about {:.1f} GB of memory, {:.1f} GB are free", cost.bytes / 1e9,
                            free / 1e9);
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    refusal = error.what();
  }
  if (!refusal.empty()) throw ConfigError("fill {}: {}", work.picture.string(), refusal);
}

// Throws ConfigError for a known method that cannot fill: of others the config's reader speaks.
void check_fills(const std::string& kind) {
  const std::vector<std::string_view> can = methods_with(Ability::fill);
  if (std::ranges::find(can, kind) != can.end()) return;
  bool known = false;
  for_each_alternative<Method>(
      [&]<class Params>(std::type_identity<Params>) { known |= Params::kind == kind; });
  if (known)
    throw ConfigError("fill: --method {} cannot fill; methods that can: {}", kind,
                      fmt::join(can, ", "));
}

}  // namespace

std::string config_of(const FillWork& work) {
  check_fills(work.method);
  std::string text =
      fmt::format("seeds = [{}]\n\n[fill]\nimage = {}\n", work.seed, quoted_path(work.picture));
  if (work.mask == "alpha")
    text += "mask = \"alpha\"\n";
  else if (!work.mask.empty())
    text += fmt::format("mask = {}\n", quoted_path(work.mask));
  if (work.seamless != Tile::none)
    text += fmt::format("seamless = \"{}\"\n", to_word(work.seamless));
  if (work.band > 0) text += fmt::format("band = {}\n", work.band);
  if (!work.extend.empty()) text += fmt::format("extend = [{}]\n", fmt::join(work.extend, ", "));
  if (work.blend != FillEntry().blend) text += fmt::format("blend = {}\n", work.blend);
  if (!work.from.empty())
    text += "\n[[exemplar]]\nname = \"from\"\nimages = " + quoted_paths(work.from) + "\n";
  return text + fmt::format("\n[[method]]\nname = {0}\nkind = {0}\n", quoted(work.method));
}

std::vector<std::string> fill_picture(const FillWork& work, const Control& control) {
  Config config = parse_unseen_config(config_of(work), "fill");
  check_output_file(work, config);
  for (ExemplarEntry& exemplar : config.exemplars) exemplar.place = "fill";  // there is no line
  LoadedRequest loaded = load_request(config, 0);
  check_exact(work, loaded.files.front());
  const std::vector<ExemplarFile> files = std::move(loaded.files);
  const Method& method = config.methods.front().method;
  const Request request{std::move(loaded.exemplars), std::move(loaded.target),
                        Random(static_cast<std::uint64_t>(work.seed))};
  check_possible(work, method, size_of(request));
  const Texture texture = [&] {
    try {
      return finished_texture(method, request, control);
    } catch (const Interrupted&) {
      throw;
    } catch (const ConfigError&) {
      throw;
    } catch (const Error& error) {
      throw Error("fill {}: {}", work.picture.string(), error.what());
    }
  }();
  Metadata metadata = std::move(loaded.metadata);
  metadata[fill_mark] = version();
  std::vector<std::string> notes = std::move(loaded.notes);
  for (const std::string& note :
       write_image(work.output, texture.image, files.front().encoding, metadata))
    notes.push_back(fmt::format("{}: {}", work.output.filename().string(), note));
  return notes;
}

}  // namespace gramloom
