#pragma once

#include "splotchcl/galaxy.h"

namespace splotchcl {

// Throws UsageError that names the setting.
void check_settings(const GalaxySettings& settings);

}  // namespace splotchcl
