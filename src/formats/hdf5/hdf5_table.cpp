#include "formats/hdf5/hdf5_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/words.h"
#include "formats/hdf5/hdf5_column.h"
#include "formats/hdf5/hdf5_units.h"
#include "formats/table.h"
#include "formats/text/table_header.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::size_t most_listed = 40;

struct Source {
  std::string path;
  std::vector<std::string> parts;  // members or columns, apart by colons
};

bool holds_dataset(const Hdf5File& file, const std::string& path) {
  const std::size_t end = path.rfind('/');
  const std::string group = end == 0 ? "/" : path.substr(0, end);
  if (!file.has(path) || (group != "/" && !file.has(group))) return false;
  const std::vector<std::string> names = file.dataset_names(group);
  return std::find(names.begin(), names.end(), path.substr(end + 1)) != names.end();
}

std::string absolute(const std::string& group, const std::string& path) {
  const std::string trimmed_path = trimmed(path, "/ \t");
  return group.empty() ? "/" + trimmed_path : "/" + trimmed(group, "/") + "/" + trimmed_path;
}

// Names of datasets may have colons themselves.
std::optional<Source> find_source(const Hdf5File& file, const std::string& group,
                                  std::string text) {
  Source source;
  for (;;) {
    source.path = absolute(group, text);
    if (holds_dataset(file, source.path)) return source;
    // vaex's columns are groups of a dataset data.
    if (holds_dataset(file, source.path + "/data")) {
      source.path += "/data";
      return source;
    }
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return std::nullopt;
    source.parts.insert(source.parts.begin(), text.substr(colon + 1));
    text.resize(colon);
  }
}

[[noreturn]] void refuse_column(const Hdf5File& file, const NamedColumn& column,
                                const std::string& found, const std::string& expected) {
  throw UsageError(fmt::format("{}: read.columns: {} = \"{}\": found {}, expected {}",
                               file.path().string(), column.name, column.source, found, expected));
}

Hdf5Dataset member_of(const Hdf5File& file, const Hdf5Dataset& records, const std::string& name,
                      const NamedColumn& column) {
  std::vector<std::string> labels;
  for (const Hdf5Dataset& member : file.members(records)) {
    labels.push_back(member.label());
    if (labels.back() == name) return member;
  }
  refuse_column(file, column, "no such member of its records",
                fmt::format("one of {}{}", fmt::join(labels, ", "),
                            did_you_mean(nearest_name(name, labels))));
}

// Of a table: its longer side counts the particles.
void choose_column(const Hdf5File& file, Hdf5Dataset& dataset, std::uint64_t number,
                   const NamedColumn& column) {
  dataset.has_axes_first =
      dataset.member.empty() && dataset.shape.size() == 2 && dataset.shape[0] < dataset.shape[1];
  const std::uint64_t columns = dataset.shape.empty() ? 0 : dataset.stored_values_per_row();
  if (number < 1 || number > columns) {
    refuse_column(file, column, fmt::format("column {}", number),
                  fmt::format("a number from 1 to {}", columns));
  }
  dataset.column = number - 1;
}

Hdf5Dataset dataset_of(const Hdf5File& file, const std::string& group, const NamedColumn& column) {
  const std::optional<Source> source = find_source(file, group, column.source);
  if (!source) {
    const std::vector<std::string> contents = list_contents(file, most_listed);
    refuse_column(file, column, "no such dataset",
                  fmt::format("one of {}{}", fmt::join(contents, ", "),
                              contents.size() == most_listed ? ", ..." : ""));
  }
  Hdf5Dataset dataset = file.dataset(source->path);
  for (const std::string& part : source->parts) {
    const auto number = parse_whole_number(part);
    if (dataset.kind == Hdf5Dataset::Kind::records) {
      dataset = member_of(file, dataset, part, column);
    } else if (number && dataset.is_number() && !dataset.column) {
      choose_column(file, dataset, *number, column);
    } else {
      refuse_column(file, column, "no records in that dataset", "a column by its number");
    }
  }
  // Of shape (3, N).
  const bool has_axes_first = dataset.is_as_stored() && dataset.shape.size() == 2 &&
                              dataset.shape[0] == 3 && dataset.shape[1] > 3;
  dataset.has_axes_first = dataset.has_axes_first || has_axes_first;
  return dataset;
}

Hdf5Column read_column_named(const Hdf5File& file, const std::string& group,
                             const NamedColumn& column) {
  const Hdf5Dataset dataset = dataset_of(file, group, column);
  const std::uint64_t width = dataset.values_per_row();
  if (dataset.kind == Hdf5Dataset::Kind::records) {
    std::vector<std::string> labels;
    for (const Hdf5Dataset& member : file.members(dataset))
      labels.push_back(member.label());
    refuse_column(file, column, "records",
                  fmt::format("one of their members, as in \"{}:{}\": {}", column.source,
                              labels.empty() ? "x" : labels.front(), fmt::join(labels, ", ")));
  }
  if (!dataset.is_number() || dataset.shape.empty() || (width != 1 && width != 3)) {
    refuse_column(
        file, column,
        dataset.is_number()
            ? fmt::format("{} numbers in each row", dataset.shape.empty() ? 0 : width)
            : "no numbers",
        fmt::format("one or three in each row; \"{}:1\" is the first of several", column.source));
  }
  Hdf5Column found;
  found.name = column.name;
  found.owner = dataset.path;
  found.values = static_cast<int>(width);
  found.rows = dataset.rows();
  found.terms.push_back({dataset, 1});
  return found;
}

}  // namespace

