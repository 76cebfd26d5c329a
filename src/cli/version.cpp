#include "cli/version.h"

#include "splotchcl/renderer.h"
#include "splotchcl_embedded/commit.h"

namespace splotchcl::cli {

std::string version_text() {
  std::string text = "splotchcl " SPLOTCHCL_VERSION;
  const std::string commit = SPLOTCHCL_COMMIT;  // empty: not built from a repository
  if (!commit.empty()) text += " (commit " + commit + ")";
  return text + "\nOpenCL loader: " + opencl_loader() + "\nbuilt with " SPLOTCHCL_BUILT_WITH;
}

}  // namespace splotchcl::cli
