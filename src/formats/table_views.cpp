#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "common/words.h"
#include "formats/table.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// A table with a last column of zeros.
class FlatTable : public Table {
 public:
  FlatTable(std::unique_ptr<const Table> table, std::string name)
      : table_(std::move(table)), columns_(table_->columns()) {
    columns_.push_back({std::move(name), 1});
  }
  const std::vector<TableColumn>& columns() const override { return columns_; }
  std::uint64_t rows() const override { return table_->rows(); }
  void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const override;
  bool is_single_precision(std::size_t column) const override {
    return is_zero(column) || table_->is_single_precision(column);
  }
  std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const override {
    if (!is_zero(column)) return table_->integers(column);
    return std::vector<std::uint64_t>(rows(), 0);
  }
  std::string place(std::size_t column) const override {
    return is_zero(column) ? std::string() : table_->place(column);
  }

 private:
  bool is_zero(std::size_t column) const { return column + 1 == columns_.size(); }

  std::unique_ptr<const Table> table_;
  std::vector<TableColumn> columns_;
};

void FlatTable::for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const {
  std::vector<TableValue> stored;
  std::vector<std::size_t> places;  // of the stored ones among the wanted
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (is_zero(wanted[i].column)) continue;
    stored.push_back(wanted[i]);
    places.push_back(i);
  }
  std::vector<double> values(wanted.size(), 0);
  table_->for_rows(stored, [&](const double* row) {
    for (std::size_t i = 0; i < places.size(); ++i)
      values[places[i]] = row[i];
    use(values.data());
  });
}

bool has_column(const std::vector<TableColumn>& columns, const std::string& name) {
  return std::any_of(columns.begin(), columns.end(), [&](const TableColumn& column) {
    return column.values_per_row == 1 && split_unit(column.name).name == name;
  });
}

}  // namespace

std::unique_ptr<const Table> with_flat_positions(std::unique_ptr<const Table> table,
                                                 std::vector<std::string>& notes) {
  const std::vector<TableColumn>& columns = table->columns();
  const auto first = find_positions(columns);
  if (!first || columns[*first].values_per_row != 1) return table;
  const std::string x = split_unit(columns[*first].name).name;
  const std::string y = with_axis(x, 1), z = with_axis(x, 2);
  if (!has_column(columns, y) || has_column(columns, z)) return table;
  notes.push_back(fmt::format("positions have {} and {} alone: {} is 0 for all", x, y, z));
  return std::make_unique<FlatTable>(std::move(table), z);
}

namespace {

// Columns of another table by other names, in another order.
class RenamedTable : public Table {
 public:
  // The first `named` columns have new names.
  RenamedTable(std::unique_ptr<const Table> table, std::vector<TableColumn> columns,
               std::vector<std::size_t> places, std::size_t named)
      : table_(std::move(table)),
        columns_(std::move(columns)),
        places_(std::move(places)),
        named_(named) {}
  const std::vector<TableColumn>& columns() const override { return columns_; }
  std::uint64_t rows() const override { return table_->rows(); }
  void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const override {
    std::vector<TableValue> stored = wanted;
    for (TableValue& value : stored)
      value.column = places_[value.column];
    table_->for_rows(stored, use);
  }
  bool is_single_precision(std::size_t column) const override {
    return table_->is_single_precision(places_[column]);
  }
  std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const override {
    return table_->integers(places_[column]);
  }
  std::string place(std::size_t column) const override {
    const std::string inner = table_->place(places_[column]);
    if (column >= named_ || !inner.empty()) return inner;
    return split_unit(table_->columns()[places_[column]].name).name;
  }

 private:
  std::unique_ptr<const Table> table_;
  std::vector<TableColumn> columns_;
  std::vector<std::size_t> places_;  // of the columns in the table
  std::size_t named_;
};

// As the file writes it, else but for upper and lower case; a number is that of a column without a
// name.
std::size_t place_of(const NamedColumn& wanted, const std::vector<TableColumn>& columns,
                     const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const TableColumn& column : columns)
    names.push_back(split_unit(column.name).name);
  for (const std::string& name : {wanted.source, "column_" + wanted.source}) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == name || columns[i].name == name) return i;
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (equal_ignoring_case(names[i], wanted.source)) return i;
  }
  throw UsageError(
      fmt::format("{}: read.columns: {} = \"{}\": found no such column, expected one of {}{}",
                  path.string(), wanted.name, wanted.source, fmt::join(names, ", "),
                  did_you_mean(nearest_name(wanted.source, names))));
}

}  // namespace

bool names_columns_anew(const std::vector<std::string>& wanted) {
  const auto is_new = [](const std::string& text) { return split_named_column(text).has_value(); };
  const auto count = std::count_if(wanted.begin(), wanted.end(), is_new);
  if (count == 0 || static_cast<std::size_t>(count) == wanted.size()) return count > 0;
  throw UsageError(fmt::format(
      "read.columns: found {} for some columns only, expected it for all, or names in their order",
      *std::find_if(wanted.begin(), wanted.end(), is_new)));
}

