#pragma once

#include <string>
#include <vector>

namespace splotchcl {

// A field's unit.
struct FieldUnit {
  std::string field, unit;
};

// The units of common fields in the system of this name: gadget, cgs or si. None where there is no
// such system.
std::vector<FieldUnit> units_of_system(const std::string& name);

std::vector<std::string> names_of_unit_systems();

}  // namespace splotchcl
