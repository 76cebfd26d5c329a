#include "formats/hdf5/units_of_columns.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "formats/hdf5/hdf5_units.h"
#include "formats/table_names.h"
#include "formats/text/table_header.h"

namespace splotchcl {
namespace {

// The group or dataset whose attributes are those of all axes.
std::string record_of(const std::string& component) {
  const std::size_t end = component.rfind('/');
  return end == std::string::npos || end == 0 ? "/" : component.substr(0, end);
}

// openPMD: how large the unit is in those of the SI, and what powers of these it has.
std::string unit_of_openpmd(const Hdf5File& file, const std::string& component) {
  const auto size = file.number(component, "unitSI");
  auto powers = file.numbers(component, "unitDimension");
  if (!powers) powers = file.numbers(record_of(component), "unitDimension");
  constexpr std::array<const char*, 7> names = {"m", "kg", "s", "A", "K", "mol", "cd"};
  if (!size || !(*size > 0) || !powers || powers->size() != names.size()) return {};
  std::string unit;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double power = (*powers)[i];
    if (power == 0) continue;
    unit += unit.empty() ? "" : " ";
    unit += power == 1 ? names[i] : fmt::format("{}^{}", names[i], power);
  }
  return unit.empty() || *size == 1 ? unit : fmt::format("{} {}", *size, unit);
}

// Of a position openPMD says what it is without saying the powers.
bool is_position_of_openpmd(const Hdf5Column& column) {
  return column.name.compare(0, 9, "position ") == 0;
}

std::string unit_of(const Hdf5File& file, const Hdf5Column& column, const UnitsOfFile& units) {
  std::string unit = read_unit_in_words(file, column.owner);
  if (unit.empty()) unit = unit_of_openpmd(file, column.owner);
  const auto size = file.number(column.owner, "unitSI");
  if (unit.empty() && is_position_of_openpmd(column) && size && *size > 0)
    unit = *size == 1 ? "m" : fmt::format("{} m", *size);
  if (!unit.empty() || column.terms.size() != 1) return unit;
  return read_field_unit(file, column.terms.front().dataset, units);
}

// astropy describes the columns of a table in lines of YAML, in a dataset beside it.
void add_units_of_astropy(const Hdf5File& file, const std::string& place,
                          const std::vector<Hdf5Column>& columns, std::vector<std::string>& units) {
  const std::string beside = place + ".__table_column_meta__";
  if (place.size() < 2 || !file.has(beside)) return;
  const std::vector<std::string> lines = file.lines(beside);
  std::vector<std::string> names;
  for (const Hdf5Column& column : columns)
    names.push_back(column.name);
  add_ecsv_units(std::vector<std::string_view>(lines.begin(), lines.end()), names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (units[i].empty()) units[i] = split_unit(names[i]).unit;
  }
}

}  // namespace

std::vector<std::string> units_of_columns(const Hdf5File& file, const std::string& place,
                                          const std::vector<Hdf5Column>& columns) {
  const UnitsOfFile of_file = read_units(file);
  std::vector<std::string> units;
  for (const Hdf5Column& column : columns)
    units.push_back(unit_of(file, column, of_file));
  add_units_of_astropy(file, place, columns, units);
  return units;
}

}  // namespace splotchcl