std::unique_ptr<const Table> with_new_names(std::unique_ptr<const Table> table,
                                            const std::vector<std::string>& wanted,
                                            const std::filesystem::path& path) {
  if (!names_columns_anew(wanted)) return table;
  const std::vector<TableColumn>& known = table->columns();
  std::vector<TableColumn> columns;
  std::vector<std::size_t> places;
  // Before all others, so that they count where others mean the same.
  for (const std::string& text : wanted) {
    const NamedColumn column = *split_named_column(text);
    places.push_back(place_of(column, known, path));
    const std::string unit = split_unit(known[places.back()].name).unit;
    const bool keeps_unit = !unit.empty() && split_unit(column.name).unit.empty();
    columns.push_back({keeps_unit ? column.name + " [" + unit + "]" : column.name,
                       known[places.back()].values_per_row});
  }
  const std::size_t named = places.size();
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string name = split_unit(known[i].name).name;
    const bool is_named =
        std::find(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(named), i) !=
            places.begin() + static_cast<std::ptrdiff_t>(named) ||
        std::any_of(
            columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(named),
            [&](const TableColumn& column) { return split_unit(column.name).name == name; });
    if (is_named) continue;
    columns.push_back(known[i]);
    places.push_back(i);
  }
  return std::make_unique<RenamedTable>(std::move(table), std::move(columns), std::move(places),
                                        named);
}

namespace {

struct Steps {
  std::size_t column = 0;
  std::string name;
  std::vector<double> values;  // in their order in time
};

// Whether a column of this name tells steps; others do where particles are there again and again.
bool tells_steps(const std::string& name) {
  constexpr std::array<const char*, 9> names = {"step",    "snapshot",  "snap",
                                                "snapnum", "snap_num",  "snapshot_number",
                                                "frame",   "iteration", "time"};
  return std::any_of(names.begin(), names.end(),
                     [&name](const char* known) { return equal_ignoring_case(name, known); });
}

bool may_tell_steps(const std::string& name) {
  constexpr std::array<const char*, 4> names = {"t", "redshift", "scale", "scale_factor"};
  return std::any_of(names.begin(), names.end(),
                     [&name](const char* known) { return equal_ignoring_case(name, known); });
}

template <class Is>
std::optional<std::size_t> find_column(const Table& table, Is&& is) {
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const TableColumn& column = table.columns()[i];
    if (column.values_per_row == 1 && is(split_unit(column.name).name)) return i;
  }
  return std::nullopt;
}

// Rising; none where they are too many for steps, or not numbers.
std::vector<double> different_values(const Table& table, std::size_t column) {
  constexpr std::size_t most = 100000;
  std::set<double> values;
  bool may_be_steps = true;
  table.for_rows({{column, 0}}, [&](const double* value) {
    may_be_steps = may_be_steps && std::isfinite(*value) && values.size() <= most;
    if (may_be_steps) values.insert(*value);
  });
  if (!may_be_steps) return {};
  return {values.begin(), values.end()};
}

bool are_ids(const std::string& name) {
  return canonical_field_name(name) == "id" || equal_ignoring_case(name, "pid") ||
         equal_ignoring_case(name, "particle_id");
}

enum class Particles { unknown, once, repeated };

// A table of a light cone says of each particle in which step it was, and has it once.
Particles find_repeated(const Table& table) {
  const auto column = find_column(table, are_ids);
  auto ids = column ? table.integers(*column) : std::nullopt;
  if (!ids) return Particles::unknown;
  std::sort(ids->begin(), ids->end());
  const bool are_different = std::adjacent_find(ids->begin(), ids->end()) == ids->end();
  return are_different ? Particles::once : Particles::repeated;
}

std::optional<Steps> find_steps_in_rows(const Table& table) {
  auto column = find_column(table, tells_steps);
  const bool is_sure = column.has_value();
  if (!is_sure) column = find_column(table, may_tell_steps);
  if (!column || (!is_sure && find_column(table, are_ids) == std::nullopt)) return std::nullopt;
  std::vector<double> values = different_values(table, *column);
  if (values.size() < 2 || table.rows() < 2 * values.size()) return std::nullopt;
  const Particles particles = find_repeated(table);
  if (particles == Particles::once || (!is_sure && particles == Particles::unknown))
    return std::nullopt;
  const std::string name = split_unit(table.columns()[*column].name).name;
  // Of redshifts the last in time is the lowest.
  if (equal_ignoring_case(name, "redshift")) std::reverse(values.begin(), values.end());
  return Steps{*column, name, std::move(values)};
}

std::string name_of(const Steps& steps, double value) {
  return fmt::format("{}={}", steps.name, value);
}

