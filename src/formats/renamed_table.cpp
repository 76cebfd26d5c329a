#include "formats/renamed_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/words.h"
#include "formats/table_names.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
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

}  // namespace splotchcl
