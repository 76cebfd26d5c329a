#include <fmt/format.h>

#include "common/mapped_file.h"
#include "par/par_file.h"
#include "par/translate.h"
#include "scene_file/file_names.h"
#include "splotchcl/error.h"
#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace fs = std::filesystem;

namespace {

// Mistakes that only the scene shows have its keys, and its lines, which no file has.
[[noreturn]] void refuse_as_scene(const std::string& message, const std::string& par) {
  const std::size_t line = par.size() + 1;
  const bool names_line = message.compare(0, line, par + ":") == 0;
  const std::size_t end = names_line ? message.find_first_not_of("0123456789", line) : line;
  if (!names_line || end == line || end == std::string::npos) throw UsageError(message);
  throw UsageError(fmt::format("{}: as a scene{}", par, message.substr(end)));
}

}  // namespace

Scene read_par_file(const fs::path& path, const std::vector<std::string>& settings,
                    std::vector<std::string>& notes) {
  par::ParFile file(read_text_file(path), path.string());
  par::Translation translation(file, path.parent_path());
  par::translate_snapshot(translation);
  par::translate_camera(translation);
  par::translate_picture(translation);
  par::translate_order(translation);
  par::translate_components(translation);
  for (const auto& more :
       {file.notes(), translation.notes, par::explain_untranslated(file.unused())}) {
    for (const std::string& note : more)
      notes.push_back(fmt::format("{}: {}", path.filename().string(), note));
  }
  try {
    return parse_scene(translation.scene.text(), path.string(), settings);
  } catch (const UsageError& error) {
    refuse_as_scene(error.what(), path.string());
  }
}

Scene with_paths_from(Scene scene, const fs::path& folder) {
  const fs::path from = fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal();
  const auto seen_from = [&from](const std::string& path) {
    if (fs::path(path).is_absolute()) return path;
    return fs::absolute(path).lexically_normal().lexically_proximate(from).string();
  };
  scene_file::change_file_names(scene, seen_from);
  if (!scene.time.pattern.empty()) scene.time.pattern = seen_from(scene.time.pattern);
  return scene;
}

}  // namespace splotchcl
