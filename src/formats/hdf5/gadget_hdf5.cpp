// HDF5 snapshots with groups Header and PartType0, PartType1, ...: Gadget 2 to 4, AREPO and
// their relatives, SWIFT.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/gadget/gadget_header.h"
#include "formats/hdf5/gadget_hdf5_header.h"
#include "formats/hdf5/hdf5_column.h"
#include "formats/hdf5/hdf5_file.h"
#include "formats/hdf5/hdf5_formats.h"
#include "formats/hdf5/hdf5_units.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// A dataset of a particle type that can be a field, or one of its columns.
struct Hdf5Field {
  std::string label;  // the dataset's name in its group
  int values_per_particle = 1;
  Hdf5Dataset dataset;
};

constexpr std::uint64_t most_columns_of_one = 64;

// The elements in the order of GIZMO, behind the whole, and of AREPO's GFM.
std::vector<std::string> elements_of(const std::string& label, std::uint64_t columns) {
  if (label == "Metallicity" && columns == 11)
    return {"", "He", "C", "N", "O", "Ne", "Mg", "Si", "S", "Ca", "Fe"};
  if (label == "GFM_Metals" && columns == 10)
    return {"H", "He", "C", "N", "O", "Ne", "Mg", "Si", "Fe", "others"};
  return {};
}

// SWIFT lists them elsewhere.
std::vector<std::string> names_of_swift(const Hdf5File& file, const std::string& label) {
  for (const char* const group : {"/SubgridScheme/NamedColumns/", "/NamedColumns/"}) {
    if (file.has(group + label)) return file.lines(group + label);
  }
  return {};
}

std::vector<std::string> names_of_parts(const Hdf5File& file, const Hdf5Dataset& dataset) {
  const std::uint64_t columns = dataset.values_per_row();
  std::vector<std::string> names = names_of_swift(file, dataset.label());
  if (names.size() != columns) names = elements_of(dataset.label(), columns);
  for (std::uint64_t i = names.size(); i < columns; ++i)
    names.push_back(std::to_string(i + 1));
  return names;
}

bool has_parts(const Hdf5Dataset& dataset) {
  return dataset.is_number() && dataset.shape.size() == 2 &&
         dataset.values_per_row() <= most_columns_of_one && dataset.values_per_row() > 1;
}

void add_parts(const Hdf5File& file, const Hdf5Dataset& dataset, const std::string& label,
               std::vector<Hdf5Field>& fields) {
  const std::vector<std::string> names = names_of_parts(file, dataset);
  for (std::uint64_t column = 0; column < names.size(); ++column) {
    Hdf5Dataset part = dataset;
    part.column = column;
    const std::string& name = names[column];
    fields.push_back({name.empty() ? label : label + "." + name, 1, std::move(part)});
  }
}

// What cannot be fields, for notes.
struct LeftOut {
  std::vector<std::string> of_other_lengths, others;
};

// `start` is before each label: that of the group in a type's group, and a point.
void add_fields_of(const Hdf5File& file, const std::string& group, const std::string& start,
                   std::uint64_t count, std::vector<Hdf5Field>& fields, LeftOut& left_out) {
  for (const Hdf5Dataset& dataset : file.datasets(group)) {
    const std::string label = start + dataset.label();
    const std::uint64_t values = dataset.values_per_row();
    if (dataset.shape.empty() || dataset.rows() != count) {
      left_out.of_other_lengths.push_back(fmt::format("{} ({})", label, dataset.rows()));
    } else if (dataset.is_number() && (values == 1 || values == 3)) {
      fields.push_back({label, static_cast<int>(values), dataset});
    } else if (has_parts(dataset)) {
      add_parts(file, dataset, label, fields);
    } else {
      left_out.others.push_back(label);
    }
  }
}

