#include "formats/unit_names.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace splotchcl {
namespace {

struct NamedUnit {
  double in_cgs;
  const char* name;
};

const std::vector<NamedUnit>& lengths() {
  static const std::vector<NamedUnit> units = {{3.0857e24, "Mpc"},  {3.0857e21, "kpc"},
                                               {3.0857e18, "pc"},   {1.4960e13, "au"},
                                               {6.957e10, "R_sun"}, {1, "cm"}};
  return units;
}

const std::vector<NamedUnit>& masses() {
  static const std::vector<NamedUnit> units = {
      {1.989e43, "1e10 M_sun"}, {1.989e33, "M_sun"}, {1, "g"}};
  return units;
}

const std::vector<NamedUnit>& velocities() {
  static const std::vector<NamedUnit> units = {{1e5, "km/s"}, {1, "cm/s"}};
  return units;
}

std::string base_name(double in_cgs, const std::vector<NamedUnit>& known) {
  for (const NamedUnit& unit : known) {
    // Codes round their constants to four digits.
    if (std::abs(in_cgs / unit.in_cgs - 1) < 1e-3) return unit.name;
  }
  return fmt::format("{:.7g} {}", in_cgs, known.back().name);
}

void append_power(std::string& text, std::string base, double power) {
  if (power == 0) return;
  if (!text.empty()) text += ' ';
  const bool is_compound = base.find_first_of(" /") != std::string::npos;
  if (is_compound && power != 1) base = "(" + base + ")";
  text += power == 1 ? base : fmt::format("{}^{:g}", base, power);
}

}  // namespace

std::string unit_name(const UnitPowers& powers, const BaseUnits& units) {
  const bool is_unknown = (powers.length != 0 && !(units.length_in_cm > 0)) ||
                          (powers.mass != 0 && !(units.mass_in_g > 0)) ||
                          (powers.velocity != 0 && !(units.velocity_in_cm_per_s > 0));
  const bool is_pure_number =
      powers.length == 0 && powers.mass == 0 && powers.velocity == 0 && powers.temperature == 0;
  if (is_unknown || is_pure_number) return {};
  std::string text;
  append_power(text, base_name(units.mass_in_g, masses()), powers.mass);
  append_power(text, base_name(units.length_in_cm, lengths()), powers.length);
  append_power(text, base_name(units.velocity_in_cm_per_s, velocities()), powers.velocity);
  append_power(text, "K", powers.temperature);
  append_power(text, "h", powers.hubble);
  append_power(text, "a", powers.scale_factor);
  return text;
}

}  // namespace splotchcl
