#include "formats/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "formats/stored_values.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct TableField {
  FieldInfo info;
  std::vector<TableValue> values;  // one, or three
  std::vector<double> factors;     // what these are multiplied by, to be in the field's unit

  bool is_converted() const {
    return std::any_of(factors.begin(), factors.end(), [](double factor) { return factor != 1; });
  }
};

// The unit of each field in all types, by the field's name.
using UnitsOfFields = std::map<std::string, std::string>;

// A table, and the fields that its columns are.
class FieldTable {
 public:
  // `info` is what is known of the snapshot, and takes notes.
  FieldTable(std::unique_ptr<const Table> table, SnapshotInfo& info);

  const Table& table() const { return *table_; }
  const std::vector<NameAndUnit>& names() const { return names_; }
  ParticleTypeInfo describe(int type) const;
  // Where fields of a type have another unit than the types before it, or sizes another than
  // positions: to that one.
  void convert_to(UnitsOfFields& units, int type, SnapshotInfo& info);
  const TableField& field_of(const FieldInfo& info) const;
  // Calls use(values) for the positions of some rows, in increasing order.
  template <class Use>
  void for_ranges(const TableField& positions, const std::vector<SampleRange>& ranges,
                  Use&& use) const;
  bool is_single_precision(const TableField& field) const;

 private:
  std::optional<std::size_t> find_column(const std::string& name) const;
  std::optional<TableField> find_vector(std::size_t first, std::vector<bool>& used,
                                        SnapshotInfo& info) const;
  std::vector<double> factors_of_axes(const TableField& field, SnapshotInfo& info) const;
  std::vector<bool> find_repeated(SnapshotInfo& info) const;
  void find_fields(SnapshotInfo& info);
  void name_table_fields(SnapshotInfo& info);
  void tell_places();

  std::unique_ptr<const Table> table_;
  std::vector<NameAndUnit> names_;
  std::vector<TableField> fields_;
};

FieldTable::FieldTable(std::unique_ptr<const Table> table, SnapshotInfo& info)
    : table_(std::move(table)) {
  for (const TableColumn& column : table_->columns())
    names_.push_back(split_unit(as_utf8(column.name)));
  find_fields(info);
  name_table_fields(info);
  tell_places();
}

std::optional<std::size_t> FieldTable::find_column(const std::string& name) const {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (names_[i].name == name && table_->columns()[i].values_per_row == 1) return i;
  }
  return std::nullopt;
}

// The vector that begins with this column, if its other two axes are there.
std::optional<TableField> FieldTable::find_vector(std::size_t first, std::vector<bool>& used,
                                                  SnapshotInfo& info) const {
  const std::string& name = names_[first].name;
  const std::string vector = vector_name(name);
  if (vector.empty() || table_->columns()[first].values_per_row != 1) return std::nullopt;
  TableField field;
  std::string file_name;
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = find_column(with_axis(name, axis));
    if (!column || used[*column]) return std::nullopt;
    field.values.push_back({*column, 0});
    file_name += (axis > 0 ? "," : "") + names_[*column].name;
  }
  for (const TableValue& value : field.values)
    used[value.column] = true;
  field.info = {vector, file_name, 3, ""};
  for (const TableValue& value : field.values) {
    if (field.info.unit.empty()) field.info.unit = names_[value.column].unit;
  }
  field.factors = factors_of_axes(field, info);
  return field;
}

// A vector has one unit, that of the first axis that names one.
std::vector<double> FieldTable::factors_of_axes(const TableField& field, SnapshotInfo& info) const {
  std::vector<double> factors;
  for (const TableValue& value : field.values) {
    const auto& [name, unit] = names_[value.column];
    const auto factor = unit_ratio(unit, field.info.unit, unit_factors(info));
    if (!factor) {
      throw DataError(fmt::format(
          "{}: the columns {} are a vector, but {} is in \"{}\" and others in \"{}\", expected "
          "units that can be compared: give them one unit",
          info.files.front().string(), field.info.file_name, name, unit, field.info.unit));
    }
    if (*factor != 1)
      info.notes.push_back(
          fmt::format("{} is converted from {} to {}, the unit of the other axes of {}", name, unit,
                      field.info.unit, field.info.file_name));
    factors.push_back(*factor);
  }
  return factors;
}

