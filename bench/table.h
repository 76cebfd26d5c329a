#pragma once

#include <string>
#include <vector>

namespace splotchcl::bench {

// Results, row by row: to be read on a terminal and to be plotted from a CSV file.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  // As many cells as columns.
  void add(std::vector<std::string> cells);
  std::string text() const;  // aligned, as Markdown has its tables
  // Appears under its name only when complete. Throws DataError.
  void write_csv(const std::string& path) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

std::string fixed(double value, int digits);
std::string scientific(double value);  // 1.2e-03
std::string milliseconds(double seconds);

}  // namespace splotchcl::bench
