#include <fmt/format.h>

#include "io/common/text_file.h"
#include "io/par/par_keys.h"
#include "io/par/translate.h"
#include "io/scene_file/file_names.h"
#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {
namespace fs = std::filesystem;

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
  return parse_scene(translation.scene.text(), path.string(), settings);
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
