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

bool are_close(double a, double b) {
  // Codes round their constants to four digits.
  return std::abs(a / b - 1) < 1e-3;
}

std::string base_name(double in_cgs, const std::vector<NamedUnit>& known) {
  for (const NamedUnit& unit : known) {
    if (are_close(in_cgs, unit.in_cgs)) return unit.name;
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

// Of the product of these powers of the base units; 0 where one of these is unknown.
double size_in_cgs(const UnitPowers& powers, const BaseUnits& units) {
  const auto factor = [](double base, double power) {
    return power == 0 ? 1 : std::pow(base, power);
  };
  const double size = factor(units.length_in_cm, powers.length) *
                      factor(units.mass_in_g, powers.mass) *
                      factor(units.velocity_in_cm_per_s, powers.velocity);
  return std::isfinite(size) ? size : 0;
}

bool has_only(const UnitPowers& powers, double UnitPowers::*kept) {
  UnitPowers others = powers;
  others.*kept = 0;
  return others.length == 0 && others.mass == 0 && others.velocity == 0 && others.temperature == 0;
}

// A unit of this size, by the names of base units where it is a power of one.
std::string name_of_size(const UnitPowers& powers, double in_cgs) {
  std::string text;
  const auto append_named = [&](double power, const std::vector<NamedUnit>& known) {
    append_power(text, base_name(std::pow(in_cgs, 1 / power), known), power);
    return text;
  };
  if (has_only(powers, &UnitPowers::length)) return append_named(powers.length, lengths());
  if (has_only(powers, &UnitPowers::mass)) return append_named(powers.mass, masses());
  if (has_only(powers, &UnitPowers::velocity)) return append_named(powers.velocity, velocities());
  // A velocity is a length over a time.
  const double length = powers.length + powers.velocity, time = -powers.velocity;
  const bool is_rate_of_mass =
      powers.mass == 1 && length == 0 && time == -1 && powers.temperature == 0;
  constexpr double solar_masses_per_year = 1.989e33 / 3.15576e7;
  if (is_rate_of_mass && are_close(in_cgs, solar_masses_per_year)) return "M_sun/yr";
  text = fmt::format("{:.7g}", in_cgs);
  append_power(text, "g", powers.mass);
  append_power(text, "cm", length);
  append_power(text, "s", time);
  append_power(text, "K", powers.temperature);
  return text;
}

}  // namespace

std::string unit_name(const UnitPowers& powers, const BaseUnits& units, double stated_in_cgs) {
  const bool is_pure_number =
      powers.length == 0 && powers.mass == 0 && powers.velocity == 0 && powers.temperature == 0;
  if (is_pure_number) return {};
  const double product = size_in_cgs(powers, units);
  const bool is_stated = stated_in_cgs > 0 && std::isfinite(stated_in_cgs);
  std::string text;
  if (is_stated && !(product > 0 && are_close(product, stated_in_cgs))) {
    text = name_of_size(powers, stated_in_cgs);
  } else if (product > 0) {
    append_power(text, base_name(units.mass_in_g, masses()), powers.mass);
    append_power(text, base_name(units.length_in_cm, lengths()), powers.length);
    append_power(text, base_name(units.velocity_in_cm_per_s, velocities()), powers.velocity);
    append_power(text, "K", powers.temperature);
  } else {
    return {};
  }
  append_power(text, "h", powers.hubble);
  append_power(text, "a", powers.scale_factor);
  return text;
}

UnitPowers powers_of_field(const std::string& field) {
  UnitPowers powers;
  if (field == "position" || field == "smoothing_length") {
    powers.length = 1;
  } else if (field == "mass") {
    powers.mass = 1;
  } else if (field == "density") {
    powers.mass = 1;
    powers.length = -3;
  } else if (field == "velocity") {
    powers.velocity = 1;
  } else if (field == "internal_energy") {
    powers.velocity = 2;
  } else if (field == "temperature") {
    powers.temperature = 1;
  }
  return powers;
}

}  // namespace splotchcl
