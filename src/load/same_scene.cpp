#include "load/same_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ranks/agreement.h"
#include "ranks/values.h"
#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"

namespace splotchcl {

void require_same_scene(const Scene& scene, const SpreadParticles& spread) {
  Communicator& ranks = spread.ranks();
  std::string own;
  const std::string failure = told([&] { own = format_scene(scene); });
  const std::vector<std::string> all = gather_texts(ranks, failure + own);
  const auto other = std::find_if(all.begin(), all.end(),
                                  [&](const std::string& text) { return text != all.front(); });
  if (failure.empty() && other == all.end()) return;
  agree(&ranks, [&] {
    if (ranks.rank() > 0) return;
    throw UsageError(
        fmt::format("found another scene on rank {} than on rank 0, expected the same on all ranks "
                    "that draw together",
                    other - all.begin()));
  });
}

}  // namespace splotchcl
