#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/mapped_file.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl {

// A file format. To add one: write its file, declare it here and list it in
// snapshot_formats().
class SnapshotFormat {
 public:
  virtual ~SnapshotFormat() = default;

  // Judges by the first bytes, never by the name. A damaged file of the format is
  // recognised too, so that open() can say what is wrong with it.
  virtual bool recognizes(const std::shared_ptr<const MappedFile>& file) const = 0;

  // `path` is any file of a multi-file set. Throws DataError.
  virtual std::unique_ptr<Snapshot> open(const std::filesystem::path& path,
                                         const SnapshotOptions& options) const = 0;

  // Whether a file that it recognizes is a map or an image, which a folder of a snapshot may hold
  // beside it. Damaged files are not.
  virtual bool is_map(const std::filesystem::path&) const { return false; }

  // Whether a path may go on within the file, FILE/GROUP; open() then takes such a path.
  virtual bool has_groups() const { return false; }

  // The names of the groups in a group of a file; an empty one is the root. Nothing where there is
  // no such group. Throws DataError.
  virtual std::vector<std::string> groups_in(const std::filesystem::path&,
                                             const std::string&) const {
    return {};
  }

  // Whether SnapshotOptions::columns means something for it.
  virtual bool has_columns(const std::vector<std::string>&) const { return false; }
};

const SnapshotFormat& gadget_binary_format();  // formats 1 and 2
const SnapshotFormat& hdf5_formats();          // Gadget and its relatives, Phantom
const SnapshotFormat& numpy_format();          // .npy and .npz
const SnapshotFormat& tipsy_format();
const SnapshotFormat& text_table_format();

// In the order in which they are asked.
std::vector<const SnapshotFormat*> snapshot_formats();

// The format of a file; null where it has none of them. Throws DataError when the file cannot
// be opened.
const SnapshotFormat* find_format(const std::filesystem::path& path);

// What a file is that its first bytes show to be no snapshot, and what to do, such as "a FITS file;
// convert it to HDF5 or to a NumPy array"; null where they do not tell. Throws DataError when the
// file cannot be opened.
const char* find_other_kind(const std::filesystem::path& path);

// More columns than any table of particles has: what asks for more is damaged, or no such table.
constexpr std::size_t most_columns = 4096;

// Deflate packs no better than 1032 to 1.
constexpr std::uint64_t best_packing_of_deflate = 1032;

// Whether two threads may read snapshots at the same time: only where HDF5 was built for it.
bool can_read_concurrently();

}  // namespace splotchcl
