// Files of weights and of trained models.
#include "fuzz.h"
#include "io/safetensors.h"
#include "learnt/generator_model.h"
#include "learnt/inference_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gramloom;
  const std::string text = text_of(data, size);
  const auto file = file_of(text, ".safetensors");
  read_or_refuse([&] { read_tensors(file); });
  read_or_refuse([&] { read_metadata(file); });
  read_or_refuse([&] { read_generator(file); });
  read_or_refuse([&] { read_inference(file); });
  return 0;
}