// The fields of group PartType<type>, which has so many particles, and of groups in it
// (ElementAbundance.Oxygen). Of datasets of several columns each is a field, by the name that it
// has in the file or its code, or by its number from 1; the first of GIZMO's Metallicity, which is
// the whole, has the dataset's name. Datasets that are no numbers, or have not a row for each
// particle, are left out and named in `notes`.
std::vector<Hdf5Field> find_hdf5_fields(const Hdf5File& file, std::uint64_t count, int type,
                                        std::vector<std::string>& notes) {
  const std::string group = fmt::format("PartType{}", type);
  std::vector<Hdf5Field> fields;
  LeftOut left_out;
  add_fields_of(file, group, "", count, fields, left_out);
  for (const std::string& inner : file.groups(group))
    add_fields_of(file, group + "/" + inner, inner + ".", count, fields, left_out);
  if (!left_out.of_other_lengths.empty()) {
    notes.push_back(fmt::format("left out of {}, as they have other than {} rows: {}", group, count,
                                fmt::join(left_out.of_other_lengths, ", ")));
  }
  if (!left_out.others.empty()) {
    notes.push_back(
        fmt::format("left out of {}, as they are not one or a few numbers per particle: {}", group,
                    fmt::join(left_out.others, ", ")));
  }
  return fields;
}

struct Hdf5Member {
  std::filesystem::path path;
  GadgetHeader own_header;
  Hdf5Links links;
  std::map<int, std::vector<Hdf5Field>> fields;  // of the types with particles

  const GadgetHeader& header() const { return own_header; }
  const Hdf5Field* find_field(int type, const std::string& label) const {
    const auto of_type = fields.find(type);
    if (of_type == fields.end()) return nullptr;
    const auto found = std::find_if(of_type->second.begin(), of_type->second.end(),
                                    [&](const Hdf5Field& field) { return field.label == label; });
    return found == of_type->second.end() ? nullptr : &*found;
  }
};

Hdf5Member read_hdf5_member(const std::filesystem::path& path, std::vector<std::string>& notes) {
  const Hdf5File file(path);
  Hdf5Member member;
  member.path = path;
  member.own_header = read_hdf5_header(file, notes);
  count_rows_without_header(file, member.own_header, notes);
  leave_out_tracers(file, member.own_header, notes);
  count_rows_of_positions(file, member.own_header, notes);
  check_header(member.header(), path);
  for (std::size_t type = 0; type < member.header().counts.size(); ++type) {
    if (member.header().counts[type] == 0) continue;
    const auto number = static_cast<int>(type);
    member.fields[number] = find_hdf5_fields(file, member.header().counts[type], number, notes);
  }
  member.links = file.links();
  note_refused(member.links, notes);
  return member;
}

