#pragma once

#include <string>

#include "load/load_frame_fields.h"
#include "splotchcl/frame.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// A field's way to [0, 1] with the limits that the scene leaves to the data. `key` names it in
// messages: "color". Throws UsageError for a limit that its scaling has no value for.
ScalarMap decide_map(const FieldMap& map, const Column& column, const ComponentFields& fields,
                     const std::string& key);

}  // namespace splotchcl
