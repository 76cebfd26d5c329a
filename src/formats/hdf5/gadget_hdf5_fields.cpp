#include "formats/hdf5/gadget_hdf5_fields.h"

#include <fmt/format.h>

#include <algorithm>

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

void check_rows(const Hdf5File& file, const Hdf5Dataset& dataset, std::uint64_t count,
                std::size_t type) {
  if (!dataset.shape.empty() && dataset.rows() == count) return;
  throw DataError(
      fmt::format("{}: dataset {} has {} rows, but the header counts {} particles of type {}; the "
                  "file is damaged or its header is wrong",
                  file.path().string(), dataset.path, dataset.rows(), count, type));
}

constexpr std::size_t more_types_than_any_code = 32;

}  // namespace

void count_rows_without_header(const Hdf5File& file, GadgetHeader& header,
                               std::vector<std::string>& notes) {
  if (header.particles() > 0 || header.files > 1) return;
  for (std::size_t type = 0; type < more_types_than_any_code; ++type) {
    if (!file.has(group_name(type))) continue;
    for (const Hdf5Dataset& dataset : file.datasets(group_name(type))) {
      const bool is_position = canonical_field_name(dataset.label()) == "position" &&
                               !dataset.shape.empty() && dataset.values_per_row() == 3;
      if (!is_position) continue;
      const std::size_t types = std::max(header.counts.size(), type + 1);
      header.counts.resize(types, 0);
      header.total_counts.resize(types, 0);
      header.total_counts_high.resize(types, 0);
      header.table_masses.resize(types, 0);
      header.counts[type] = dataset.rows();
    }
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
    header.counts[type] = 0;
    header.total_counts[type] = 0;
    header.total_counts_high[type] = 0;
  }
}

std::vector<Hdf5Field> find_hdf5_fields(const Hdf5File& file, const GadgetHeader& header, int type,
                                        std::vector<std::string>& notes) {
  const auto index = static_cast<std::size_t>(type);
  const std::string group = group_name(index);
  const std::uint64_t count = header.counts[index];
  std::vector<Hdf5Dataset> datasets;
  if (file.has(group)) datasets = file.datasets(group);
  std::vector<Hdf5Field> fields;
  std::vector<std::string> left_out;
  bool has_positions = false;
  for (const Hdf5Dataset& dataset : datasets) {
    check_rows(file, dataset, count, index);
    const std::string label = dataset.label();
    const std::uint64_t values = dataset.values_per_row();
    const bool is_usable = dataset.kind != Hdf5Dataset::Kind::other && (values == 1 || values == 3);
    if (!is_usable) {
      left_out.push_back(label);
      continue;
    }
    if (canonical_field_name(label) == "position" && values == 3) has_positions = true;
    fields.push_back({label, static_cast<int>(values), dataset});
  }
  if (!has_positions) throw_no_positions(file, group, count, datasets);
  if (!left_out.empty()) {
    notes.push_back(
        fmt::format("left out of {}, as they are not one or three numbers per particle: {}", group,
                    fmt::join(left_out, ", ")));
  }
  return fields;
}

void check_hdf5_groups(const Hdf5File& file, const GadgetHeader& header) {
  for (std::size_t type = 0; type < more_types_than_any_code; ++type) {
    const bool is_counted = type < header.counts.size() && header.counts[type] > 0;
    const bool are_tracers = file.has(group_name(type) + "/TracerID");
    if (is_counted || are_tracers || !file.has(group_name(type))) continue;
    const std::vector<Hdf5Dataset> datasets = file.datasets(group_name(type));
    const bool has_rows = std::any_of(datasets.begin(), datasets.end(), [](const Hdf5Dataset& d) {
      return !d.shape.empty() && d.rows() > 0;
    });
    const bool has_positions =
        std::any_of(datasets.begin(), datasets.end(), [](const Hdf5Dataset& dataset) {
          return canonical_field_name(dataset.label()) == "position";
        });
    if (has_rows && !has_positions) throw_no_positions(file, group_name(type), 0, datasets);
    for (const Hdf5Dataset& dataset : datasets)
      check_rows(file, dataset, 0, type);
  }
}

}  // namespace splotchcl