void FieldTable::convert_to(UnitsOfFields& units, int type, SnapshotInfo& info) {
  const auto to_common = [&](TableField& field, const std::string& name) {
    std::string& unit = units[name];
    // A size tells nothing of positions without a unit.
    if (unit.empty() && name == field.info.name) unit = field.info.unit;
    if (unit.empty() || field.info.unit.empty() || field.info.unit == unit) return;
    const auto factor = unit_ratio(field.info.unit, unit, unit_factors(info));
    if (!factor || *factor == 1) return;  // what cannot be compared is left as it is
    info.notes.push_back(fmt::format("{} of type {} is converted from {} to {}", field.info.name,
                                     type, field.info.unit, unit));
    for (double& value_factor : field.factors)
      value_factor *= *factor;
    field.info.unit = unit;
  };
  // First: sizes are converted to the unit of positions.
  for (TableField& field : fields_) {
    if (field.info.name == "position") to_common(field, field.info.name);
  }
  for (TableField& field : fields_)
    to_common(field, field.info.name == "smoothing_length" ? "position" : field.info.name);
}

// Columns with the name of one before them.
std::vector<bool> FieldTable::find_repeated(SnapshotInfo& info) const {
  std::vector<bool> repeated(names_.size(), false);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const auto own = names_.begin() + static_cast<std::ptrdiff_t>(i);
    repeated[i] = std::any_of(names_.begin(), own, [&](const NameAndUnit& before) {
      return !before.name.empty() && before.name == own->name;
    });
    if (!repeated[i]) continue;
    info.notes.push_back(fmt::format("column {} left out, as it has the name of an earlier one, {}",
                                     i + 1, own->name));
  }
  return repeated;
}

void FieldTable::find_fields(SnapshotInfo& info) {
  std::vector<bool> used = find_repeated(info);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (used[i]) continue;
    if (auto vector = find_vector(i, used, info)) fields_.push_back(std::move(*vector));
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (used[i] || names_[i].name.empty()) continue;
    const int width = table_->columns()[i].values_per_row;
    TableField field;
    field.info = {"", names_[i].name, width, names_[i].unit};
    for (int axis = 0; axis < width; ++axis)
      field.values.push_back({i, axis});
    field.factors.assign(field.values.size(), 1);
    fields_.push_back(std::move(field));
  }
}

// A vector of three columns has its name already.
void FieldTable::name_table_fields(SnapshotInfo& info) {
  std::vector<FieldInfo> infos;
  for (const TableField& field : fields_)
    infos.push_back(field.info);
  const std::vector<std::string> names = names_of_fields(infos);
  std::vector<TableField> named;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    // Beside x, y and z a column "position" cannot be told from these by a name.
    const auto own = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (const auto first = std::find(names.begin(), own, names[i]); first != own) {
      const auto taken = static_cast<std::size_t>(first - names.begin());
      info.notes.push_back(
          fmt::format("column {} left out, as the field {} is {}; give it another name",
                      fields_[i].info.file_name, names[i], infos[taken].file_name));
      continue;
    }
    named.push_back(std::move(fields_[i]));
    named.back().info.name = names[i];
  }
  fields_ = std::move(named);
}

