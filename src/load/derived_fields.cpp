#include "load/derived_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formula/selection.h"
#include "scene/constants.h"
#include "scene/particle_columns.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double boltzmann_erg_per_kelvin = 1.380649e-16;
constexpr double adiabatic_index = 5.0 / 3;

// One value of each vector.
template <class Value>
Column of_vectors(const Column& vectors, bool streams, Value value) {
  const auto make = [=](std::size_t begin, std::size_t end, float* out) {
    const ColumnStretch stretch(vectors, 3 * begin, 3 * end);
    for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
      const double vector[3] = {static_cast<double>(stretch[i]),
                                static_cast<double>(stretch[i + 1]),
                                static_cast<double>(stretch[i + 2])};
      *out++ = static_cast<float>(value(vector));
    }
  };
  return make_column(vectors.size() / 3, streams || is_streamed(vectors), make);
}

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace

Column temperatures(const Column& internal_energy, const Column& electron_abundance,
                    double energy_unit, std::size_t count, bool streams) {
  constexpr double x = hydrogen_mass_fraction;
  const double per_energy_and_weight =
      (adiabatic_index - 1) * energy_unit * proton_mass_in_g / boltzmann_erg_per_kelvin;
  const auto make = [=](std::size_t begin, std::size_t end, float* out) {
    const ColumnStretch energies(internal_energy, begin, end);
    const ColumnStretch abundances(electron_abundance, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const double electrons =
          electron_abundance.is_absent() ? (1 + x) / (2 * x) : static_cast<double>(abundances[i]);
      const double weight = 4 / (1 + 3 * x + 4 * x * electrons);
      *out++ =
          static_cast<float>(per_energy_and_weight * weight * static_cast<double>(energies[i]));
    }
  };
  return make_column(
      count, streams || is_streamed(internal_energy) || is_streamed(electron_abundance), make);
}

double temperature_of_one(double energy_unit) {
  constexpr double x = hydrogen_mass_fraction, electrons = (1 + x) / (2 * x);
  constexpr double weight = 4 / (1 + 3 * x + 4 * x * electrons);
  return (adiabatic_index - 1) * energy_unit * weight * proton_mass_in_g / boltzmann_erg_per_kelvin;
}

std::optional<double> energy_unit_in_cgs(const SnapshotInfo& info, const FieldInfo& field) {
  if (field.unit.empty()) {
    // Gadget's own unit, and that of its descendants, of which their files say nothing.
    const bool is_of_gadget = begins_with(info.format, "Gadget") ||
                              begins_with(info.format, "AREPO") ||
                              begins_with(info.format, "GIZMO");
    return is_of_gadget ? std::optional(1e10) : std::nullopt;
  }
  return unit_ratio(field.unit, "(cm/s)^2", unit_factors(info));
}

Column volumes_of(const Column& mass, const Column& density, double density_unit, std::size_t count,
                  bool streams) {
  const auto make = [=](std::size_t begin, std::size_t end, float* out) {
    const ColumnStretch masses(mass, begin, end), densities(density, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      *out++ = static_cast<float>(static_cast<double>(masses[i]) /
                                  (density_unit * static_cast<double>(densities[i])));
    }
  };
  return make_column(count, streams || is_streamed(mass) || is_streamed(density), make);
}

Column lengths_of_vectors(const Column& vectors, bool streams) {
  return of_vectors(vectors, streams, [](const double* v) {
    return std::hypot(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
  });
}

Column axis_of_vectors(const Column& vectors, std::size_t axis, double added, bool streams) {
  return of_vectors(vectors, streams, [=](const double* v) { return added + v[axis]; });
}

Column distances(const Column& position, const Vec3& origin, const Vec3& center, bool streams) {
  return of_vectors(position, streams, [=](const double* v) {
    double d[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      d[axis] = (origin.a[axis] - center.a[axis]) + v[axis];
    return std::hypot(d[0], d[1], d[2]);
  });
}

std::pair<const FieldInfo*, std::size_t> find_axis(const ParticleTypeInfo& type,
                                                   const std::string& name) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "xyz"[axis]);
    if (equal_ignoring_case(name, letter)) return find_axis(type, "position_" + letter);
    if (equal_ignoring_case(name, "v" + letter)) return find_axis(type, "velocity_" + letter);
  }
  const std::size_t length = name.size();
  if (length < 3 || name[length - 2] != '_') return {nullptr, 0};
  const std::size_t axis = std::string("xyz").find(name[length - 1]);
  if (axis == std::string::npos) return {nullptr, 0};
  const FieldInfo* const field = find_field(type, name.substr(0, length - 2));
  if (field == nullptr || field->values_per_particle != 3) return {nullptr, 0};
  return {field, axis};
}

