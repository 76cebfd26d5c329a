#include "view/view_files.h"

#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "common/words.h"
#include "open_scene/input_files.h"
#include "scene_file/file_names.h"
#include "snapshot/snapshot_list.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::view {
namespace {

namespace fs = std::filesystem;

// The scene file that was opened is none of these: it is what most users want to replace.
std::set<fs::path> inputs_of(const Scene& scene, const Snapshot& snapshot) {
  InputFiles inputs;
  inputs.add(snapshot);
  if (scene.time.is_set()) inputs.add_snapshots(scene);
  inputs.add_named_files(scene);
  return inputs.all();
}

SaveResult check(const fs::path& path, bool may_replace, const Scene& scene,
                 const Snapshot& snapshot) {
  check_outputs({{path, "the file to save"}}, [&] { return inputs_of(scene, snapshot); });
  return fs::exists(path) && !may_replace ? SaveResult::exists : SaveResult::saved;
}

}  // namespace

std::string portable_scene_text(const Scene& scene) {
  Scene portable = scene;
  scene_file::change_file_names(portable, [](const std::string& name) {
    return fs::absolute(name).lexically_normal().string();
  });
  std::string& pattern = portable.time.pattern;
  if (!pattern.empty() && !fs::path(pattern).is_absolute()) {
    pattern = as_pattern((fs::current_path() / "").string()) + pattern;
  }
  return format_scene(portable);
}

SaveResult save_scene(const fs::path& path, bool may_replace, const Scene& scene,
                      const Snapshot& snapshot) {
  if (lower_ending(path) != ".toml") {
    throw UsageError(path.string() + ": found another ending, expected .toml for a scene");
  }
  if (check(path, may_replace, scene, snapshot) == SaveResult::exists) return SaveResult::exists;
  const std::string text = portable_scene_text(scene);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
  return SaveResult::saved;
}

SaveResult check_picture(const fs::path& path, bool may_replace, const Scene& scene,
                         const Snapshot& snapshot) {
  check_image_path(path);
  check_image_size(path, scene.image.width, scene.image.height);
  return check(path, may_replace, scene, snapshot);
}

}  // namespace splotchcl::view