std::vector<Hdf5Column> named_columns(const Hdf5File& file, const std::string& group,
                                      const std::vector<std::string>& wanted) {
  std::vector<Hdf5Column> columns;
  for (const std::string& text : wanted) {
    const std::optional<NamedColumn> column = split_named_column(text);
    if (!column) {
      throw UsageError(fmt::format(
          "{}: read.columns: found \"{}\", expected NAME=DATASET for each column of an HDF5 file, "
          "as in x=group/x; a member of records is DATASET:MEMBER",
          file.path().string(), text));
    }
    columns.push_back(read_column_named(file, group, *column));
  }
  return columns;
}

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

// The units that a file states for columns of one place in it, as attributes of each (units,
// openPMD's unitSI, those of Gadget and its relatives), or as astropy does beside a table. Empty
// where it states none.
std::vector<std::string> units_of_columns(const Hdf5File& file, const std::string& place,
                                          const std::vector<Hdf5Column>& columns) {
  const UnitsOfFile of_file = read_units(file);
  std::vector<std::string> units;
  for (const Hdf5Column& column : columns)
    units.push_back(unit_of(file, column, of_file));
  add_units_of_astropy(file, place, columns, units);
  return units;
}

// As netCDF keeps real numbers in few bits, and what stands for none.
void unpack(const Hdf5File& file, Hdf5Column& column) {
  for (Hdf5Column::Term& term : column.terms) {
    const std::string& path = term.dataset.path;
    for (const char* const name : {"_FillValue", "missing_value"}) {
      if (const auto value = file.number(path, name)) term.missing.push_back(*value);
    }
    if (term.dataset.kind != Hdf5Dataset::Kind::integer) continue;
    column.constant += term.factor * file.number(path, "add_offset").value_or(0);
    term.factor *= file.number(path, "scale_factor").value_or(1);
  }
}

// Some rows of the datasets that a column is made of.
struct ColumnPiece {
  std::vector<std::vector<double>> terms;

  ColumnPiece() = default;
  ColumnPiece(const Hdf5File& file, const Hdf5Column& column, std::uint64_t first,
              std::uint64_t rows) {
    for (const Hdf5Column::Term& term : column.terms) {
      terms.emplace_back(rows * term.dataset.values_per_row());
      file.read_rows(term.dataset, first, rows, terms.back().data());
    }
  }
  double value(const Hdf5Column& column, std::uint64_t place) const {
    double value = column.constant;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (column.terms[i].is_missing(terms[i][place]))
        return std::numeric_limits<double>::quiet_NaN();
      value += column.terms[i].factor * terms[i][place];
    }
    return column.is_as_stored() ? terms.front()[place] : value;
  }
};

std::vector<TableColumn> with_units(const std::vector<Hdf5Column>& columns,
                                    const std::vector<std::string>& units) {
  std::vector<TableColumn> named = names_of(columns);
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (units[i].empty() || !split_unit(named[i].name).unit.empty()) continue;
    named[i].name += " [" + units[i] + "]";
  }
  return named;
}

}  // namespace

bool Hdf5Column::Term::is_missing(double stored) const {
  return std::any_of(missing.begin(), missing.end(), [&](double value) {
    return stored == value || (dataset.is_single_precision() &&
                               static_cast<float>(stored) == static_cast<float>(value));
  });
}

Hdf5Table::Hdf5Table(const std::filesystem::path& path, const std::string& place,
                     std::vector<std::string>& notes)
    : path_(path) {
  const Hdf5File file(path);
  Hdf5Columns found = columns_in(file, place);
  columns_ = with_units(found.columns, units_of_columns(file, place, found.columns));
  sources_ = std::move(found.columns);
  for (Hdf5Column& source : sources_)
    unpack(file, source);
  if (const auto guessed = guess_positions(columns_)) {
    notes.push_back(fmt::format("dataset {} is taken for the positions", sources_[*guessed].owner));
    columns_[*guessed].name = "position";
  }
  keep_those_of_particles(found.others);
  if (!found.others.empty()) {
    notes.push_back(
        fmt::format("left out of {}, as they are not one or three numbers for each of {} "
                    "particles: {}",
                    place, rows_, fmt::join(found.others, ", ")));
  }
}

Hdf5Table::Hdf5Table(const std::filesystem::path& path, std::vector<Hdf5Column> named)
    : path_(path), is_named_(true) {
  const Hdf5File file(path);
  columns_ = with_units(named, units_of_columns(file, "", named));
  sources_ = std::move(named);
  for (Hdf5Column& source : sources_)
    unpack(file, source);
  rows_ = sources_.front().rows.value_or(0);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (sources_[i].rows == rows_) continue;
    throw UsageError(fmt::format(
        "{}: read.columns names {} with {} rows and {} with {}, expected columns of one length",
        path.string(), sources_.front().name, rows_, sources_[i].name, *sources_[i].rows));
  }
}

