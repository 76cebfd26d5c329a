#include "formats/hdf5/gadget_hdf5_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::string group_name(std::size_t type) {
  return fmt::format("PartType{}", type);
}

const char* columns_of(const Hdf5Dataset& dataset) {
  if (dataset.kind == Hdf5Dataset::Kind::other) return "columns that are no numbers";
  return dataset.values_per_row() == 1 ? "column" : "columns";
}

[[noreturn]] void throw_no_positions(const Hdf5File& file, const std::string& group,
                                     std::uint64_t count,
                                     const std::vector<Hdf5Dataset>& datasets) {
  std::vector<std::string> labels;
  for (const Hdf5Dataset& dataset : datasets) {
    const bool are_positions = canonical_field_name(dataset.label()) == "position";
    labels.push_back(are_positions ? fmt::format("{} of {} {}", dataset.label(),
                                                 dataset.values_per_row(), columns_of(dataset))
                                   : dataset.label());
  }
  throw DataError(fmt::format(
      "{}: no positions: the header counts {} particles of {}, which has {}; expected a dataset "
      "Coordinates with three columns of numbers: the file is incomplete, or no snapshot",
      file.path().string(), count, group,
      labels.empty() ? "no datasets" : fmt::format("only {}", fmt::join(labels, ", "))));
}

// The positions of a type; null where it has none.
const Hdf5Dataset* find_positions(const std::vector<Hdf5Dataset>& datasets) {
  const auto found = std::find_if(datasets.begin(), datasets.end(), [](const Hdf5Dataset& dataset) {
    return canonical_field_name(dataset.label()) == "position" &&
           dataset.kind != Hdf5Dataset::Kind::other && !dataset.shape.empty() &&
           dataset.values_per_row() == 3;
  });
  return found == datasets.end() ? nullptr : &*found;
}

bool have_rows(const std::vector<Hdf5Dataset>& datasets) {
  return std::any_of(datasets.begin(), datasets.end(), [](const Hdf5Dataset& dataset) {
    return !dataset.shape.empty() && dataset.rows() > 0;
  });
}

void set_count(GadgetHeader& header, std::size_t type, std::uint64_t count) {
  const std::size_t types = std::max(header.counts.size(), type + 1);
  header.counts.resize(types, 0);
  header.total_counts.resize(types, 0);
  header.total_counts_high.resize(types, 0);
  header.table_masses.resize(types, 0);
  header.counts[type] = count;
}

void leave_out(GadgetHeader& header, std::size_t type) {
  if (type >= header.counts.size()) return;
  header.counts[type] = header.total_counts[type] = header.total_counts_high[type] = 0;
}

std::vector<Hdf5Dataset> datasets_of(const Hdf5File& file, const std::string& group) {
  return file.has(group) ? file.datasets(group) : std::vector<Hdf5Dataset>();
}

constexpr std::size_t more_types_than_any_code = 32;

}  // namespace

void count_rows_without_header(const Hdf5File& file, GadgetHeader& header,
                               std::vector<std::string>& notes) {
  if (header.particles() > 0 || header.files > 1) return;
  for (std::size_t type = 0; type < more_types_than_any_code; ++type) {
    if (!file.has(group_name(type))) continue;
    const std::vector<Hdf5Dataset> datasets = file.datasets(group_name(type));
    const Hdf5Dataset* const positions = find_positions(datasets);
    if (positions != nullptr) set_count(header, type, positions->rows());
  }
  if (header.particles() == 0) return;
  std::fill(header.total_counts.begin(), header.total_counts.end(), 0);
  std::fill(header.total_counts_high.begin(), header.total_counts_high.end(), 0);
  notes.push_back(
      "the header counts no particles; their numbers are those of the rows of the positions");
}

void leave_out_tracers(const Hdf5File& file, GadgetHeader& header,
                       std::vector<std::string>& notes) {
  for (std::size_t type = 0; type < header.counts.size(); ++type) {
    const std::string group = group_name(type);
    const bool are_tracers = header.counts[type] > 0 && file.has(group + "/TracerID") &&
                             !file.has(group + "/Coordinates");
    if (!are_tracers) continue;
    notes.push_back(fmt::format("the tracers of {} are left out: they have no positions", group));
    leave_out(header, type);
  }
}

std::vector<Hdf5Field> find_hdf5_fields(const Hdf5File& file, const GadgetHeader& header, int type,
                                        std::vector<std::string>& notes) {
  const auto index = static_cast<std::size_t>(type);
  const std::string group = group_name(index);
  const std::uint64_t count = header.counts[index];
  std::vector<Hdf5Field> fields;
  std::vector<std::string> of_other_lengths, left_out;
  for (const Hdf5Dataset& dataset : file.datasets(group)) {
    const std::string label = dataset.label();
    const std::uint64_t values = dataset.values_per_row();
    const bool is_usable = dataset.kind != Hdf5Dataset::Kind::other && (values == 1 || values == 3);
    if (dataset.shape.empty() || dataset.rows() != count) {
      of_other_lengths.push_back(fmt::format("{} ({})", label, dataset.rows()));
    } else if (!is_usable) {
      left_out.push_back(label);
    } else {
      fields.push_back({label, static_cast<int>(values), dataset});
    }
  }
  if (!of_other_lengths.empty()) {
    notes.push_back(fmt::format("left out of {}, as they have other than {} rows: {}", group, count,
                                fmt::join(of_other_lengths, ", ")));
  }
  if (!left_out.empty()) {
    notes.push_back(
        fmt::format("left out of {}, as they are not one or three numbers per particle: {}", group,
                    fmt::join(left_out, ", ")));
  }
  return fields;
}

void count_rows_of_positions(const Hdf5File& file, GadgetHeader& header,
                             std::vector<std::string>& notes) {
  std::optional<std::size_t> without_positions;
  const GadgetHeader stated = header;
  for (std::size_t type = 0; type < more_types_than_any_code; ++type) {
    const std::uint64_t count = type < stated.counts.size() ? stated.counts[type] : 0;
    const std::string group = group_name(type);
    if (file.has(group + "/TracerID") && count == 0) continue;
    const std::vector<Hdf5Dataset> datasets = datasets_of(file, group);
    const Hdf5Dataset* const positions = find_positions(datasets);
    if (positions == nullptr) {
      if (count == 0 && !have_rows(datasets)) continue;
      if (!without_positions) without_positions = type;
      leave_out(header, type);
      notes.push_back(
          fmt::format("{} is left out: the header counts {} particles, but {}", group, count,
                      file.has(group) ? "it has no positions" : "there is no such group"));
    } else if (positions->rows() != count) {
      notes.push_back(
          fmt::format("the header counts {} particles of type {}, but {} has {} rows: these count",
                      count, type, positions->path, positions->rows()));
      set_count(header, type, positions->rows());
    }
  }
  if (header.particles() > 0 || !without_positions) return;
  const std::size_t type = *without_positions;
  throw_no_positions(file, group_name(type), type < stated.counts.size() ? stated.counts[type] : 0,
                     datasets_of(file, group_name(type)));
}

}  // namespace splotchcl
