#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "film/path/film_path.h"
#include "open_scene/input_files.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// The files that the frames are drawn from, but for those of the path.
InputFiles film_inputs(const Scene& scene, const FilmPath& path);

// All that drawing the film of a scene from a file reads: InputFiles::all() of both.
std::set<std::filesystem::path> film_files_read(const std::filesystem::path& file,
                                                const Scene& scene, const FilmPath& path);

// All that the frames of a film depend on, but for the device, which gives the same within the
// tolerance: the scene as it was decided, what each frame sets, and the files of data, palettes,
// lists, pictures and fonts, also those of scenes that it fades to, with their size, their time and
// what they hold.
std::string film_manifest(Scene scene, const FilmPath& path, bool by_reference,
                          ContentMarks& marks);

}  // namespace splotchcl
