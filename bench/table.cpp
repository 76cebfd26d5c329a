#include "table.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>

#include "splotchcl/error.h"

namespace splotchcl::bench {
namespace {

std::string format(const char* pattern, int digits, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), pattern, digits, value);
  return text;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    const bool quote = cell.find_first_of(",\"") != std::string::npos;
    std::string text;
    for (const char c : cell)
      text += c == '"' ? "\"\"" : std::string(1, c);
    line += (line.empty() ? "" : ",") + (quote ? '"' + text + '"' : text);
  }
  return line + "\n";
}

struct ColumnLayout {
  std::size_t width = 0;
  bool left = false;  // names to the left, numbers to the right
};

std::string aligned(const std::vector<std::string>& cells,
                    const std::vector<ColumnLayout>& layouts) {
  std::string line = "|";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string padding(layouts[i].width - cells[i].size(), ' ');
    line += ' ' + (layouts[i].left ? cells[i] + padding : padding + cells[i]) + " |";
  }
  return line + "\n";
}

std::string rule(const std::vector<ColumnLayout>& layouts) {
  std::string line = "|";
  for (const ColumnLayout& layout : layouts)
    line += std::string(layout.width + 1, '-') + (layout.left ? "-|" : ":|");
  return line + "\n";
}

}  // namespace

void Table::add(std::vector<std::string> cells) {
  if (cells.size() != columns_.size()) {
    throw Error("a table row has " + std::to_string(cells.size()) + " cells, expected " +
                std::to_string(columns_.size()));
  }
  rows_.push_back(std::move(cells));
}

std::string Table::text() const {
  std::vector<ColumnLayout> layouts;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    ColumnLayout layout{columns_[i].size(), true};
    for (const auto& row : rows_) {
      layout.width = std::max(layout.width, row[i].size());
      layout.left = layout.left && !row[i].empty() && std::isalpha(row[i][0]) != 0;
    }
    layouts.push_back(layout);
  }
  std::string text = aligned(columns_, layouts) + rule(layouts);
  for (const auto& row : rows_)
    text += aligned(row, layouts);
  return text;
}

void Table::write_csv(const std::string& path) const {
  const std::string unfinished = path + ".part";
  {
    std::ofstream file(unfinished);
    file << csv_line(columns_);
    for (const auto& row : rows_)
      file << csv_line(row);
    file.flush();
    if (!file) throw DataError(path + ": cannot be written; check the folder and its free space");
  }
  if (std::rename(unfinished.c_str(), path.c_str()) != 0) {
    throw DataError(path + ": cannot be put in place of " + unfinished);
  }
}

std::string fixed(double value, int digits) {
  return format("%.*f", digits, value);
}

std::string scientific(double value) {
  return format("%.*e", 1, value);
}

std::string milliseconds(double seconds) {
  return fixed(1e3 * seconds, 2);
}

}  // namespace splotchcl::bench
