#include "formats/flat_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "formats/table_names.h"

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

}  // namespace splotchcl
