#include "snapshot/unit_systems.h"

#include <array>
#include <cstddef>

namespace splotchcl {
namespace {

constexpr std::array<const char*, 10> fields = {
    "position", "smoothing_length", "softening",       "mass",       "velocity", "density",
    "volume",   "pressure",         "internal_energy", "temperature"};

struct UnitSystem {
  const char* name;
  // In the order of the fields; null: none that all who use the system agree on.
  std::array<const char*, fields.size()> units;
};

constexpr std::array<UnitSystem, 3> systems = {{
    {"gadget",
     {"a kpc/h", "a kpc/h", "a kpc/h", "1e10 Msun/h", "a^0.5 km/s", "1e10 Msun/h (a kpc/h)^-3",
      "(a kpc/h)^3", nullptr, "(km/s)^2", "K"}},
    {"cgs", {"cm", "cm", "cm", "g", "cm/s", "g/cm^3", "cm^3", "erg/cm^3", "erg/g", "K"}},
    {"si", {"m", "m", "m", "kg", "m/s", "kg/m^3", "m^3", "J/m^3", "J/kg", "K"}},
}};

}  // namespace

std::vector<FieldUnit> units_of_system(const std::string& name) {
  std::vector<FieldUnit> units;
  for (const UnitSystem& system : systems) {
    if (system.name != name) continue;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (system.units[i] != nullptr) units.push_back({fields[i], system.units[i]});
    }
  }
  return units;
}

std::vector<std::string> names_of_unit_systems() {
  std::vector<std::string> names;
  for (const UnitSystem& system : systems)
    names.emplace_back(system.name);
  return names;
}

}  // namespace splotchcl
