#include "source_folder.h"

std::filesystem::path source_folder() { return GRAMLOOM_SOURCE_DIR; }
