#include "jobs/arrange_pictures.h"

#include "core/error.h"
#include "core/request.h"
#include "io/image_file.h"
#include "jobs/arrangement.h"
#include "jobs/protected_files.h"
#include "jobs/results.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* arranged_mark = "gramloom:arranged";

void check_output_file(const ArrangeWork& work) {
  std::vector<InputFile> read{{work.coordinates, "holds the coordinates"}};
  for (const fs::path& picture : work.pictures) read.push_back({picture, "is to be arranged"});
  try {
    stored_type(work.output.extension().string(), PixelType::uint8);
    check_folder_of(work.output);
    check_replaced(work.output, ProtectedFiles(read), arranged_mark);
  } catch (const Error& error) {
    throw ConfigError("arrange: {}", error.what());
  }
}

// No value is changed: the file must hold them all.
void check_exact(const ArrangeWork& work, PixelType type) {
  const std::string extension = work.output.extension().string();
  if (!keeps_values(extension, type))
    throw ConfigError("arrange: {} {} and would change values: choose another format, as .tif",
                      work.output.string(),
                      is_lossy(extension)
                          ? "loses some on the way"
                          : fmt::format("cannot hold the pixel type {}", to_word(type)));
}

void check_pictures(const ArrangeWork& work, const Arrangement& arrangement,
                    const std::vector<Exemplar>& pictures) {
  if (pictures.size() < arrangement.pictures.size())
    throw ConfigError("arrange: {} {} given, and the texture of {} was made of {}: {}",
                      pictures.size(), pictures.size() == 1 ? "picture is" : "pictures are",
                      work.coordinates.string(), arrangement.pictures.size(),
                      "one for each, in their order; of a picture filled of others, that one last");
  if (pictures.size() > arrangement.pictures.size())
    throw ConfigError("arrange: {} pictures are given, and the texture of {} was made of {}",
                      pictures.size(), work.coordinates.string(), arrangement.pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Size size = pictures[i].image.size();
    const Size wanted = arrangement.pictures[i];
    if (size != wanted)
      throw ConfigError(
          "arrange: {} has {}×{} pixels, and picture {} of {} {}×{}: they must be equal",
          work.pictures[i].string(), size.width, size.height, i + 1, work.coordinates.string(),
          wanted.width, wanted.height);
    if (pictures[i].image.channels != pictures[0].image.channels)
      throw ConfigError("arrange: {} has {} channels and {} {}: they must be equal",
                        work.pictures[0].string(), pictures[0].image.channels,
                        work.pictures[i].string(), pictures[i].image.channels);
  }
}

}  // namespace

std::vector<std::string> arrange_pictures(const ArrangeWork& work) {
  check_output_file(work);
  Arrangement arrangement;
  try {
    arrangement = read_arrangement(work.coordinates);
  } catch (const Error& error) {
    throw ConfigError("arrange: {}", error.what());
  }
  std::vector<Exemplar> pictures;
  Encoding encoding;
  for (const fs::path& file : work.pictures) {
    ImageFile picture;
    try {
      picture = read_image(file);
    } catch (const Error& error) {
      throw ConfigError("arrange: {}", error.what());
    }
    if (pictures.empty()) encoding = picture.encoding;
    const PixelType type = picture.encoding.pixel_type;
    if (type != encoding.pixel_type)
      throw ConfigError("arrange: {} has the pixel type {} and {} {}: they must be equal",
                        work.pictures.front().string(), to_word(encoding.pixel_type), file.string(),
                        to_word(type));
    pictures.push_back({std::move(picture.image)});
  }
  check_exact(work, encoding.pixel_type);
  check_pictures(work, arrangement, pictures);
  return write_image(work.output, arranged(arrangement.source, pictures), encoding,
                     {{arranged_mark, work.coordinates.filename().string()}});
}

}  // namespace gramloom
