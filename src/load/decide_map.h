#pragma once

#include <functional>
#include <string>

#include "load/component_fields.h"
#include "splotchcl/frame.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// A field's way to [0, 1] with the limits that the scene leaves to the data; any where it names no
// field. `read` gives the field's values, and is called only where a limit is left to them. `key`
// names it in messages: "color". Throws UsageError for a limit that its scaling has no value for.
ScalarMap decide_map(const FieldMap& map, const std::function<Column()>& read,
                     const ComponentFields& fields, const std::string& key);

}  // namespace splotchcl
