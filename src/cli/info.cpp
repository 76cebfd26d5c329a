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
#include "scene/statistics.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::cli {
namespace {

// One axis of a vector field, or the values of another.
struct FieldRow {
  std::string name;
  FieldStatistics statistics;
};

Column axis_of(const Column& vectors, std::size_t axis) {
  std::vector<float> values(vectors.size() / 3);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = vectors[3 * i + axis];
  return Column::owning(std::move(values));
}

std::vector<FieldRow> read_rows(const Snapshot& snapshot, int type, const FieldInfo& field) {
  const Column values = snapshot.read(type, field.name);
  if (field.values_per_particle != 3) return {{field.name, find_statistics(values)}};
  std::vector<FieldRow> rows;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    FieldStatistics statistics = find_statistics(axis_of(values, axis));
    if (field.name == "position") {
      const double origin = snapshot.position_origin().a[axis];
      statistics.minimum += origin;
      statistics.maximum += origin;
      statistics.mean += origin;
    }
    rows.push_back({field.name + " " + "xyz"[axis], statistics});
  }
  return rows;
}

// As the user may know it from the file, where that differs.
std::string label(const FieldInfo& field) {
  return field.file_name.empty() || field.file_name == field.name ? "" : printable(field.file_name);
}

std::string header_text(const SnapshotInfo& info) {
  std::string text = fmt::format("format    {}\n", printable(info.format));
  for (const auto& file : info.files) {
    text += fmt::format("{:9} {}\n", &file == &info.files.front() ? "files" : "",
                        printable(file.string()));
  }
  text += fmt::format("time      {}\n", info.time);
  if (info.redshift) text += fmt::format("redshift  {}\n", *info.redshift);
  if (info.box_size) text += fmt::format("box       {}\n", info.box_size->text());
  if (info.hubble_parameter) text += fmt::format("h         {}\n", *info.hubble_parameter);
  return text;
}

// Of the columns of names, in letters.
struct Widths {
  std::size_t name, label;
};

Widths widths_of(const ParticleTypeInfo& type) {
  Widths widths = {20, 12};
  for (const FieldInfo& field : type.fields) {
    const std::size_t axis = field.values_per_particle == 3 ? 2 : 0;
    widths.name = std::max(widths.name, field.name.size() + axis);
    widths.label = std::max(widths.label, label(field).size());
  }
  return widths;
}

std::string row_text(const FieldRow& row, const FieldInfo& field, const Widths& widths) {
  const FieldStatistics& s = row.statistics;
  return fmt::format("  {:{}} {:{}} {:>13.6g} {:>13.6g} {:>13.6g} {:>8} {}\n", printable(row.name),
                     widths.name, label(field), widths.label, s.minimum, s.maximum, s.mean, s.bad,
                     printable(field.unit));
}

std::string note_on_infinite(const FieldRow& row) {
  if (row.statistics.infinite == 0) return {};
  return fmt::format("  {} infinite values of {}: {}\n", row.statistics.infinite,
                     printable(row.name), advice_on_infinite_values());
}

// What the header tells of a type.
std::string type_header_text(const ParticleTypeInfo& type) {
  std::string text = fmt::format("\ntype {}, {}: {} particles\n", type.type,
                                 particle_type_name(type.type), type.count);
  if (type.table_mass)
    text += fmt::format("  mass of each, from the header: {}\n", *type.table_mass);
  return text;
}

std::string field_list_text(const ParticleTypeInfo& type) {
  const Widths widths = widths_of(type);
  std::string text = fmt::format("  {:{}} {:{}} {:>6} {}\n", "field", widths.name, "in the file",
                                 widths.label, "values", "unit");
  for (const FieldInfo& field : type.fields) {
    text +=
        fmt::format("  {:{}} {:{}} {:>6} {}\n", printable(field.name), widths.name, label(field),
                    widths.label, field.values_per_particle, printable(field.unit));
  }
  return text;
}

