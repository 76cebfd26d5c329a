#include "film/frames/film_manifest.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <system_error>
#include <vector>

#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

std::string describe(const fs::path& file) {
  std::error_code error;
  struct stat found = {};
  // A base name, whose files have lines of their own.
  if (::stat(file.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return file.string();
  return fmt::format("{}, {} bytes, of {:%Y-%m-%d %H:%M:%S}.{:03} UTC",
                     fs::absolute(file, error).string(), found.st_size,
                     fmt::gmtime(found.st_mtim.tv_sec), found.st_mtim.tv_nsec / 1'000'000);
}

std::vector<std::string> lines_of(const InputFiles& inputs) {
  std::vector<std::string> lines;
  for (const fs::path& file : inputs.with_sets())
    lines.push_back(describe(file));
  return lines;
}

}  // namespace

InputFiles film_inputs(const Scene& scene, const FilmPath& path) {
  InputFiles inputs;
  inputs.add_snapshots(scene);
  for (int frame = 0; frame < path.frame_count(); ++frame) {
    Scene shown = path.scene_at(scene, frame);
    shown.path = {};  // its frames are told one by one
    inputs.add_named_files(shown);
  }
  return inputs;
}

std::set<fs::path> film_files_read(const fs::path& file, const Scene& scene, const FilmPath& path) {
  InputFiles inputs = film_inputs(scene, path);
  inputs.add(file);
  inputs.add_named_files(scene);
  return inputs.all();
}

std::string film_manifest(Scene scene, const FilmPath& path, bool by_reference) {
  std::string text =
      fmt::format("splotchcl {}, {}\n", SPLOTCHCL_VERSION, by_reference ? "reference" : "device");
  for (const std::string& input : lines_of(film_inputs(scene, path)))
    text += "input " + input + "\n";
  scene.movie = {};
  scene.path = {};
  text += format_scene(scene);
  for (int frame = 0; frame < path.frame_count(); ++frame)
    text += fmt::format("frame {}: {}\n", frame, fmt::join(path.settings(frame), "; "));
  return text;
}

}  // namespace splotchcl
