#include "film/frames/film_manifest.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "common/file_identity.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file, ContentMarks& marks) {
  const std::optional<FileIdentity> found = file_identity(file);
  // A base name, whose files have lines of their own.
  if (!found) return file.string();
  std::error_code error;
  return fmt::format("{}, {}, holds {:016x}", fs::absolute(file, error).string(), describe(found),
                     marks.of(file));
}

std::vector<std::string> lines_of(const InputFiles& inputs, ContentMarks& marks) {
  std::vector<std::string> lines;
  for (const fs::path& file : inputs.with_sets())
    lines.push_back(line_of(file, marks));
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

std::string film_manifest(Scene scene, const FilmPath& path, bool by_reference,
                          ContentMarks& marks) {
  std::string text =
      fmt::format("splotchcl {}, {}\n", SPLOTCHCL_VERSION, by_reference ? "reference" : "device");
  for (const std::string& input : lines_of(film_inputs(scene, path), marks))
    text += "input " + input + "\n";
  scene.movie = {};
  scene.path = {};
  text += format_scene(scene);
  for (int frame = 0; frame < path.frame_count(); ++frame)
    text += fmt::format("frame {}: {}\n", frame, fmt::join(path.settings(frame), "; "));
  return text;
}

}  // namespace splotchcl
