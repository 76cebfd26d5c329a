#include <fmt/format.h>

#include "io/common/text_file.h"
#include "io/palette/palette_file.h"
#include "io/par/par_keys.h"
#include "io/par/translate.h"
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
  const auto move = [&from](std::string& path) {
    if (path.empty() || fs::path(path).is_absolute()) return;
    path = fs::absolute(path).lexically_normal().lexically_proximate(from).string();
  };
  move(scene.snapshot);
  for (std::string& snapshot : scene.time.snapshots)
    move(snapshot);
  move(scene.time.pattern);
  move(scene.path.file);
  for (Component& component : scene.components) {
    for (std::string* const palette : {&component.palette, &component.absorption_palette}) {
      if (is_palette_path(*palette)) move(*palette);
    }
    move(component.snapshot);
  }
  return scene;
}

}  // namespace splotchcl
