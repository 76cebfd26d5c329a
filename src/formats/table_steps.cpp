#include "formats/table_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "common/words.h"
#include "formats/table_names.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
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
