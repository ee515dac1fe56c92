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

std::string file_hash(const fs::path& path) { return hash_of(read_text(path)); }

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

std::vector<std::string> exemplar_hashes(const ExemplarEntry& exemplar, FileHashes& hashes) {
  std::vector<std::string> list{hashes.of(exemplar.image)};
  for (const auto& [name, file] : exemplar.maps) list.push_back(hashes.of(file.image));
  return list;
}

Named<std::string> method_hashes(const Method& method, FileHashes& hashes) {
  Named<std::string> list;
  const auto add = [&](std::string_view name, const fs::path& file) {
    if (const std::string hash = hashes.of(file); !hash.empty()) list.emplace_back(name, hash);
  };
  std::visit(
      [&]<class Params>(const Params& params) {
        for_each_parameter(params, [&]<class T>(const auto& field, const T& value) {
          if constexpr (std::is_same_v<T, fs::path>) add(field.name, value);
        });
        if constexpr (HasNetwork<Params>) try {
            add("network", network_file(params));
          } catch (const Error&) {
            // There is none of that name any more; whoever reads it says so.
          }
      },
      method);
  return list;
}

}  // namespace gramloom
