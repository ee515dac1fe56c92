// The extension gramloom._gramloom: what the package around it (gramloom/__init__.py) calls.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>

#include "core/error.h"
#include "io/field_values.h"
#include "io/image_file.h"
#include "jobs/key_lists.h"
#include "jobs/machine.h"
#include "metrics/scores.h"
#include "python/arrays.h"
#include "python/runs.h"
#include "python/synthesise.h"
#include "python/watched_work.h"
#include "signal/opencv_threads.h"

namespace gramloom::python {

namespace {

using Arrays = std::map<std::string, py::object>;

void use_threads(int threads) {
  try {
    gramloom::use_threads(threads);
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
}

// Its word in configs.
std::string pixel_type_word(const py::object& dtype) {
  return std::string(to_word(pixel_type_of(dtype, "dtype")));
}

std::vector<Material> materials_of(const std::vector<py::object>& pictures,
                                   const std::vector<Arrays>& maps) {
  std::vector<Material> materials;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    Material material{picture_of(pictures[i], "exemplar"), {}};
    if (i < maps.size())
      for (const auto& [name, array] : maps[i])
        material.maps[name] = picture_of(array, fmt::format("the map '{}'", name));
    materials.push_back(std::move(material));
  }
  return materials;
}

// Whether all of these arrays lack an axis of channels: then so does what is made of them.
template <class Flat>
bool all_flat(const std::vector<Material>& materials, Flat flat) {
  for (const Material& material : materials)
    if (!flat(material)) return false;
  return true;
}

py::tuple make(const std::string& config, const std::vector<py::object>& pictures,
               const std::vector<Arrays>& maps, int threads, const py::object& progress) {
  use_threads(threads);
  const std::vector<Material> materials = materials_of(pictures, maps);
  Made made;
  do_watched(progress, [&](Watch& watch) { made = synthesise(config, materials, watch); });
  py::dict arrays;
  for (const auto& [name, map] : made.maps)
    arrays[py::str(name)] = array_of(map, all_flat(materials, [&](const Material& material) {
                                       const auto own = material.maps.find(name);
                                       return own == material.maps.end() || own->second.flat;
                                     }));
  const bool flat = all_flat(materials, [](const Material& m) { return m.picture.flat; });
  return py::make_tuple(array_of(made.texture, flat), arrays);
}

Tile tile_of(const std::string& word) {
  const auto& words = enum_names<Tile>;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == word) return static_cast<Tile>(i);
  throw ConfigError("unknown tile '{}' (allowed are {})", word, fmt::join(words, ", "));
}

py::dict scores_of(const py::object& exemplar, const py::object& texture, const std::string& tile,
                   int threads, const py::object& progress) {
  use_threads(threads);
  const Tile axes = tile_of(tile);
  const Image own = picture_of(exemplar, "exemplar").file.image;
  const Image image = picture_of(texture, "texture").file.image;
  if (own.channels != image.channels)
    throw ConfigError("texture: has {} channels, the exemplar has {}", image.channels,
                      own.channels);
  Scores scores;
  do_watched(progress, [&](Watch& w) { scores = score(own, image, axes, w.control()); });
  py::dict values;
  for (const auto& [name, value] : scores.values) values[py::str(std::string(name))] = value;
  return values;
}

py::tuple done_run(RunDone (*work)(const RunWork&, Watch&), const RunWork& asked,
                   const py::object& progress) {
  use_threads(asked.threads);
  RunDone done;
  do_watched(progress, [&](Watch& watch) { done = work(asked, watch); });
  return py::make_tuple(done.records, done.complaints);
}

py::array read(const std::string& file) {
  const ImageFile picture = read_image(file);
  return array_of(stored(picture.image, picture.encoding.pixel_type), true);
}

std::vector<std::string> write(const std::string& file, const py::object& array) {
  const Picture picture = picture_of(array, "image");
  return write_image(file, picture.file.image, picture.file.encoding);
}

std::string text_of(const std::vector<KeyList>& lists, const std::string& title) {
  std::string text;
  for (const KeyList& list : lists) {
    text += fmt::format("\n{} '{}': {}\n", title, list.name, list.summary);
    for (const Key& key : list.keys) {
      const std::string standard = default_text(key);
      text += fmt::format("    {}{}: {}; {}\n", key.name, standard.empty() ? "" : " = " + standard,
                          meaning_of(key), key.allowed);
    }
  }
  return text;
}

// ConfigError is an Error and a ValueError.
void add_errors(py::module_& module) {
  const auto& error = py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  const py::tuple bases =
      py::make_tuple(error, py::reinterpret_borrow<py::object>(PyExc_ValueError));
  py::register_exception<ConfigError>(module, "ConfigError", bases);
}

void add_progress(py::module_& module) {
  py::class_<JobProgress>(module, "Progress", "How far the work is.")
      .def_readonly("job", &JobProgress::job, "of a run: its name and number; else \"\"")
      .def_property_readonly(
          "step", [](const JobProgress& p) { return p.progress.step; }, "steps done")
      .def_property_readonly(
          "steps", [](const JobProgress& p) { return p.progress.steps; }, "steps in all")
      .def_property_readonly(
          "loss",
          [](const JobProgress& p) {
            return std::isfinite(p.progress.loss) ? std::optional(p.progress.loss) : std::nullopt;
          },
          "of iterative methods; else None")
      .def("__repr__", [](const JobProgress& p) {
        return fmt::format("<gramloom.Progress {}{}/{}>", p.job.empty() ? "" : p.job + " ",
                           p.progress.step, p.progress.steps);
      });
}

}  // namespace

PYBIND11_MODULE(_gramloom, module) {
  add_errors(module);
  add_progress(module);
  module.attr("version") = std::string(version());
  module.def("synthesise", make);
  module.def("score", scores_of);
  const auto add_run = [&](const char* name, RunDone (*work)(const RunWork&, Watch&)) {
    module.def(name,
               [work](const std::string& config, const std::string& output, const std::string& only,
                      bool resume, const std::vector<std::string>& set, int threads,
                      const py::object& progress) {
                 return done_run(work, {config, output, only, resume, set, threads}, progress);
               });
  };
  add_run("run", run);
  add_run("train", train);
  module.def("read_image", read);
  module.def("write_image", write);
  module.def("pixel_type", pixel_type_word);
  module.def("methods", [] { return to_text(to_json_value(method_lists())); });
  module.def("patterns", [] { return to_text(to_json_value(texture_lists())); });
  module.def("documentation", [] {
    return text_of(method_lists(), "kind") + text_of(texture_lists(), "kind 'procedural', texture");
  });
}

}  // namespace gramloom::python
