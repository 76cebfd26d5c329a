#pragma once

#include <string>
#include <vector>

#include "io/path/film_path.h"
#include "splotchcl/scene.h"

namespace splotchcl::cli {

// The files that the frames of a film are made of, with their size and time, a line each: data,
// palettes, lists, pictures, and those of the scenes that it fades to.
std::vector<std::string> film_inputs(const Scene& scene, const FilmPath& path);

}  // namespace splotchcl::cli
