#include "snapshot/derived_snapshots.h"

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

#include "scene/ceil_divide.h"
#include "scene/hash.h"
#include "scene/particle_columns.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// a * b / c without overflow, rounded down.
std::uint64_t scale(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  // A division of 64 bits is one instruction, where it is enough.
  if (std::max(a, b) <= UINT32_MAX) return a * b / c;
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(static_cast<Wide>(a) * b / c);
}

std::uint64_t total_count(const SnapshotInfo& info) {
  std::uint64_t total = 0;
  for (const ParticleTypeInfo& type : info.types)
    total += type.count;
  return total;
}

// "3", or "3.33333 of type 0 and 2.5 of type 4".
std::string tell_what_each_stands_for(const SnapshotInfo& info) {
  const double first = info.types.front().particles_per_drawn;
  std::vector<std::string> of_types;
  bool is_same = true;
  for (const ParticleTypeInfo& type : info.types) {
    is_same = is_same && type.particles_per_drawn == first;
    of_types.push_back(fmt::format("{:.6g} of type {}", type.particles_per_drawn, type.type));
  }
  return is_same ? fmt::format("{:.6g}", first) : fmt::format("{}", fmt::join(of_types, ", "));
}

}  // namespace

SubsetSnapshot::SubsetSnapshot(std::shared_ptr<const Snapshot> whole, const ReadSettings& read)
    : whole_(std::move(whole)), read_(read), info_(whole_->info()) {
  const std::uint64_t total = total_count(info_);
  for (ParticleTypeInfo& type : info_.types) {
    const std::uint64_t all = type.count;
    type.count = count_of(all, total);
    if (all > 0) {
      type.particles_per_drawn *= static_cast<double>(all) / static_cast<double>(type.count);
    }
  }
  const std::uint64_t drawn = total_count(info_);
  if (drawn < total) {
    info_.notes.push_back(fmt::format("only {} of {} particles are read; each stands for {}", drawn,
                                      total, tell_what_each_stands_for(info_)));
  }
}

std::uint64_t SubsetSnapshot::count_of(std::uint64_t count, std::uint64_t total) const {
  if (!read_.max_particles) {
    return ceil_divide(count, static_cast<std::uint64_t>(read_.every));
  }
  const auto most = static_cast<std::uint64_t>(*read_.max_particles);
  if (total <= most) return count;
  return std::max<std::uint64_t>(1, scale(count, most, total));
}

SubsetSnapshot::Places SubsetSnapshot::places_of(int type) const {
  Places places;
  places.all = whole_->info().find_type(type)->count;
  places.some = info_.find_type(type)->count;
  if (!read_.max_particles) {
    places.every = static_cast<std::uint64_t>(read_.every);
  } else {
    const auto seed = static_cast<std::uint64_t>(read_.seed);
    places.hash = hash_of(hash_of(seed) + static_cast<std::uint64_t>(type));
  }
  return places;
}

std::uint64_t SubsetSnapshot::Places::operator()(std::uint64_t i) const {
  if (every > 0) return i * every;
  const std::uint64_t first = scale(i, all, some), end = scale(i + 1, all, some);
  return first + hash_of(hash + i) % (end - first);
}

Column SubsetSnapshot::read(int type, const std::string& field) const {
  const Column all = whole_->read(type, field);
  const Places places = places_of(type);
  if (!all.is_array() || places.some == places.all) return all;
  return gather_in_order(all, all.size() / places.all, places.some, places);
}

std::vector<std::uint64_t> SubsetSnapshot::chosen_of(int type,
                                                     const std::vector<std::uint64_t>& all) const {
  std::vector<std::uint64_t> chosen;
  const Places places = places_of(type);
  chosen.reserve(places.some);
  for (std::uint64_t i = 0; i < places.some; ++i)
    chosen.push_back(all[places(i)]);
  return chosen;
}

std::vector<std::uint64_t> SubsetSnapshot::read_ids(int type) const {
  return chosen_of(type, whole_->read_ids(type));
}

std::vector<std::uint64_t> SubsetSnapshot::read_integers(int type, const std::string& field) const {
  return chosen_of(type, whole_->read_integers(type, field));
}

std::uint64_t SubsetSnapshot::place_in_file(int type, std::uint64_t i) const {
  return whole_->place_in_file(type, places_of(type)(i));
}

Column CachedSnapshot::read(int type, const std::string& field) const {
  // By the field's own name: a file's label for it finds the same column.
  const std::pair key(type, require_field(info(), type, field).name);
  const auto found = read_.find(key);
  if (found != read_.end()) return found->second;
  return read_[key] = DerivedSnapshot::read(type, field);
}

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
    if (!ratio && !size->unit.empty() && !position->unit.empty()) {
      info.notes.push_back(
          fmt::format("smoothing_length of type {} is in {} and position in {}, which cannot be "
                      "compared: they are taken for one unit; read.units may say what they are in",
                      type.type, size->unit, position->unit));
    }
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

class NamedUnitsSnapshot : public DerivedSnapshot {
 public:
  NamedUnitsSnapshot(std::unique_ptr<Snapshot> snapshot, SnapshotInfo info, SizeFactors factors)
      : DerivedSnapshot(std::move(snapshot)),
        info_(std::move(info)),
        factors_(std::move(factors)) {}

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override {
    const Column values = DerivedSnapshot::read(type, field);
    const auto factor = factors_.find(type);
    if (factor == factors_.end()) return values;
    const FieldInfo* const size = find_field(*info_.find_type(type), "smoothing_length");
    return &require_field(info_, type, field) == size ? multiplied(values, factor->second) : values;
  }

 private:
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
  const bool is_told = info.notes.size() != snapshot->info().notes.size();
  if (units.empty() && factors.empty() && !is_told) return snapshot;
  return std::make_unique<NamedUnitsSnapshot>(std::move(snapshot), std::move(info),
                                              std::move(factors));
}

}  // namespace splotchcl
