#include "snapshot/unit_ratio.h"

#include <fmt/format.h>

#include <cmath>

#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::optional<Unit> known_unit(const std::string& text, const UnitFactors& factors) {
  try {
    return parse_unit(text, factors, "unit");
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

bool is_number(const Unit& unit) {
  return same_dimension(unit, Unit());
}

std::optional<double> ratio(const std::string& from, const std::string& to,
                            const UnitFactors& factors) {
  const std::optional<Unit> a = known_unit(from, factors), b = known_unit(to, factors);
  if (!a && !b) return 1;
  // Tables may number their columns: "x (1)".
  if (a && b && is_number(*a) && is_number(*b)) return 1;
  if (!a || !b || !same_dimension(*a, *b)) return std::nullopt;
  const double found = a->in_cgs / b->in_cgs;
  return std::isfinite(found) && found > 0 ? std::optional(found) : std::nullopt;
}

UnitFactors with_unknown(UnitFactors factors, double value) {
  if (!(factors.scale_factor > 0)) factors.scale_factor = value;
  if (!(factors.hubble > 0)) factors.hubble = value * value;
  return factors;
}

bool are_close(double a, double b) {
  constexpr double rounding = 1e-6;  // of the factors in the names
  return std::abs(a / b - 1) < rounding;
}

std::string unit_of(const ParticleTypeInfo& type, const char* field) {
  const FieldInfo* const info = find_field(type, field);
  return info == nullptr ? std::string() : info->unit;
}

}  // namespace

std::optional<double> unit_ratio(const std::string& from, const std::string& to,
                                 const UnitFactors& factors) {
  if (from.empty() || to.empty() || from == to) return 1;
  // Unknown a and h do no harm where they cancel.
  const auto found = ratio(from, to, with_unknown(factors, 1));
  const auto other = ratio(from, to, with_unknown(factors, 2));
  if (!found || !other || !are_close(*found, *other)) return std::nullopt;
  return are_close(*found, 1) ? 1 : found;
}

std::optional<double> ratio_of_known_units(const std::string& from, const std::string& to,
                                           const UnitFactors& factors) {
  if (from == to) return 1;
  const bool are_said = !from.empty() && !to.empty();
  // Of a unit that is not known nothing says that it is another one by 1.
  if (!are_said || !known_unit(from, with_unknown(factors, 1))) return std::nullopt;
  return unit_ratio(from, to, factors);
}

std::string unit_of_matching_density(const ParticleTypeInfo& type) {
  const std::string mass = unit_of(type, "mass"), length = unit_of(type, "position");
  if (mass.empty() || length.empty()) return {};
  return fmt::format("({}) ({})^-3", mass, length);
}

std::string unit_of_matching_volume(const ParticleTypeInfo& type) {
  const std::string length = unit_of(type, "position");
  return length.empty() ? length : fmt::format("({})^3", length);
}

}  // namespace splotchcl