Column at_least_zero(const Column& column) {
  std::vector<float> values(column.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = column[i] < 0 ? 0 : column[i];
  return Column::owning(std::move(values));
}

class GadgetHdf5Snapshot : public Snapshot {
 public:
  explicit GadgetHdf5Snapshot(const std::filesystem::path& path);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  Vec3 position_origin() const override { return origin_; }

 private:
  void read_dialect();
  void read_motion();
  void find_fields(ParticleTypeInfo& type);
  static void name_subfinds_lengths(ParticleTypeInfo& type);
  bool has_times_for_rates(const FieldInfo& field) const;
  void note_negative_rates(const ParticleTypeInfo& type);
  static void name_unit_of_table_mass(const Hdf5File& file, ParticleTypeInfo& type);
  std::vector<const Hdf5Field*> fields_of_all_members(int type) const;
  bool is_in_every_member(int type, const Hdf5Field& field) const;
  void check_units(const std::vector<Hdf5Values>& parts) const;
  std::vector<Hdf5Values> find_parts(int type, const std::string& label) const;
  void choose_origin();

  std::vector<Hdf5Member> members_;
  SnapshotInfo info_;
  Vec3 origin_ = {{0, 0, 0}};
  bool is_swift_ = false;
  double smoothing_length_factor_ = 1;  // from what the file has to the support radius
};

GadgetHdf5Snapshot::GadgetHdf5Snapshot(const std::filesystem::path& path) {
  members_ = read_members(path, read_hdf5_member, info_);
  for (const Hdf5Member& member : members_) {
    info_.files_beside.insert(info_.files_beside.end(), member.links.followed.begin(),
                              member.links.followed.end());
  }
  info_.files_mark = hash_of_files(info_).value();
  read_dialect();
  for (ParticleTypeInfo& type : info_.types)
    find_fields(type);
  read_motion();
  choose_origin();
}

void GadgetHdf5Snapshot::read_dialect() {
  const Hdf5File file(members_.front().path);
  const bool is_swift = is_swift_file(file);
  info_.format = hdf5_dialect(file);
  is_swift_ = is_swift;
  // What SWIFT's own kernel, the cubic spline, has in three dimensions.
  constexpr double cubic_spline_gamma = 1.825742;
  if (is_swift_start_file(file)) {
    smoothing_length_factor_ = cubic_spline_gamma;
    if (file.has("PartType0/SmoothingLength") || file.has("PartType0/SmoothingLengths")) {
      info_.notes.push_back(
          "initial conditions for SWIFT do not say its kernel: the cubic spline's is taken, which "
          "reaches 1.8257 times the smoothing lengths in the file");
    }
  }
  if (!is_swift) return;
  // SWIFT stores the kernel's scale, not its support.
  const double gamma = file.number("HydroScheme", "Kernel gamma").value_or(0);
  const bool is_stated = gamma > 0 && std::isfinite(gamma);
  smoothing_length_factor_ = is_stated ? gamma : cubic_spline_gamma;
  if (is_stated || !file.has("PartType0")) return;
  info_.notes.push_back(
      "HydroScheme does not say SWIFT's Kernel gamma: the cubic spline's is taken, which reaches "
      "1.8257 times the smoothing lengths in the file");
}

void GadgetHdf5Snapshot::read_motion() {
  const ParticleTypeInfo& type = info_.types.front();
  const auto path_of = [&type](const char* name) {
    const FieldInfo* const field = find_field(type, name);
    return fmt::format("/PartType{}/{}", type.type, field == nullptr ? name : field->file_name);
  };
  const auto member = std::find_if(members_.begin(), members_.end(), [&](const Hdf5Member& m) {
    return m.fields.count(type.type) > 0;
  });
  const Hdf5File file(member->path);
  info_.cosmology =
      read_cosmology(file, member->header(), path_of("position"), path_of("velocity"));
  if (!is_swift_) note_other_scale_factor(info_);
  if (has_gizmo_units(file)) name_gizmo_units(file, info_);
}

std::vector<const Hdf5Field*> GadgetHdf5Snapshot::fields_of_all_members(int type) const {
  std::vector<const Hdf5Field*> fields;
  for (const Hdf5Member& member : members_) {
    const auto of_type = member.fields.find(type);
    if (of_type == member.fields.end()) continue;
    for (const Hdf5Field& field : of_type->second)
      add_if_new(field, fields);
  }
  return fields;
}

bool GadgetHdf5Snapshot::is_in_every_member(int type, const Hdf5Field& field) const {
  return std::all_of(members_.begin(), members_.end(), [&](const Hdf5Member& member) {
    if (member.fields.count(type) == 0) return true;
    const Hdf5Field* const own = member.find_field(type, field.label);
    return own != nullptr && own->values_per_particle == field.values_per_particle;
  });
}

void GadgetHdf5Snapshot::find_fields(ParticleTypeInfo& type) {
  const auto member = std::find_if(members_.begin(), members_.end(), [&](const Hdf5Member& m) {
    return m.fields.count(type.type) > 0;
  });
  const Hdf5File file(member->path);
  const UnitsOfFile units = read_units(file);
  for (const Hdf5Field* const field : fields_of_all_members(type.type)) {
    if (!is_in_every_member(type.type, *field)) {
      info_.notes.push_back(
          fmt::format("dataset {} left out: not every file of the snapshot has it in the same form",
                      field->dataset.path));
      continue;
    }
    const std::string unit = read_field_unit(file, field->dataset, units);
    type.fields.push_back({"", field->label, field->values_per_particle, unit});
  }
  add_table_mass(type, "MassTable", info_.notes);
  name_fields(type);
  name_subfinds_lengths(type);
  note_negative_rates(type);
  if (type.table_mass) name_unit_of_table_mass(file, type);
}

// SUBFIND's reach to the nearest particles of dark matter: of that type they are smoothing lengths.
void GadgetHdf5Snapshot::name_subfinds_lengths(ParticleTypeInfo& type) {
  constexpr int dark_matter = 1;
  if (type.type != dark_matter || find_field(type, "smoothing_length") != nullptr) return;
  for (FieldInfo& field : type.fields) {
    if (field.file_name == "SubfindHsml") field.name = "smoothing_length";
  }
}

// Since SWIFT keeps there when a particle last formed stars.
bool GadgetHdf5Snapshot::has_times_for_rates(const FieldInfo& field) const {
  return is_swift_ && field.name == "star_formation_rate";
}

void GadgetHdf5Snapshot::note_negative_rates(const ParticleTypeInfo& type) {
  for (const FieldInfo& field : type.fields) {
    if (!has_times_for_rates(field)) continue;
    info_.notes.push_back(fmt::format("{} below 0 are no rates but times in SWIFT: they count as 0",
                                      field.file_name));
  }
}

// The table states no unit. Gadget 4's masses have the power of h that its positions state.
void GadgetHdf5Snapshot::name_unit_of_table_mass(const Hdf5File& file, ParticleTypeInfo& type) {
  const auto mass = std::find_if(type.fields.begin(), type.fields.end(),
                                 [](const FieldInfo& field) { return field.name == "mass"; });
  const FieldInfo* const position = find_field(type, "position");
  if (mass == type.fields.end() || position == nullptr) return;
  const auto hubble_power =
      file.number(fmt::format("/PartType{}/{}", type.type, position->file_name), "h_scaling");
  if (!hubble_power) return;
  UnitPowers powers;
  powers.mass = 1;
  powers.hubble = *hubble_power;
  mass->unit = unit_name(powers, read_base_units(file));
}

std::vector<Hdf5Values> GadgetHdf5Snapshot::find_parts(int type, const std::string& label) const {
  check_files_are_the_same(info_);
  std::vector<Hdf5Values> parts;
  for (const Hdf5Member& member : members_) {
    const Hdf5Field* const field = member.find_field(type, label);
    if (field != nullptr) parts.push_back({member.path, field->dataset});
  }
  return parts;
}

void GadgetHdf5Snapshot::choose_origin() {
  std::vector<Hdf5Values> positions;
  for (const ParticleTypeInfo& type : info_.types) {
    const FieldInfo* const field = find_field(type, "position");
    if (field == nullptr || field->values_per_particle != 3) return;  // will be refused
    for (Hdf5Values& part : find_parts(type.type, field->file_name)) {
      positions.push_back(std::move(part));
    }
  }
  origin_ = find_position_origin(positions);
}

// Values of one file in another unit would be another quantity.
void GadgetHdf5Snapshot::check_units(const std::vector<Hdf5Values>& parts) const {
  std::optional<std::string> first;
  for (const Hdf5Values& part : parts) {
    const Hdf5File file(part.file);
    const std::string unit = read_field_unit(file, part.dataset, read_units(file));
    if (!first) first = unit;
    if (unit == *first) continue;
    throw DataError(fmt::format(
        "{}: dataset {} is in \"{}\", but in \"{}\" in {}, expected one unit in all files of the "
        "snapshot; write them anew",
        part.file.string(), part.dataset.path, unit, *first,
        parts.front().file.filename().string()));
  }
}

Column GadgetHdf5Snapshot::read(int type, const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  const std::optional<double> table_mass = require_type(info_, type).table_mass;
  if (field.name == "mass" && table_mass) {
    return Column::uniform(static_cast<float>(*table_mass));
  }
  const auto parts = find_parts(type, field.file_name);
  if (parts.size() > 1) check_units(parts);
  if (field.name == "position") return read_column(parts, origin_);
  if (field.name == "smoothing_length") return read_column(parts, {}, smoothing_length_factor_);
  if (has_times_for_rates(field)) return at_least_zero(read_column(parts));
  return read_column(parts);
}

std::vector<std::uint64_t> GadgetHdf5Snapshot::read_ids(int type) const {
  const FieldInfo& field = require_ids(info_, type);
  auto ids = splotchcl::read_integers(find_parts(type, field.file_name));
  if (!ids) refuse_ids(info_, type, field);
  return std::move(*ids);
}

std::vector<std::uint64_t> GadgetHdf5Snapshot::read_integers(int type,
                                                             const std::string& name) const {
  const FieldInfo& field = require_field(info_, type, name);
  auto numbers = splotchcl::read_integers(find_parts(type, field.file_name));
  if (!numbers) refuse_integers(info_, type, field);
  return std::move(*numbers);
}

}  // namespace

std::unique_ptr<Snapshot> open_gadget_hdf5(const std::filesystem::path& path) {
  return std::make_unique<GadgetHdf5Snapshot>(path);
}

}  // namespace splotchcl
