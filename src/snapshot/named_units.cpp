#include "snapshot/named_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// A field's unit.
struct FieldUnit {
  std::string field, unit;
};

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

// The units of common fields in the system of this name: gadget, cgs or si. None where there is no
// such system.
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

FieldUnit parse_field_unit(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) {
    throw UsageError(fmt::format(
        "read.units: found \"{}\", expected FIELD=UNIT, such as mass=Msun, or a system: {}", text,
        fmt::join(names_of_unit_systems(), ", ")));
  }
  return {text.substr(0, sign), text.substr(sign + 1)};
}

struct KindOfField {
  const char* field;
  std::vector<const char*> units;  // of which one has the dimension
};

// Whatever a and h are.
void check_unit(const FieldUnit& named) {
  static const std::vector<KindOfField> kinds = {
      {"position", {"cm"}},      {"smoothing_length", {"cm"}},   {"softening", {"cm"}},
      {"mass", {"g"}},           {"velocity", {"cm/s"}},         {"density", {"g/cm^3"}},
      {"volume", {"cm^3"}},      {"internal_energy", {"erg/g"}}, {"temperature", {"K", "erg"}},
      {"pressure", {"erg/cm^3"}}};
  const UnitFactors any = {1, 1};
  const std::string key = "read.units." + named.field;
  const Unit unit = parse_unit(named.unit, any, key);
  for (const KindOfField& kind : kinds) {
    if (canonical_field_name(named.field) != kind.field) continue;
    const bool fits = std::any_of(kind.units.begin(), kind.units.end(), [&](const char* like) {
      return same_dimension(unit, parse_unit(like, any, key));
    });
    if (fits) return;
    throw UsageError(fmt::format("{}: found {}, expected a unit such as {}", key, named.unit,
                                 kind.units.front()));
  }
}

[[noreturn]] void refuse_field(const FieldUnit& named, const SnapshotInfo& info) {
  std::set<std::string> names;
  for (const ParticleTypeInfo& type : info.types) {
    for (const FieldInfo& field : type.fields)
      names.insert(field.name);
  }
  throw UsageError(fmt::format("read.units: found {}, which {} does not have, expected some of {}",
                               named.field, info.files.front().string(), fmt::join(names, ", ")));
}

FieldInfo* find_own(ParticleTypeInfo& type, const std::string& name) {
  const FieldInfo* const found = find_field(type, name);
  return found == nullptr ? nullptr : &type.fields[found - type.fields.data()];
}

void name_unit(const FieldUnit& named, SnapshotInfo& info) {
  check_unit(named);
  std::set<std::string> stated;
  bool is_there = false;
  for (ParticleTypeInfo& type : info.types) {
    FieldInfo* const field = find_own(type, named.field);
    if (field == nullptr) continue;
    is_there = true;
    if (!field->unit.empty() && field->unit != named.unit) stated.insert(field->unit);
    field->unit = named.unit;
  }
  if (!is_there) refuse_field(named, info);
  if (stated.empty()) return;
  info.notes.push_back(fmt::format("{} is taken to be in {}, as read.units says, not in {}",
                                   named.field, named.unit, fmt::join(stated, ", ")));
}

bool is_same_unit(const std::string& a, const std::string& b, const UnitFactors& factors) {
  constexpr double rounding = 1e-3;
  const auto ratio = ratio_of_known_units(a, b, factors);
  return ratio && std::abs(*ratio - 1) < rounding;
}

// A system counts where the file says nothing.
void name_units_of_system(const std::vector<FieldUnit>& system, SnapshotInfo& info) {
  std::set<std::string> kept;
  for (const FieldUnit& named : system) {
    for (ParticleTypeInfo& type : info.types) {
      FieldInfo* const field = find_own(type, named.field);
      if (field == nullptr) continue;
      if (field->unit.empty()) {
        field->unit = named.unit;
      } else if (!is_same_unit(field->unit, named.unit, unit_factors(info))) {
        kept.insert(fmt::format("{} in {}", field->name, field->unit));
      }
    }
  }
  if (kept.empty()) return;
  info.notes.push_back(
      fmt::format("units that the file states are kept: {}", fmt::join(kept, ", ")));
}

// What smoothing lengths of each type have to be multiplied by to be in the unit of positions.
using SizeFactors = std::map<int, double>;

SizeFactors factors_of_sizes(SnapshotInfo& info) {
  constexpr double rounding = 1e-6;
  SizeFactors factors;
  for (ParticleTypeInfo& type : info.types) {
    const FieldInfo* const position = find_field(type, "position");
    FieldInfo* const size = find_own(type, "smoothing_length");
    if (position == nullptr || size == nullptr) continue;
    const auto ratio = ratio_of_known_units(size->unit, position->unit, unit_factors(info));
    if (!ratio || std::abs(*ratio - 1) < rounding) continue;
    info.notes.push_back(fmt::format("smoothing_length of type {} is converted from {} to {}",
                                     type.type, size->unit, position->unit));
    size->unit = position->unit;
    size->file_name += fmt::format(" times {:.7g}", *ratio);
    factors[type.type] = *ratio;
  }
  return factors;
}

Column multiplied(const Column& column, double factor) {
  if (!column.is_array()) return Column::uniform(static_cast<float>(factor * column[0]));
  std::vector<float> values(column.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(factor * static_cast<double>(column[i]));
  return Column::owning(std::move(values));
}

class NamedUnitsSnapshot : public Snapshot {
 public:
  NamedUnitsSnapshot(std::unique_ptr<Snapshot> snapshot, SnapshotInfo info, SizeFactors factors)
      : snapshot_(std::move(snapshot)), info_(std::move(info)), factors_(std::move(factors)) {}

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override {
    const Column values = snapshot_->read(type, field);
    const auto factor = factors_.find(type);
    if (factor == factors_.end()) return values;
    const FieldInfo* const size = find_field(*info_.find_type(type), "smoothing_length");
    return &require_field(info_, type, field) == size ? multiplied(values, factor->second) : values;
  }
  std::vector<std::uint64_t> read_ids(int type) const override { return snapshot_->read_ids(type); }
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override {
    return snapshot_->read_integers(type, field);
  }
  std::uint64_t place_in_file(int type, std::uint64_t i) const override {
    return snapshot_->place_in_file(type, i);
  }
  Vec3 position_origin() const override { return snapshot_->position_origin(); }

 private:
  std::unique_ptr<Snapshot> snapshot_;
  SnapshotInfo info_;
  SizeFactors factors_;
};

}  // namespace

std::unique_ptr<Snapshot> with_named_units(std::unique_ptr<Snapshot> snapshot,
                                           const std::vector<std::string>& units) {
  SnapshotInfo info = snapshot->info();
  for (const std::string& text : units)
    name_units_of_system(units_of_system(text), info);
  for (const std::string& text : units) {
    if (units_of_system(text).empty()) name_unit(parse_field_unit(text), info);
  }
  SizeFactors factors = factors_of_sizes(info);
  if (units.empty() && factors.empty()) return snapshot;
  return std::make_unique<NamedUnitsSnapshot>(std::move(snapshot), std::move(info),
                                              std::move(factors));
}

}  // namespace splotchcl
