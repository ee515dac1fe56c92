#include "commands/export_model.h"

#include <cctype>

#include "core/error.h"
#include "io/models_folder.h"
#include "io/text_file.h"
#include "jobs/machine.h"
#include "jobs/protected_files.h"
#include "learnt/export_c.h"
#include "learnt/export_glsl.h"
#include "learnt/export_onnx.h"
#include "learnt/generator.h"
#include "learnt/model_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// Of functions in C: letters and digits of the file's name.
std::string identifier(const fs::path& file) {
  std::string name;
  for (const char c : file.stem().string())
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ? "texture_" + name
                                                                           : name;
}

PlainGenerator read_model(const ModelExport& work) {
  const fs::path file = find_model(work.model, ".safetensors", "model");
  try {
    if (const std::string kind = model_kind(file); kind != "generator")
      throw ConfigError("export {}: is a model of kind '{}'; --target {} exports a generator",
                        file.string(), kind, to_word(work.target));
    const GeneratorModel model = read_generator(file);
    GeneratorParams params;
    params.weights = work.weights;
    check_fields(params);
    const Generation wanted =
        generation_of(params, model.description, {1, 1}, Tile::none, Random(1));
    return plain_generator(model, wanted.shares);
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    throw ConfigError("export {}", error.what());
  }
}

}  // namespace

void export_model(const ModelExport& work) {
  const PlainGenerator generator = read_model(work);
  std::error_code ignored;
  if (fs::equivalent(find_model(work.model, ".safetensors", "model"), work.output, ignored))
    throw ConfigError("export {}: --output is the model itself", work.output.string());
  try {
    check_folder_of(work.output);
  } catch (const Error& error) {
    throw ConfigError("export {}: {}", work.output.string(), error.what());
  }
  const std::string program = fmt::format("gramloom {}", version());
  switch (work.target) {
    case ModelTarget::c:
      write_text(work.output, export_c(generator, identifier(work.output), program));
      break;
    case ModelTarget::glsl:
      write_text(work.output, export_glsl(generator, program));
      break;
    case ModelTarget::onnx:
      write_text(work.output, export_onnx(generator, program));
      break;
  }
}

}  // namespace gramloom
