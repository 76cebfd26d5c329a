#include "cli/commands.h"
#include "splotchcl/renderer.h"
#include "splotchcl_embedded/commit.h"

namespace splotchcl::cli {

std::string version_and_commit() {
  const std::string commit = SPLOTCHCL_COMMIT;  // empty: not built from a repository
  return SPLOTCHCL_VERSION + (commit.empty() ? "" : " (commit " + commit + ")");
}

std::string version_text() {
  return "splotchcl " + version_and_commit() + "\nOpenCL loader: " + opencl_loader() +
         "\nbuilt with " SPLOTCHCL_BUILT_WITH;
}

}  // namespace splotchcl::cli
