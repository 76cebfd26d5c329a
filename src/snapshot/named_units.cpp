#include "snapshot/named_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct FieldUnit {
  std::string field, unit;
};

FieldUnit parse_field_unit(const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) {
    throw UsageError(
        fmt::format("read.units: found \"{}\", expected FIELD=UNIT, such as mass=Msun", text));
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

// Its numbers stay as they are.
class NamedUnitsSnapshot : public Snapshot {
 public:
  NamedUnitsSnapshot(std::unique_ptr<Snapshot> snapshot, SnapshotInfo info)
      : snapshot_(std::move(snapshot)), info_(std::move(info)) {}

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override {
    return snapshot_->read(type, field);
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
};

}  // namespace

std::unique_ptr<Snapshot> with_named_units(std::unique_ptr<Snapshot> snapshot,
                                           const std::vector<std::string>& units) {
  if (units.empty()) return snapshot;
  SnapshotInfo info = snapshot->info();
  for (const std::string& text : units)
    name_unit(parse_field_unit(text), info);
  return std::make_unique<NamedUnitsSnapshot>(std::move(snapshot), std::move(info));
}

}  // namespace splotchcl
