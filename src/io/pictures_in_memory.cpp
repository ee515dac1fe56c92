#include "io/pictures_in_memory.h"

#include <utility>

namespace gramloom {

namespace {

thread_local const PicturesInMemory::Pictures* of_thread = nullptr;

}  // namespace

PicturesInMemory::PicturesInMemory(Pictures pictures)
    : pictures_(std::move(pictures)), before_(std::exchange(of_thread, &pictures_)) {}

PicturesInMemory::~PicturesInMemory() { of_thread = before_; }

const ImageFile* picture_in_memory(const std::filesystem::path& name) {
  if (!of_thread) return nullptr;
  const auto found = of_thread->find(name);
  return found == of_thread->end() ? nullptr : &found->second;
}

}  // namespace gramloom
