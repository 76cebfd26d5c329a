#pragma once

#include <string>
#include <vector>

#include "splotchcl/frame.h"

namespace splotchcl::bench {

// The frame of a scene file, with settings "key=value" that go before it. Throws as the readers of
// scenes and snapshots do, and UsageError where the program was built without them.
Frame frame_of_scene(const std::string& path, const std::vector<std::string>& settings);

}  // namespace splotchcl::bench
