#include "formats/hdf5/hdf5_formats.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>

#include "formats/hdf5/hdf5_table.h"
#include "formats/snapshot_format.h"
#include "formats/table.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {
namespace {

// As splotchcl map writes them.
bool holds_map(const Hdf5File& file) {
  return file.text("map", "quantity") && file.text("map", "unit") && file.numbers("map", "extent");
}

std::unique_ptr<Snapshot> open_group(const PathInFile& within) {
  if (is_plain_hdf5(Hdf5File(within.file))) return open_plain_hdf5(within.file, within.group);
  throw DataError(
      fmt::format("{}: has a header, so that its group {} is no snapshot; give the path "
                  "of the file",
                  within.file.string(), within.group));
}

class Hdf5Formats : public SnapshotFormat {
 public:
  bool recognizes(const std::shared_ptr<const MappedFile>& file) const override {
    return Hdf5File::has_signature(file->data(), file->size());
  }
  std::unique_ptr<Snapshot> open(const std::filesystem::path& path,
                                 const SnapshotOptions& options) const override {
    const auto within = path_in_file(path);
    if (!options.columns.empty()) {
      return open_named_columns(within ? within->file : path, within ? within->group : "",
                                options.columns);
    }
    if (within) return open_group(*within);
    const Hdf5File file(path);
    if (is_phantom_hdf5(file)) return open_phantom_hdf5(path);
    if (is_plain_hdf5(file)) return open_plain_hdf5(path);
    if (!holds_map(file)) return open_gadget_hdf5(path);
    throw DataError(path.string() +
                    ": holds a map, expected particles; give the snapshot that it is a map of");
  }
  bool has_groups() const override { return true; }
  std::vector<std::string> groups_in(const std::filesystem::path& path,
                                     const std::string& group) const override {
    const Hdf5File file(path);
    const std::string place = "/" + group;
    if (!group.empty() && !file.has(place)) return {};
    std::vector<std::string> names = file.groups(place);
    if (!find_positions(names_of(columns_in(file, place).columns))) return names;
    std::vector<std::string> notes;
    for (std::string& step : steps_in(Hdf5Table(path, place, notes)))
      names.push_back(std::move(step));
    return names;
  }
  // Names in their order are for tables alone.
  bool has_columns(const std::vector<std::string>& columns) const override {
    return std::all_of(columns.begin(), columns.end(), [](const std::string& column) {
      return split_named_column(column).has_value();
    });
  }
  bool is_map(const std::filesystem::path& path) const override {
    try {
      return holds_map(Hdf5File(path));
    } catch (const DataError&) {
      return false;
    }
  }
};

}  // namespace

const SnapshotFormat& hdf5_formats() {
  static const Hdf5Formats formats;
  return formats;
}

bool can_read_concurrently() {
  hbool_t is_safe = 0;
  return H5is_library_threadsafe(&is_safe) >= 0 && is_safe > 0;
}

}  // namespace splotchcl
