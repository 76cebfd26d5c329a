#pragma once

#include <string>

#include "film/path/film_path.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// All that the frames of a film depend on, but for the device, which gives the same within the
// tolerance: the scene as it was decided, what each frame sets, and the files of data, palettes,
// lists and pictures, also those of scenes that it fades to, with their size and time.
std::string film_manifest(Scene scene, const FilmPath& path, bool by_reference);

}  // namespace splotchcl