// What is kept beside a file for one place in it must not be taken for another.
void FieldTable::tell_places() {
  for (TableField& field : fields_) {
    std::vector<std::string> places, names;
    for (const TableValue& value : field.values) {
      places.push_back(table_->place(value.column));
      names.push_back(places.back().empty() ? names_[value.column].name : places.back());
    }
    const bool is_told = std::any_of(places.begin(), places.end(),
                                     [](const std::string& place) { return !place.empty(); });
    names.erase(std::unique(names.begin(), names.end()), names.end());
    if (is_told) field.info.file_name = fmt::format("{}", fmt::join(names, ","));
  }
}

ParticleTypeInfo FieldTable::describe(int type) const {
  ParticleTypeInfo info;
  info.type = type;
  info.count = table_->rows();
  for (const TableField& field : fields_)
    info.fields.push_back(field.info);
  return info;
}

const TableField& FieldTable::field_of(const FieldInfo& info) const {
  return *std::find_if(fields_.begin(), fields_.end(),
                       [&](const TableField& field) { return field.info.name == info.name; });
}

template <class Use>
void FieldTable::for_ranges(const TableField& positions, const std::vector<SampleRange>& ranges,
                            Use&& use) const {
  std::uint64_t row = 0;
  auto range = ranges.begin();
  table_->for_rows(positions.values, [&](const double* values) {
    while (range != ranges.end() && row >= range->first + range->count)
      ++range;
    if (range != ranges.end() && row >= range->first) use(values);
    ++row;
  });
}

bool FieldTable::is_single_precision(const TableField& field) const {
  return !field.is_converted() &&
         std::all_of(field.values.begin(), field.values.end(), [this](const TableValue& value) {
           return table_->is_single_precision(value.column);
         });
}

class TableSnapshot : public Snapshot {
 public:
  TableSnapshot(TablesByType tables, SnapshotInfo info);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;
  std::vector<std::uint64_t> read_integers(int type, const std::string& field) const override;
  Vec3 position_origin() const override;

 private:
  void check_positions(const ParticleTypeInfo& type) const;
  const TableField& positions_of(int type) const;
  bool are_positions_single() const;
  Vec3 find_origin() const;

  std::map<int, FieldTable> tables_;
  SnapshotInfo info_;
  mutable std::once_flag origin_is_known_;
  mutable Vec3 origin_ = {{0, 0, 0}};
};

TableSnapshot::TableSnapshot(TablesByType tables, SnapshotInfo info) : info_(std::move(info)) {
  info_.files_mark = hash_of_files(info_).value();
  UnitsOfFields units;
  for (auto& [type, table] : tables) {
    FieldTable& added = tables_.emplace(type, FieldTable(std::move(table), info_)).first->second;
    added.convert_to(units, type, info_);
    info_.types.push_back(added.describe(type));
    check_positions(info_.types.back());
  }
  info_.velocity_doubt =
      "a table does not tell its units, nor whether its time is the scale factor";
}

void TableSnapshot::check_positions(const ParticleTypeInfo& type) const {
  const FieldInfo* const position = find_field(type, "position");
  if (position != nullptr && position->values_per_particle == 3) return;
  std::vector<std::string> names;
  for (const NameAndUnit& column : tables_.at(type.type).names())
    names.push_back(column.name);
  throw DataError(fmt::format(
      "{}: no positions: {}; expected x, y and z: name the columns in their order, as in "
      "read.columns = [\"x\", \"y\", \"z\", \"mass\"], or each anew, as in read.columns = {{x = "
      "\"column\"}}",
      info_.files.front().string(),
      names.empty() && !info_.notes.empty()
          ? info_.notes.back()
          : fmt::format("its columns are {}", fmt::join(names, ", "))));
}

const TableField& TableSnapshot::positions_of(int type) const {
  return tables_.at(type).field_of(require_field(info_, type, "position"));
}

bool TableSnapshot::are_positions_single() const {
  return std::all_of(tables_.begin(), tables_.end(), [this](const auto& of_type) {
    return of_type.second.is_single_precision(positions_of(of_type.first));
  });
}

