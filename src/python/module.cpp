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
#include "python/same_build.h"
#include "python/synthesise.h"
#include "python/watched_work.h"
#include "signal/opencv_threads.h"

namespace gramloom::python {

namespace {

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

// `arrays`: by the names that the config has for them.
py::tuple make(const std::string& config, const std::map<std::string, py::object>& arrays,
               int threads, const py::object& progress) {
  use_threads(threads);
  PicturesInMemory::Pictures pictures;
  bool flat = true;  // none has an axis for its one channel: then no result has
  for (const auto& [name, array] : arrays) {
    Picture picture = picture_of(array, name);
    flat = flat && (picture.flat || picture.file.image.channels > 1);
    pictures[name] = std::move(picture.file);
  }
  Made made;
  do_watched(progress,
             [&](Watch& watch) { made = synthesise(config, std::move(pictures), watch); });
  py::dict maps;
  for (const auto& [name, map] : made.maps) maps[py::str(name)] = array_of(map, flat);
  return py::make_tuple(array_of(made.texture, flat), maps);
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

// What a texture is asked by tables of these keys.
std::vector<KeyList> asked_by_tables() {
  std::vector<KeyList> lists = direction_lists();
  for (KeyList& list : table_lists())
    if (list.name == "[[exemplar]]") lists.insert(lists.begin(), std::move(list));
  lists.front().name = "exemplar";
  return lists;
}

std::string text_of(const std::string& heading, const KeyList& list) {
  std::string text = fmt::format("\n{}\n", heading);
  for (const Key& key : list.keys) {
    const std::string standard = default_text(key);
    text += fmt::format("    {}{}: {}; {}\n", key.name, standard.empty() ? "" : " = " + standard,
                        meaning_of(key), key.allowed);
  }
  return text;
}

std::string documentation() {
  std::string text;
  for (const KeyList& list : asked_by_tables())
    text += text_of(fmt::format("{} as a table", list.name), list);
  for (const KeyList& list : method_lists())
    text += text_of(fmt::format("kind '{}': {}", list.name, list.summary), list);
  for (const KeyList& list : texture_lists())
    text +=
        text_of(fmt::format("kind 'procedural', texture '{}': {}", list.name, list.summary), list);
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
  if (const std::string refusal = library_refusal(); !refusal.empty())
    throw py::import_error(refusal);
  add_errors(module);
  add_progress(module);
  module.attr("version") = std::string(version());
  module.def("synthesise", make);
  module.def("score", scores_of);
  const auto add_run = [&](const char* name, RunDone (*work)(const RunWork&, Watch&)) {
    module.def(name, [work](const std::string& config, const std::string& output,
                            const std::string& only, bool resume,
                            const std::vector<std::string>& set, int jobs,
                            const std::optional<std::string>& shard, int threads,
                            const py::object& progress) {
      return done_run(work, {config, output, only, resume, set, jobs, shard, threads}, progress);
    });
  };
  add_run("run", run);
  add_run("train", train);
  module.def("read_image", read);
  module.def("write_image", write);
  module.def("pixel_type", pixel_type_word);
  module.def("methods", [] { return to_text(to_json_value(method_lists())); });
  module.def("patterns", [] { return to_text(to_json_value(texture_lists())); });
  module.def("tables", [] { return to_text(to_json_value(asked_by_tables())); });
  module.def("documentation", documentation);
}

}  // namespace gramloom::python
