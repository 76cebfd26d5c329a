// Where only the renderer is built, there is nothing that reads files.
#include "gpu_model/scene_frame.h"
#include "splotchcl/error.h"

namespace splotchcl::bench {

Frame frame_of_scene(const std::string& path, const std::vector<std::string>&) {
  throw UsageError("--scene: found " + path +
                   ", expected none: this build reads no files (SPLOTCHCL_IO=OFF)");
}

}  // namespace splotchcl::bench
