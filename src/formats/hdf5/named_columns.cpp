#include "formats/hdf5/named_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "common/words.h"
#include "formats/table_names.h"
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

}  // namespace splotchcl
