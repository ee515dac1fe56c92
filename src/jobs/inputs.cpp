#include "jobs/inputs.h"

#include "core/hash.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// Whether nothing was written between the two.
bool same_state(const struct stat& a, const struct stat& b) {
  const auto same_time = [](const timespec& x, const timespec& y) {
    return x.tv_sec == y.tv_sec && x.tv_nsec == y.tv_nsec;
  };
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino && a.st_size == b.st_size &&
         same_time(a.st_mtim, b.st_mtim) && same_time(a.st_ctim, b.st_ctim);
}

}  // namespace

std::string file_hash(const fs::path& path) {
  Fnv1a hash;
  read_blocks(path, [&](std::string_view block) { hash.add(block); });
  return hash.text();
}

std::string FileHashes::of(const fs::path& path) {
  struct stat state {};
  if (stat(path.c_str(), &state) != 0 || !S_ISREG(state.st_mode)) return "";
  const auto known = known_.find(path);
  if (known != known_.end() && same_state(known->second.state, state)) return known->second.hash;
  try {
    return known_.insert_or_assign(path, Known{state, file_hash(path)}).first->second.hash;
  } catch (const Error&) {
    return "";
  }
}

Named<fs::path> files_of(const ExemplarPicture& picture) {
  Named<fs::path> files{{"image", picture.image}};
  for (const auto& [name, map] : picture.maps) files.emplace_back("maps." + name, map.image);
  if (!picture.mask.empty() && !picture.mask.is_name()) files.emplace_back("mask", picture.mask);
  if (!picture.guide.empty()) files.emplace_back("guide", picture.guide);
  return files;
}

Named<fs::path> files_of(const Direction& direction) {
  Named<fs::path> files;
  for_each_direction(direction, [&]<class Entry>(const std::optional<Entry>& entry) {
    if (!entry) return;
    const auto add = [&](std::string_view key, const fs::path& file) {
      if (!file.empty()) files.emplace_back(fmt::format("{}.{}", Entry::section, key), file);
    };
    for_each_value(*entry, [&]<class T>(const FieldText& field, const T& value) {
      if constexpr (std::is_same_v<T, fs::path>) add(field.name, value);
      if constexpr (std::is_same_v<T, FileOrName>)
        if (!value.is_name()) add(field.name, value);
      if constexpr (std::is_same_v<T, std::vector<fs::path>>)
        for (const fs::path& file : value) add(field.name, file);
      if constexpr (is_named_files<T>)
        for (const auto& [name, file] : value)
          add(fmt::format("{}.{}", field.name, name), file.image);
    });
  });
  return files;
}

std::vector<std::string> exemplar_hashes(const ExemplarEntry& exemplar, FileHashes& hashes) {
  std::vector<std::string> list;
  for (const ExemplarPicture& picture : pictures_of(exemplar))
    for (const auto& [key, file] : files_of(picture)) list.push_back(hashes.of(file));
  return list;
}

Named<std::string> direction_hashes(const Direction& direction, FileHashes& hashes) {
  Named<std::string> list;
  for (const auto& [key, file] : files_of(direction)) list.emplace_back(key, hashes.of(file));
  return list;
}

Named<std::string> method_hashes(const Method& method, FileHashes& hashes) {
  Named<std::string> list;
  const auto add = [&](std::string_view name, const fs::path& file) {
    if (const std::string hash = hashes.of(file); !hash.empty()) list.emplace_back(name, hash);
  };
  std::visit(
      [&]<class Params>(const Params& params) {
        for_each_parameter(params, [&]<class T>(const FieldText& field, const T& value) {
          if constexpr (std::is_same_v<T, fs::path>) add(field.name, value);
        });
        if constexpr (HasNetwork<Params> || HasModel<Params>) try {
            if constexpr (HasNetwork<Params>) add("network", network_file(params));
            if constexpr (HasModel<Params>) add("model", model_file(params));
          } catch (const Error&) {
            // There is none of that name any more; whoever reads it says so.
          }
      },
      method);
  return list;
}

}  // namespace gramloom