std::string unit_of(const ParticleTypeInfo& type, const std::string& name) {
  const auto unit_of_stored = [&type](const std::string& field) {
    const FieldInfo* const found = find_field(type, field);
    return found == nullptr ? std::string() : found->unit;
  };
  const FieldInfo* const stored = find_field(type, name);
  const std::string canonical = canonical_field_name(name);
  if (stored != nullptr && (!stored->unit.empty() || canonical != "density")) return stored->unit;
  if (canonical == "temperature") return "K";
  if (canonical == "density") return unit_of_matching_density(type);
  if (canonical == "smoothing_length" || equal_ignoring_case(name, "radius"))
    return unit_of_stored("position");
  if (equal_ignoring_case(name, "speed")) return unit_of_stored("velocity");
  const FieldInfo* const vectors = find_axis(type, name).first;
  return vectors == nullptr ? std::string() : vectors->unit;
}

std::vector<std::string> derivable_fields(const ParticleTypeInfo& type) {
  const auto has = [&type](const char* name) { return find_field(type, name) != nullptr; };
  std::vector<std::string> names;
  for (const char* const name : {"smoothing_length", "density"}) {
    if (!has(name)) names.push_back(name);
  }
  if (has("internal_energy") && !has("temperature")) names.push_back("temperature");
  if (has("velocity") && !has("speed")) names.push_back("speed");
  if (!has("radius")) names.push_back("radius");
  for (const FieldInfo& field : type.fields) {
    if (field.values_per_particle != 3) continue;
    for (const char* const axis : {"_x", "_y", "_z"})
      names.push_back(field.name + axis);
  }
  return names;
}

namespace {

// Identifiers are compared with identifiers, and with nothing between them.
void check_ids_compared(const TypeFields& fields, const Formula& formula, const std::string& key) {
  const auto is_id = [&](const FormulaPart& part) {
    return part.operation == Operation::field &&
           canonical_field_name(formula.fields()[part.name]) == "id";
  };
  for (const FormulaPart& part : formula.parts()) {
    if (!is_comparison(part.operation)) continue;
    const FormulaPart &left = formula.parts()[part.operands[0]],
                      &right = formula.parts()[part.operands[1]];
    const FormulaPart& other = is_id(left) ? right : left;
    const bool is_number = other.operation == Operation::number && !other.whole;
    const bool is_negative = other.operation == Operation::negate;
    if (!is_id(left) && !is_id(right)) continue;
    if (!is_number && !is_negative) continue;
    throw UsageError(fmt::format(
        "{} \"{}\": found ids compared with {}, expected a whole number from 0 to 2^64 - 1",
        fields.what(key), formula.text(), formula.text_of(other)));
  }
}

UnitOfField units_of(const TypeFields& fields) {
  return [&fields](const std::string& name) {
    return written_unit(unit_of(fields.info(), name), unit_factors(fields.snapshot_info()));
  };
}

// Its numbers in the units of the fields.
Formula in_units_of(const TypeFields& fields, const Formula& formula, const std::string& key) {
  return with_converted_numbers(formula, units_of(fields), unit_factors(fields.snapshot_info()),
                                fields.what(key));
}

}  // namespace

Formula condition_on(const TypeFields& fields, const std::string& text, const std::string& key) {
  const std::optional<Formula> comparisons = parse_comparisons(text);
  if (!comparisons) return parse_condition(text, fields.what(key));
  const auto& names = comparisons->fields();
  const bool are_fields = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return canonical_field_name(name) == "id" || fields.has_plain(name);
  });
  const bool are_formulas = std::any_of(names.begin(), names.end(), Formula::may_be);
  return are_fields || !are_formulas ? *comparisons : Formula::parse(text, fields.what(key));
}

void check_formula(const TypeFields& fields, const Formula& formula, const std::string& key) {
  for (const std::string& name : formula.fields()) {
    const bool is_id = canonical_field_name(name) == "id";
    if (!is_id && !fields.has_plain(name)) fields.refuse_field(name, key);
  }
  check_ids_compared(fields, formula, key);
  unit_of_formula(in_units_of(fields, formula, key), units_of(fields), fields.what(key));
}

std::shared_ptr<const FormulaValues> formula_values(const TypeFields& fields,
                                                    const Formula& formula,
                                                    const std::string& key) {
  FormulaSources sources;
  sources.values = [&](const std::string& field) { return fields.plain_values(field, key); };
  sources.whole_numbers = [&](const std::string& field, bool are_large) {
    return fields.whole_numbers(field, are_large);
  };
  return std::make_shared<const FormulaValues>(in_units_of(fields, formula, key), sources);
}

}  // namespace splotchcl