std::string type_text(const Snapshot& snapshot, const ParticleTypeInfo& type, Console& console) {
  const Widths widths = widths_of(type);
  std::string text = type_header_text(type);
  text += fmt::format("  {:{}} {:{}} {:>13} {:>13} {:>13} {:>8} {}\n", "field", widths.name,
                      "in the file", widths.label, "minimum", "maximum", "mean", "bad", "unit");
  std::string notes;
  for (const FieldInfo& field : type.fields) {
    console.status("reading " + field.name);
    for (const FieldRow& row : read_rows(snapshot, type.type, field)) {
      text += row_text(row, field, widths);
      notes += note_on_infinite(row);
    }
  }
  text += notes;
  text += printable(fmt::format("  derived: {}", fmt::join(derivable_fields(type), ", "))) + "\n";
  return text;
}

Json type_json(const Snapshot& snapshot, const ParticleTypeInfo& type, bool header_only) {
  Json json = {{"type", type.type}, {"name", particle_type_name(type.type)}, {"count", type.count}};
  if (type.table_mass) json["table_mass"] = *type.table_mass;
  json["fields"] = Json::array();
  if (header_only) {
    for (const FieldInfo& field : type.fields) {
      json["fields"].push_back({{"name", field.name},
                                {"file_name", field.file_name},
                                {"unit", field.unit},
                                {"values_per_particle", field.values_per_particle}});
    }
    return json;
  }
  for (const FieldInfo& field : type.fields) {
    for (const FieldRow& row : read_rows(snapshot, type.type, field)) {
      const FieldStatistics& s = row.statistics;
      json["fields"].push_back({{"name", row.name},
                                {"file_name", field.file_name},
                                {"unit", field.unit},
                                {"minimum", s.minimum},
                                {"maximum", s.maximum},
                                {"mean", s.mean},
                                {"bad", s.bad}});
    }
  }
  json["derived"] = derivable_fields(type);
  return json;
}

// A number for a cube, else three.
Json json_of(const BoxSides& box) {
  return box.is_cube() ? Json(box[0]) : Json({box[0], box[1], box[2]});
}

// Empty, and a note, where nothing can be drawn.
std::string suggested_scene(const Snapshot& snapshot, const InfoOptions& options,
                            Console& console) {
  try {
    Scene scene = suggest_scene(snapshot);
    if (path_in_file(options.snapshot)) scene.snapshot = options.snapshot.string();
    scene.read.columns = options.columns;
    scene.read.skip_lines = options.skip_lines;
    return format_scene(scene);
  } catch (const Error& error) {
    console.note(std::string("no scene can be suggested: ") + error.what());
    return {};
  }
}

Json to_json(const Snapshot& snapshot, const InfoOptions& options, Console& console) {
  const SnapshotInfo& info = snapshot.info();
  Json json = {{"format", info.format}, {"files", Json::array()}, {"time", info.time}};
  for (const auto& file : info.files)
    json["files"].push_back(file.string());
  if (info.redshift) json["redshift"] = *info.redshift;
  if (info.box_size) json["box_size"] = json_of(*info.box_size);
  if (info.hubble_parameter) json["hubble_parameter"] = *info.hubble_parameter;
  json["notes"] = info.notes;
  json["types"] = Json::array();
  for (const ParticleTypeInfo& type : info.types) {
    json["types"].push_back(type_json(snapshot, type, options.header));
  }
  if (!options.header) json["scene"] = suggested_scene(snapshot, options, console);
  return json;
}

void print_text(const Snapshot& snapshot, const InfoOptions& options, Console& console) {
  const SnapshotInfo& info = snapshot.info();
  std::string text = header_text(info);
  for (const std::string& note : info.notes)
    text += fmt::format("note      {}\n", printable(note));
  for (const ParticleTypeInfo& type : info.types)
    text += options.header ? type_header_text(type) + field_list_text(type)
                           : type_text(snapshot, type, console);
  const std::string scene = options.header ? "" : suggested_scene(snapshot, options, console);
  if (!scene.empty()) text += "\n# The scene file that render uses for it:\n" + scene;
  std::cout << text;
}

}  // namespace

int run_info(const InfoOptions& options, Console& console) {
  const auto snapshot = open_snapshot(options.snapshot, {options.columns, options.skip_lines});
  if (options.json) {
    print_json(to_json(*snapshot, options, console));
  } else {
    print_text(*snapshot, options, console);
  }
  return 0;
}

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
