#pragma once

#include <memory>
#include <string>
#include <vector>

#include "splotchcl/open_scene.h"

namespace splotchcl {

// What open_scene() makes of a snapshot that is open already, with the same settings.
SceneWithSnapshot show_snapshot(const std::shared_ptr<const Snapshot>& snapshot,
                                const std::vector<std::string>& settings, Look look = Look::press);

// A scene that there is, changed by settings as open_scene() takes them. `opened.suggested` is as
// what it began, if it was chosen from data.
SceneWithSnapshot show_scene(SceneWithSnapshot opened, const std::vector<std::string>& settings);

}  // namespace splotchcl
