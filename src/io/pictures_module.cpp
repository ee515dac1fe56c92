#include "io/pictures_module.h"

namespace gramloom {

extern "C" const PicturesModule gramloom_pictures_module;
const PicturesModule gramloom_pictures_module{
    pictures::read,       pictures::read_size, pictures::write,   pictures::stored_type,
    pictures::difference, pictures::open_rows, pictures::encoded, pictures::stored_pixels};

}  // namespace gramloom