void Hdf5Table::keep_those_of_particles(std::vector<std::string>& left_out) {
  if (const auto positions = find_positions(columns_))
    rows_ = sources_[*positions].rows.value_or(0);
  std::vector<TableColumn> columns;
  std::vector<Hdf5Column> sources;
  std::vector<std::string> others;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const std::vector<Hdf5Column::Term>& terms = sources_[i].terms;
    const bool are_rows = std::all_of(
        terms.begin(), terms.end(), [&](const auto& term) { return term.dataset.rows() == rows_; });
    if (!are_rows || sources_[i].rows.value_or(rows_) != rows_) {
      others.push_back(sources_[i].name);
      continue;
    }
    columns.push_back(columns_[i]);
    sources.push_back(std::move(sources_[i]));
  }
  columns_ = std::move(columns);
  sources_ = std::move(sources);
  refuse_lost_axis(others);
  left_out.insert(left_out.end(), others.begin(), others.end());
}

void Hdf5Table::refuse_lost_axis(const std::vector<std::string>& others) const {
  const std::string axis = lost_axis(columns_, others);
  if (axis.empty()) return;
  throw DataError(fmt::format(
      "{}: {} has not the {} rows of the other axes of the positions; the file is damaged, or say "
      "by read.columns which datasets belong together",
      path_.string(), axis, rows_));
}

bool Hdf5Table::is_single_precision(std::size_t column) const {
  const Hdf5Column& source = sources_[column];
  if (source.terms.empty())
    return static_cast<double>(static_cast<float>(source.constant)) == source.constant;
  return source.is_as_stored() && source.terms.front().dataset.is_single_precision();
}

std::uint64_t Hdf5Table::rows_at_a_time(const Hdf5File& file,
                                        const std::vector<TableValue>& wanted) const {
  constexpr std::uint64_t of_constants = 1U << 20;
  std::uint64_t rows = std::max<std::uint64_t>(1, std::min(rows_, of_constants));
  for (const TableValue& value : wanted) {
    for (const Hdf5Column::Term& term : sources_[value.column].terms) {
      file.check_complete(term.dataset);
      rows = std::min(rows, file.rows_per_piece(term.dataset));
    }
  }
  return rows;
}

void Hdf5Table::for_rows(const std::vector<TableValue>& wanted, const UseRow& use) const {
  const Hdf5File file(path_);
  const std::uint64_t piece = rows_at_a_time(file, wanted);
  std::map<std::size_t, ColumnPiece> pieces;  // of each column
  std::vector<double> values(wanted.size());
  for (std::uint64_t first = 0; first < rows_; first += piece) {
    const std::uint64_t rows = std::min(piece, rows_ - first);
    pieces.clear();
    for (const TableValue& value : wanted) {
      if (pieces.count(value.column) > 0) continue;
      pieces.emplace(value.column, ColumnPiece(file, sources_[value.column], first, rows));
    }
    for (std::uint64_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Hdf5Column& source = sources_[wanted[i].column];
        const std::uint64_t place = row * static_cast<std::uint64_t>(source.values) +
                                    static_cast<std::uint64_t>(wanted[i].axis);
        values[i] = pieces[wanted[i].column].value(source, place);
      }
      use(values.data());
    }
  }
}

std::string Hdf5Table::place(std::size_t column) const {
  const Hdf5Column& source = sources_[column];
  if (!is_named_ && !is_place_or_size(split_unit(columns_[column].name).name)) return {};
  const bool is_at_root = source.owner.rfind('/') == 0;
  if (source.terms.empty() || (is_at_root && !is_named_)) return {};
  const Hdf5Dataset& dataset = source.terms.front().dataset;
  std::string place = dataset.path.substr(1);
  for (const std::string& member : dataset.member)
    place += ":" + member;
  if (dataset.column) place += fmt::format(":{}", *dataset.column + 1);
  return place;
}

// yt keeps identifiers as doubles: they are whole numbers as far as doubles have all of these.
std::optional<std::vector<std::uint64_t>> Hdf5Table::integers(std::size_t column) const {
  const Hdf5Column& source = sources_[column];
  if (source.is_as_stored() && source.terms.front().dataset.kind == Hdf5Dataset::Kind::integer) {
    return read_integers({{path_, source.terms.front().dataset}});
  }
  constexpr double largest = 9007199254740992.0;
  std::vector<std::uint64_t> numbers;
  bool are_whole = true;
  for_rows({{column, 0}}, [&](const double* value) {
    const bool is_whole = *value >= 0 && *value <= largest && *value == std::floor(*value);
    are_whole = are_whole && is_whole;
    numbers.push_back(is_whole ? static_cast<std::uint64_t>(*value) : 0);
  });
  return are_whole ? std::optional(std::move(numbers)) : std::nullopt;
}

}  // namespace splotchcl
