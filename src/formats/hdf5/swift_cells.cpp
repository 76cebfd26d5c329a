#include "formats/hdf5/swift_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "formats/hdf5/hdf5_file.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The table of one type, as the file has it.
struct CellTable {
  std::vector<std::uint64_t> firsts, counts, files;
  std::vector<double> lower, upper;  // three for each cell
};

template <class T>
std::vector<T> read_values(const Hdf5File& file, const std::string& path, std::size_t width) {
  const Hdf5Dataset dataset = file.dataset(path);
  if (dataset.values_per_row() != width) throw DataError(path + ": of another shape");
  file.check_complete(dataset);
  std::vector<T> values(static_cast<std::size_t>(dataset.rows()) * width);
  if (!values.empty()) file.read_rows(dataset, 0, dataset.rows(), values.data());
  return values;
}

std::optional<CellTable> read_table(const Hdf5File& file, int type) {
  const auto path_of = [type](const char* what) {
    return fmt::format("/Cells/{}/PartType{}", what, type);
  };
  for (const char* const what : {"OffsetsInFile", "Counts", "MinPositions", "MaxPositions"}) {
    if (!file.has(path_of(what))) return std::nullopt;
  }
  CellTable table;
  table.firsts = read_values<std::uint64_t>(file, path_of("OffsetsInFile"), 1);
  table.counts = read_values<std::uint64_t>(file, path_of("Counts"), 1);
  if (file.has(path_of("Files")))
    table.files = read_values<std::uint64_t>(file, path_of("Files"), 1);
  table.lower = read_values<double>(file, path_of("MinPositions"), 3);
  table.upper = read_values<double>(file, path_of("MaxPositions"), 3);
  const std::size_t cells = table.counts.size();
  if (table.firsts.size() != cells || table.lower.size() != 3 * cells ||
      table.upper.size() != 3 * cells)
    return std::nullopt;
  // Of a set the table counts from the beginning of each file.
  const auto is_another = [](std::uint64_t number) { return number != 0; };
  if (std::any_of(table.files.begin(), table.files.end(), is_another)) return std::nullopt;
  return table;
}

// Of each axis; empty where the file does not say.
std::vector<double> sides_of_box(const Hdf5File& file) {
  std::vector<double> sides = file.numbers("Header", "BoxSize").value_or(std::vector<double>());
  if (sides.size() == 1) sides.resize(3, sides.front());
  return sides.size() == 3 ? sides : std::vector<double>();
}

ParticleCell cell_of(const CellTable& table, std::size_t number, const std::vector<double>& sides) {
  ParticleCell cell;
  cell.first = table.firsts[number];
  cell.count = table.counts[number];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lower = table.lower[3 * number + axis], upper = table.upper[3 * number + axis];
    // What drifts out of the box is written on its other side.
    const bool is_known = lower >= 0 && lower <= upper && upper < sides[axis];
    cell.lower[axis] = is_known ? lower : -infinity;
    cell.upper[axis] = is_known ? upper : infinity;
  }
  return cell;
}

// In the file's order; empty where they are not all particles one after the other.
std::vector<ParticleCell> ordered_cells(const CellTable& table, const std::vector<double>& sides,
                                        std::uint64_t particles) {
  std::vector<ParticleCell> cells;
  for (std::size_t i = 0; i < table.counts.size(); ++i) {
    if (table.counts[i] > 0) cells.push_back(cell_of(table, i, sides));
  }
  std::sort(cells.begin(), cells.end(),
            [](const ParticleCell& a, const ParticleCell& b) { return a.first < b.first; });
  std::uint64_t next = 0;
  for (const ParticleCell& cell : cells) {
    if (cell.first != next || cell.count > particles - next) return {};
    next += cell.count;
  }
  return next == particles ? cells : std::vector<ParticleCell>();
}

// Positions may have been rounded to single precision.
bool is_within(const ParticleCell& cell, const double* position) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double room = std::abs(position[axis]) * std::numeric_limits<float>::epsilon();
    if (!(position[axis] >= cell.lower[axis] - room && position[axis] <= cell.upper[axis] + room))
      return false;
  }
  return true;
}

bool hold_their_particles(const Hdf5File& file, const Hdf5Dataset& positions,
                          const std::vector<ParticleCell>& cells) {
  constexpr std::size_t looked_at = 16;
  const std::size_t step = std::max<std::size_t>(1, cells.size() / looked_at);
  for (std::size_t i = 0; i < cells.size(); i += step) {
    double position[3];
    file.read_rows(positions, cells[i].first + cells[i].count - 1, 1, position);
    if (!is_within(cells[i], position)) return false;
  }
  return true;
}

bool has_lost_digits(const Hdf5File& file, const std::string& dataset) {
  const auto filter = file.text(dataset, "Lossy compression filter");
  return filter && *filter != "None";
}

std::vector<ParticleCell> read_cells(const SnapshotInfo& info, const ParticleTypeInfo& type) {
  const FieldInfo* const position = find_field(type, "position");
  if (position == nullptr) return {};
  check_files_are_the_same(info);
  const Hdf5File file(info.files.front());
  const std::string path = fmt::format("/PartType{}/{}", type.type, position->file_name);
  const std::optional<CellTable> table = read_table(file, type.type);
  const std::vector<double> sides = sides_of_box(file);
  if (!table || sides.empty() || has_lost_digits(file, path)) return {};
  const Hdf5Dataset positions = file.dataset(path);
  if (positions.rows() != type.count || positions.values_per_row() != 3) return {};
  std::vector<ParticleCell> cells = ordered_cells(*table, sides, type.count);
  return hold_their_particles(file, positions, cells) ? cells : std::vector<ParticleCell>();
}

}  // namespace

std::vector<ParticleCell> read_swift_cells(const SnapshotInfo& info, int type) {
  const ParticleTypeInfo* const known = info.find_type(type);
  const bool is_one_file = info.files.size() == 1 && info.files_beside.empty();
  if (info.format != "SWIFT HDF5" || !is_one_file || known == nullptr) return {};
  try {
    return read_cells(info, *known);
  } catch (const DataError&) {
    return {};  // a damaged table is as good as none
  }
}

}  // namespace splotchcl
