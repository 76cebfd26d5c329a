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
std::set<fs::path> files_of(const ViewInputs& inputs) {
  InputFiles files;
  files.add(inputs.snapshot);
  for (const Scene* const scene : {&inputs.opened, &inputs.all}) {
    if (scene->time.is_set()) files.add_snapshots(*scene);
    files.add_named_files(*scene);
  }
  return files.all();
}

SaveResult check(const fs::path& path, bool may_replace, const ViewInputs& inputs) {
  check_outputs({{path, "the file to save"}}, [&] { return files_of(inputs); });
  std::error_code ignored;  // who writes it says what is wrong
  return fs::exists(path, ignored) && !may_replace ? SaveResult::exists : SaveResult::saved;
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
                      const ViewInputs& inputs) {
  if (lower_ending(path) != ".toml") {
    throw UsageError(path.string() + ": found another ending, expected .toml for a scene");
  }
  if (check(path, may_replace, inputs) == SaveResult::exists) return SaveResult::exists;
  const std::string text = portable_scene_text(scene);
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
  return SaveResult::saved;
}

SaveResult check_picture(const fs::path& path, bool may_replace, const Scene& scene,
                         const ViewInputs& inputs) {
  check_image_path(path);
  check_image_size(path, scene.image.width, scene.image.height);
  return check(path, may_replace, inputs);
}

}  // namespace splotchcl::view
