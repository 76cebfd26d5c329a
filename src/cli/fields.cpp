#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/json_answer.h"
#include "common/words.h"
#include "load/derived_fields.h"
#include "load/type_fields.h"
#include "map/map_units.h"
#include "snapshot/field_names.h"
#include "snapshot/field_statistics.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::cli {
namespace {

// A field as a scene names it.
struct NamedField {
  const ParticleTypeInfo* type = nullptr;
  std::string name, unit;
  int values_per_particle = 1;
  bool is_derived = false;
  std::optional<FieldStatistics> statistics;  // none: of vectors, and where finding it takes long
};

// Needs a search for neighbors, or a place that the scene says.
bool is_found_when_drawn(const std::string& derived) {
  return derived == "smoothing_length" || derived == "density" || derived == "radius";
}

std::string unit_of_derived(const ParticleTypeInfo& type, const std::string& name) {
  if (name == "temperature") return "K";
  const auto unit_of = [&type](const std::string& field) {
    const FieldInfo* const found = find_field(type, field);
    return found == nullptr ? std::string() : found->unit;
  };
  if (name == "density") return name_of_density(type);
  if (name == "speed") return unit_of("velocity");
  if (name == "radius" || name == "smoothing_length") return unit_of("position");
  const FieldInfo* const vectors = find_axis(type, name).first;
  return vectors == nullptr ? "" : vectors->unit;
}

std::vector<NamedField> fields_of(const Snapshot& snapshot, const ParticleTypeInfo& type,
                                  Console& console) {
  const TypeFields values(snapshot, type, particle_type_name(type.type), Vec3{{0, 0, 0}},
                          [](const std::string&) {});
  std::vector<NamedField> fields;
  for (const FieldInfo& info : type.fields) {
    fields.push_back({&type, info.name, info.unit, info.values_per_particle, false, {}});
    if (info.values_per_particle != 1) continue;
    console.status("reading " + info.name);
    fields.back().statistics = find_statistics(snapshot.read(type.type, info.name));
  }
  for (const std::string& name : derivable_fields(type)) {
    fields.push_back({&type, name, unit_of_derived(type, name), 1, true, {}});
    if (is_found_when_drawn(name)) continue;
    console.status("reading " + name);
    try {
      fields.back().statistics = find_statistics(values.scalars(name, "field"));
    } catch (const UsageError& error) {  // a temperature of energies in an unknown unit
      console.note(error.what());
      fields.pop_back();
    }
  }
  return fields;
}

std::vector<NamedField> list_fields(const Snapshot& snapshot, Console& console) {
  std::vector<NamedField> all;
  for (const ParticleTypeInfo& type : snapshot.info().types) {
    const std::vector<NamedField> fields = fields_of(snapshot, type, console);
    all.insert(all.end(), fields.begin(), fields.end());
  }
  return all;
}

std::string number(const std::optional<FieldStatistics>& statistics,
                   double FieldStatistics::*which) {
  return statistics ? fmt::format("{:.6g}", (*statistics).*which) : "-";
}

std::string remark(const NamedField& field) {
  if (field.values_per_particle == 3) return "vector";
  if (field.values_per_particle > 1) return fmt::format("{} values", field.values_per_particle);
  if (!field.is_derived) return "";
  return field.statistics ? "derived" : "derived when drawn";
}

void print_text(const std::vector<NamedField>& fields) {
  std::size_t name_width = 5, unit_width = 4;
  for (const NamedField& field : fields) {
    name_width = std::max(name_width, field.name.size());
    unit_width = std::max(unit_width, field.unit.size());
  }
  std::cout << fmt::format("{:4}  {:10}  {:{}}  {:>12}  {:>13}  {:>13}  {:>8}  unit\n", "type",
                           "name", "field", name_width, "particles", "minimum", "maximum", "bad");
  for (const NamedField& field : fields) {
    const std::string bad = field.statistics ? std::to_string(field.statistics->bad) : "-";
    std::string line =
        fmt::format("{:>4}  {:10}  {:{}}  {:>12}  {:>13}  {:>13}  {:>8}  {:{}}  {}",
                    field.type->type, particle_type_name(field.type->type), field.name, name_width,
                    field.type->count, number(field.statistics, &FieldStatistics::minimum),
                    number(field.statistics, &FieldStatistics::maximum), bad, field.unit,
                    unit_width, remark(field));
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << printable(line) << "\n";
  }
}

Json json_of_field(const NamedField& field) {
  Json json = {{"type", field.type->type},
               {"name", particle_type_name(field.type->type)},
               {"field", field.name},
               {"particles", field.type->count},
               {"values_per_particle", field.values_per_particle},
               {"unit", field.unit},
               {"is_derived", field.is_derived}};
  if (!field.statistics) return json;
  json["minimum"] = field.statistics->minimum;
  json["maximum"] = field.statistics->maximum;
  json["bad"] = field.statistics->bad;
  return json;
}

}  // namespace

int run_fields(const SnapshotQuestion& options, Console& console) {
  const auto snapshot = open_snapshot(options.snapshot, {options.columns, options.skip_lines});
  const std::vector<NamedField> fields = list_fields(*snapshot, console);
  if (options.json) {
    print_json_list(fields, json_of_field);
  } else {
    print_text(fields);
  }
  return 0;
}

}  // namespace splotchcl::cli
