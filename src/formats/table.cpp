#include "formats/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "formats/position_origin.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct TableField {
  FieldInfo info;
  std::vector<TableValue> values;  // one, or three
};

std::string trimmed(const std::string& text, const char* what = " \t_.-") {
  const std::size_t first = text.find_first_not_of(what);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(what) - first + 1);
}

struct NameAndUnit {
  std::string name, unit;
};

// "x [kpc]" is x in kpc.
NameAndUnit split_unit(const std::string& text) {
  for (const char* brackets : {"[]", "()"}) {
    const std::size_t open = text.find(brackets[0]);
    if (open == std::string::npos || open == 0 || text.back() != brackets[1]) continue;
    const std::string name = trimmed(text.substr(0, open), " \t");
    if (name.empty()) continue;
    return {name, trimmed(text.substr(open + 1, text.size() - open - 2), " \t")};
  }
  return {text, ""};
}

// The vector whose first axis a column of this name is: "" where it is none. Otherwise the
// names of the three columns differ in their last letter only.
std::string vector_name(const std::string& column) {
  if (column.empty() || (column.back() != 'x' && column.back() != 'X')) return {};
  const std::string stem = trimmed(column.substr(0, column.size() - 1));
  if (stem.empty()) return "position";
  if (equal_ignoring_case(stem, "v")) return "velocity";
  if (equal_ignoring_case(stem, "a")) return "acceleration";
  if (equal_ignoring_case(stem, "b")) return "magnetic_field";
  const std::string canonical = canonical_field_name(stem);
  return canonical.empty() ? stem : canonical;
}

std::string with_axis(std::string column, int axis) {
  const bool is_upper = column.back() == 'X';
  column.back() = static_cast<char>((is_upper ? 'X' : 'x') + axis);
  return column;
}

class TableSnapshot : public Snapshot {
 public:
  TableSnapshot(std::unique_ptr<const Table> table, SnapshotInfo info);

  const SnapshotInfo& info() const override { return info_; }
  Column read(int type, const std::string& field) const override;
  std::vector<std::uint64_t> read_ids(int type) const override;
  Vec3 position_origin() const override;

 private:
  std::optional<std::size_t> find_column(const std::string& name) const;
  std::optional<TableField> find_vector(std::size_t first, std::vector<bool>& used) const;
  void find_fields();
  void check_positions() const;
  const TableField& field_of(const FieldInfo& info) const;

  std::unique_ptr<const Table> table_;
  std::vector<NameAndUnit> names_;
  std::vector<TableField> fields_;
  SnapshotInfo info_;
  mutable std::once_flag origin_is_known_;
  mutable Vec3 origin_ = {{0, 0, 0}};
};

TableSnapshot::TableSnapshot(std::unique_ptr<const Table> table, SnapshotInfo info)
    : table_(std::move(table)), info_(std::move(info)) {
  for (const TableColumn& column : table_->columns())
    names_.push_back(split_unit(column.name));
  find_fields();
  check_positions();
  info_.velocity_doubt =
      "a table does not tell its units, nor whether its time is the scale factor";
}

std::optional<std::size_t> TableSnapshot::find_column(const std::string& name) const {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (names_[i].name == name && table_->columns()[i].values_per_row == 1) return i;
  }
  return std::nullopt;
}

// The vector that begins with this column, if its other two axes are there.
std::optional<TableField> TableSnapshot::find_vector(std::size_t first,
                                                     std::vector<bool>& used) const {
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
  field.info = {vector, file_name, 3, names_[first].unit};
  return field;
}

void TableSnapshot::find_fields() {
  std::vector<bool> used(names_.size(), false);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (used[i]) continue;
    if (auto vector = find_vector(i, used)) fields_.push_back(std::move(*vector));
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (used[i] || names_[i].name.empty()) continue;
    const int width = table_->columns()[i].values_per_row;
    TableField field;
    field.info = {"", names_[i].name, width, names_[i].unit};
    for (int axis = 0; axis < width; ++axis)
      field.values.push_back({i, axis});
    fields_.push_back(std::move(field));
  }
  ParticleTypeInfo type;
  type.count = table_->rows();
  for (const TableField& field : fields_)
    type.fields.push_back(field.info);
  // A vector of three columns has its name already; where two fields mean the same quantity,
  // the second keeps that of the file.
  std::vector<std::string> taken;
  for (FieldInfo& field : type.fields) {
    std::string name = field.name.empty() ? canonical_field_name(field.file_name) : field.name;
    const bool is_new = !name.empty() && std::find(taken.begin(), taken.end(), name) == taken.end();
    field.name = is_new ? name : field.file_name;
    taken.push_back(field.name);
  }
  for (std::size_t i = 0; i < fields_.size(); ++i)
    fields_[i].info = type.fields[i];
  info_.types.push_back(std::move(type));
}

void TableSnapshot::check_positions() const {
  const FieldInfo* const position = find_field(info_.types.front(), "position");
  if (position != nullptr && position->values_per_particle == 3) return;
  std::vector<std::string> names;
  for (const NameAndUnit& column : names_)
    names.push_back(column.name);
  throw DataError(fmt::format(
      "{}: no positions: its columns are {}; expected x, y and z: name the columns in their order, "
      "as in read.columns = [\"x\", \"y\", \"z\", \"mass\"]",
      info_.files.front().string(), fmt::join(names, ", ")));
}

const TableField& TableSnapshot::field_of(const FieldInfo& info) const {
  return *std::find_if(fields_.begin(), fields_.end(),
                       [&](const TableField& field) { return field.info.name == info.name; });
}

// Text has to be read for it, so not before it is asked for.
Vec3 TableSnapshot::position_origin() const {
  std::call_once(origin_is_known_, [this] {
    const std::vector<SampleRange> ranges = sample_ranges({table_->rows()});
    std::vector<std::array<double, 3>> sample;
    std::uint64_t row = 0;
    auto range = ranges.begin();
    const FieldInfo& position = require_field(info_, 0, "position");
    table_->for_rows(field_of(position).values, [&](const double* values) {
      while (range != ranges.end() && row >= range->first + range->count)
        ++range;
      if (range != ranges.end() && row >= range->first) {
        sample.push_back({values[0], values[1], values[2]});
      }
      ++row;
    });
    origin_ = choose_position_origin(sample);
  });
  return origin_;
}

Column TableSnapshot::read(int type, const std::string& name) const {
  const FieldInfo& info = require_field(info_, type, name);
  const TableField& field = field_of(info);
  const Vec3 origin = info.name == "position" ? position_origin() : Vec3{{0, 0, 0}};
  const bool is_vector = field.values.size() == 3;
  std::vector<float> values;
  values.reserve(table_->rows() * field.values.size());
  table_->for_rows(field.values, [&](const double* row) {
    for (std::size_t axis = 0; axis < field.values.size(); ++axis) {
      values.push_back(static_cast<float>(row[axis] - (is_vector ? origin.a[axis] : 0)));
    }
  });
  return Column::owning(std::move(values));
}

std::vector<std::uint64_t> TableSnapshot::read_ids(int type) const {
  const FieldInfo& info = require_ids(info_, type);
  const TableField& field = field_of(info);
  if (field.values.size() != 1) refuse_ids(info_, type, info);
  auto ids = table_->integers(field.values.front().column);
  if (!ids) refuse_ids(info_, type, info);
  return std::move(*ids);
}

}  // namespace

std::unique_ptr<Snapshot> make_table_snapshot(std::unique_ptr<const Table> table,
                                              SnapshotInfo info) {
  return std::make_unique<TableSnapshot>(std::move(table), std::move(info));
}

}  // namespace splotchcl
