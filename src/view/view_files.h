#pragma once

#include <filesystem>
#include <string>

#include "splotchcl/frame_drawer.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

// What a page has saved, on the machine on which the program runs. A relative path begins at the
// program's current folder.
namespace splotchcl::view {

// The text of a scene file that means the same in every folder.
std::string portable_scene_text(const Scene& scene);

// What may not be replaced: all that these name, whether it is shown or not.
struct ViewInputs {
  const Scene& opened;
  const Scene& all;  // as the page has it, with components that are off
  const Snapshot& snapshot;
};

// Written under a temporary name and renamed when complete.
enum class SaveResult {
  saved,
  exists,  // nothing was written: the file is there, and may not be replaced
};

// Throws UsageError for a path that does not end in .toml or that is a file of the inputs,
// DataError for one that cannot be written.
SaveResult save_scene(const std::filesystem::path& path, bool may_replace, const Scene& scene,
                      const ViewInputs& inputs);

// Whether the picture may be written there, before it is drawn. Throws as check_image_path does,
// and UsageError as above.
SaveResult check_picture(const std::filesystem::path& path, bool may_replace, const Scene& scene,
                         const ViewInputs& inputs);

}  // namespace splotchcl::view