// The rows of another table with one value in a column.
class StepTable : public Table {
 public:
  StepTable(std::unique_ptr<const Table> table, const Steps& steps, double value)
      : table_(std::move(table)),
        column_(steps.column),
        value_(value),
        name_(name_of(steps, value)) {
    table_->for_rows({{column_, 0}}, [this](const double* of_row) { rows_ += *of_row == value_; });
  }
  const std::vector<TableColumn>& columns() const override { return table_->columns(); }
  std::uint64_t rows() const override { return rows_; }
  void for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const override {
    std::vector<TableValue> stored = wanted;
    stored.push_back({column_, 0});
    table_->for_rows(stored, [&](const double* row) {
      if (row[wanted.size()] == value_) use(row);
    });
  }
  bool is_single_precision(std::size_t column) const override {
    return table_->is_single_precision(column);
  }
  std::optional<std::vector<std::uint64_t>> integers(std::size_t column) const override;
  std::string place(std::size_t column) const override {
    const std::string name = split_unit(columns()[column].name).name, inner = table_->place(column);
    if (inner.empty() && !is_place_or_size(name)) return {};
    return name_ + "/" + (inner.empty() ? name : inner);
  }

 private:
  std::unique_ptr<const Table> table_;
  std::size_t column_;
  double value_;
  std::string name_;
  std::uint64_t rows_ = 0;
};

std::optional<std::vector<std::uint64_t>> StepTable::integers(std::size_t column) const {
  const auto all = table_->integers(column);
  if (!all) return std::nullopt;
  std::vector<std::uint64_t> own;
  auto next = all->begin();
  table_->for_rows({{column_, 0}}, [&](const double* value) {
    if (*value == value_ && next != all->end()) own.push_back(*next);
    if (next != all->end()) ++next;
  });
  return own;
}

[[noreturn]] void refuse_step(const std::string& wanted, const std::optional<Steps>& steps,
                              const SnapshotInfo& info) {
  throw DataError(
      steps ? fmt::format("{}: found no step {}, expected one of {} steps in time, {} to {}",
                          info.files.front().string(), wanted, steps->values.size(),
                          name_of(*steps, steps->values.front()),
                          name_of(*steps, steps->values.back()))
            : fmt::format("{}: found no steps in time in the table, so that {} is none of them; "
                          "give the path of the file",
                          info.files.front().string(), wanted));
}

// The wanted one; none for all.
std::optional<double> choose_step(const std::string& wanted, const std::optional<Steps>& steps,
                                  const SnapshotInfo& info) {
  const std::size_t equals = wanted.find('=');
  const bool is_of_column = steps && equals != std::string::npos &&
                            equal_ignoring_case(wanted.substr(0, equals), steps->name.c_str());
  if (!is_of_column) refuse_step(wanted, steps, info);
  const std::string text = wanted.substr(equals + 1);
  if (text == "all") return std::nullopt;
  const auto value = parse_number(text);
  const bool is_one = value && std::count(steps->values.begin(), steps->values.end(), *value) > 0;
  if (!is_one) refuse_step(wanted, steps, info);
  return value;
}

std::string note_on(const Steps& steps, const std::string& file) {
  const std::string first = name_of(steps, steps.values.front());
  return fmt::format(
      "the table has {} steps in time, {} to {}: the last is read; {}/{} as the snapshot is the "
      "first, and time.snapshots may list them; {}/{}=all draws all together",
      steps.values.size(), first, name_of(steps, steps.values.back()), file, first, file,
      steps.name);
}

}  // namespace

std::vector<std::string> steps_in(const Table& table) {
  std::vector<std::string> names;
  if (const auto steps = find_steps_in_rows(table)) {
    for (const double value : steps->values)
      names.push_back(name_of(*steps, value));
  }
  return names;
}

std::unique_ptr<const Table> with_one_step(std::unique_ptr<const Table> table,
                                           const std::string& wanted, SnapshotInfo& info) {
  const std::optional<Steps> steps = find_steps_in_rows(*table);
  if (wanted.empty() && !steps) return table;
  const std::optional<double> step =
      wanted.empty() ? std::optional(steps->values.back()) : choose_step(wanted, steps, info);
  if (!step) return table;
  if (wanted.empty()) info.notes.push_back(note_on(*steps, info.files.front().string()));
  if (equal_ignoring_case(steps->name, "time")) info.time = *step;
  if (equal_ignoring_case(steps->name, "redshift")) info.redshift = *step;
  return std::make_unique<StepTable>(std::move(table), *steps, *step);
}

GroupAndStep split_step(const std::string& group) {
  const std::size_t slash = group.rfind('/');
  const std::string last = slash == std::string::npos ? group : group.substr(slash + 1);
  if (last.find('=') == std::string::npos) return {group, ""};
  return {slash == std::string::npos ? "" : group.substr(0, slash), last};
}

}  // namespace splotchcl
