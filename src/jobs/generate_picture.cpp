#include "jobs/generate_picture.h"

#include "core/error.h"
#include "io/image_rows.h"
#include "io/json_fields.h"
#include "jobs/machine.h"
#include "jobs/protected_files.h"
#include "jobs/settings.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// What of each pixel goes to a file.
struct Part {
  fs::path file;
  std::unique_ptr<ImageRows> rows;
  int first = 0, channels = 0;
};

void check_files(const GenerateWork& work, const GeneratorDescription& description) {
  std::vector<InputFile> read{{model_file(work.params), "is the model"}};
  if (!work.params.weight_picture.empty())
    read.push_back({work.params.weight_picture, "has the weights"});
  const ProtectedFiles inputs(read);
  inputs.check(work.output);
  // The maps' names are ours, not the user's: only files of an earlier picture are replaced.
  for (const GeneratorPart& part : parts_of(description.layers))
    if (!part.name.empty())
      check_replaced(file_of_map(work.output, part.name), inputs, "gramloom:settings");
}

Metadata metadata_of(const GenerateWork& work) {
  Json made_by{{"gramloom", version()},
               {"size", {work.size.width, work.size.height}},
               {"tile", to_word(work.tile)},
               {"seed", work.seed},
               {"method", method_to_json(work.params, "")}};
  return {{"gramloom:settings", to_text(made_by, -1, true)}};
}

std::vector<Part> open_parts(const GenerateWork& work, const GeneratorDescription& description) {
  std::vector<Part> parts;
  for (const GeneratorPart& own : parts_of(description.layers)) {
    Part part{file_of_map(work.output, own.name), nullptr, own.first, own.count};
    Encoding encoding;
    encoding.pixel_type = own.kind == MapKind::colour ? PixelType::uint8 : PixelType::uint16;
    if (work.pixel_type) encoding.pixel_type = *work.pixel_type;
    part.rows = open_image_rows(part.file, work.size, part.channels, encoding, metadata_of(work));
    parts.push_back(std::move(part));
  }
  return parts;
}

void write_rows(std::vector<Part>& parts, const float* pixels, std::size_t count, int channels,
                int rows) {
  if (parts.size() == 1) return parts.front().rows->write(pixels, rows);
  std::vector<float> own;
  for (Part& part : parts) {
    own.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const float* first = pixels + i * static_cast<std::size_t>(channels) + part.first;
      own.insert(own.end(), first, first + part.channels);
    }
    part.rows->write(own.data(), rows);
  }
}

}  // namespace

GeneratedFiles generate_picture(const GenerateWork& work, const Control& control) {
  check_fields(work.params);
  check_size(work.size);
  GeneratorModel model;
  std::vector<Part> parts;
  Generation wanted;
  try {
    model = read_generator(model_file(work.params));
    wanted = generation_of(work.params, model.description, work.size, work.tile,
                           Random(static_cast<std::uint64_t>(work.seed)));
    check_files(work, model.description);
    parts = open_parts(work, model.description);
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    throw ConfigError("generate: {}", error.what());
  }
  const int channels = model.description.channels;
  generate(
      model, wanted,
      [&](const float* pixels, int rows) {
        write_rows(parts, pixels,
                   static_cast<std::size_t>(rows) * static_cast<std::size_t>(work.size.width),
                   channels, rows);
      },
      control);
  GeneratedFiles generated;
  for (Part& part : parts) {
    for (const std::string& note : part.rows->finish())
      generated.notes.push_back(fmt::format("{}: {}", part.file.filename().string(), note));
    generated.files.push_back(part.file);
  }
  return generated;
}

}  // namespace gramloom