Vec3 TableSnapshot::find_origin() const {
  std::vector<std::uint64_t> sizes;
  for (const ParticleTypeInfo& type : info_.types)
    sizes.push_back(type.count);
  const std::vector<SampleRange> ranges = sample_ranges(sizes);
  std::vector<std::array<double, 3>> sample;
  for (std::size_t part = 0; part < sizes.size(); ++part) {
    const int type = info_.types[part].type;
    std::vector<SampleRange> of_part;
    std::copy_if(ranges.begin(), ranges.end(), std::back_inserter(of_part),
                 [part](const SampleRange& range) { return range.part == part; });
    const TableField& positions = positions_of(type);
    const std::vector<double>& factors = positions.factors;
    tables_.at(type).for_ranges(positions, of_part, [&](const double* values) {
      sample.push_back({factors[0] * values[0], factors[1] * values[1], factors[2] * values[2]});
    });
  }
  return choose_position_origin(sample);
}

// Text has to be read for it, so not before it is asked for. Stored floats are taken as they are.
Vec3 TableSnapshot::position_origin() const {
  std::call_once(origin_is_known_, [this] {
    if (!are_positions_single()) origin_ = find_origin();
  });
  return origin_;
}

Column TableSnapshot::read(int type, const std::string& name) const {
  const FieldInfo& info = require_field(info_, type, name);
  const FieldTable& table = tables_.at(type);
  const TableField& field = table.field_of(info);
  const Vec3 origin = info.name == "position" ? position_origin() : Vec3{{0, 0, 0}};
  const bool is_vector = field.values.size() == 3;
  std::vector<float> values;
  table.table().for_rows(field.values, [&](const double* row) {
    // Not before the table has seen that the rows are all there.
    if (values.empty()) values.reserve(table.table().rows() * field.values.size());
    for (std::size_t axis = 0; axis < field.values.size(); ++axis) {
      values.push_back(
          static_cast<float>(field.factors[axis] * row[axis] - (is_vector ? origin.a[axis] : 0)));
    }
  });
  return Column::owning(std::move(values));
}

std::vector<std::uint64_t> TableSnapshot::read_ids(int type) const {
  const FieldInfo& info = require_ids(info_, type);
  const FieldTable& table = tables_.at(type);
  const TableField& field = table.field_of(info);
  if (field.values.size() != 1) refuse_ids(info_, type, info);
  auto ids = table.table().integers(field.values.front().column);
  if (!ids) refuse_ids(info_, type, info);
  return std::move(*ids);
}

std::vector<std::uint64_t> TableSnapshot::read_integers(int type, const std::string& name) const {
  const FieldInfo& info = require_field(info_, type, name);
  const FieldTable& table = tables_.at(type);
  const TableField& field = table.field_of(info);
  if (field.values.size() != 1) refuse_integers(info_, type, info);
  if (auto numbers = table.table().integers(field.values.front().column)) {
    return std::move(*numbers);
  }
  // Those below zero, and whole numbers among reals.
  std::vector<std::uint64_t> numbers;
  table.table().for_rows(field.values, [&](const double* value) {
    constexpr double largest = 9007199254740992.0;  // beyond 2^53 a double is not exact
    const bool is_whole = std::abs(*value) <= largest && *value == std::floor(*value);
    if (!is_whole) refuse_integers(info_, type, info);
    numbers.push_back(static_cast<std::uint64_t>(static_cast<std::int64_t>(*value)));
  });
  return numbers;
}

}  // namespace

std::unique_ptr<Snapshot> make_table_snapshot(std::unique_ptr<const Table> table,
                                              SnapshotInfo info) {
  TablesByType tables;
  tables.emplace(0, std::move(table));
  return make_table_snapshot(std::move(tables), std::move(info));
}

std::unique_ptr<Snapshot> make_table_snapshot(TablesByType tables, SnapshotInfo info) {
  return std::make_unique<TableSnapshot>(std::move(tables), std::move(info));
}

}  // namespace splotchcl
