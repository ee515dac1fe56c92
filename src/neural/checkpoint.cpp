#include "neural/checkpoint.h"

#include <charconv>

#include "core/error.h"
#include "neural/tensor_data.h"

namespace gramloom::neural {

namespace {

const std::string optimiser_prefix = "optimiser.";

// The shortest text that is this very number.
template <class T>
std::string to_text(T number) {
  return fmt::format("{}", number);
}

template <class T>
T to_number(const std::string& text) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw Error("'{}' is not a number", text);
  return number;
}

// Calls f(name without the prefix, value) for what an optimiser has kept.
template <class Map, class F>
void for_each_kept(const Map& map, F&& f) {
  for (const auto& [name, value] : map)
    if (name.starts_with(optimiser_prefix)) f(name.substr(optimiser_prefix.size()), value);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  std::map<std::string, std::string> numbers{{"identity", checkpoint.identity}};
  for_each_value(checkpoint, [&](const FieldText& field, const auto& value) {
    numbers[std::string(field.name)] = to_text(value);
  });
  for (const auto& [name, number] : checkpoint.optimiser.numbers)
    numbers[optimiser_prefix + name] = to_text(number);
  std::map<std::string, TensorData> tensors{{"picture", to_data(checkpoint.picture)}};
  if (checkpoint.prices.defined()) tensors["prices"] = to_data(checkpoint.prices);
  if (checkpoint.sources.defined()) tensors["sources"] = to_data(checkpoint.sources);
  if (checkpoint.nearest.defined()) tensors["nearest"] = to_data(checkpoint.nearest);
  for (const auto& [name, tensor] : checkpoint.optimiser.tensors)
    tensors[optimiser_prefix + name] = to_data(tensor);
  write_tensors(file, tensors, numbers);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file,
                                          const std::string& identity) try {
  if (file.empty() || !std::filesystem::exists(file)) return {};
  const auto numbers = read_metadata(file);
  Checkpoint checkpoint;
  checkpoint.identity = numbers.at("identity");
  if (checkpoint.identity != identity) return {};
  for_each_value(checkpoint, [&]<class T>(const FieldText& field, T& value) {
    value = to_number<T>(numbers.at(std::string(field.name)));
  });
  for_each_kept(numbers, [&](const std::string& name, const std::string& text) {
    checkpoint.optimiser.numbers[name] = to_number<double>(text);
  });
  const auto tensors = read_tensors(file);
  checkpoint.picture = to_tensor(tensors.at("picture"));
  if (tensors.contains("prices")) checkpoint.prices = to_tensor(tensors.at("prices"));
  if (tensors.contains("sources")) checkpoint.sources = to_tensor(tensors.at("sources"));
  if (tensors.contains("nearest")) checkpoint.nearest = to_tensor(tensors.at("nearest"));
  for_each_kept(tensors, [&](const std::string& name, const TensorData& data) {
    checkpoint.optimiser.tensors[name] = to_tensor(data);
  });
  return checkpoint;
} catch (const Error&) {
  return {};
} catch (const std::out_of_range&) {
  return {};
}

}  // namespace gramloom::neural
