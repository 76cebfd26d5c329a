#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "cli/commands.h"
#include "publish/light_splats.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl::cli {

// The scene with a picture no larger than what files of splats are compared by.
Scene as_compared(Scene scene);

// Writes a file of splats for other viewers (publish/splat_files.h), and says how far these show it
// from the frame, which is the scene's as it is compared.
void publish_splats(const std::filesystem::path& path, const Scene& scene, const Frame& frame,
                    const SnapshotInfo& snapshot, const std::vector<LightSplat>& splats,
                    std::size_t particles, FrameDrawer& drawer, Console& console);

}  // namespace splotchcl::cli
