#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/read_settings.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// What a file does not say of itself.
struct SnapshotOptions {
  // Names for the columns of a text table or a plain NumPy array, in their order, instead of
  // those in its header; "-" for a column that is not needed. Or NAME=COLUMN for each that the file
  // calls by another name: in HDF5 NAME=PATH of a dataset, PATH:MEMBER of one of records, PATH:1
  // for its first column. Empty: the file's own.
  std::vector<std::string> columns;
  // Lines at the beginning of a text table that are no part of it.
  int skip_lines = 0;
  // FIELD=UNIT, as ReadSettings has them.
  std::vector<std::string> units = {};
};

// Recognises the format by content (docs/formats.md). `path` may be any member or the base name of
// a multi-file set. Reads no particles. Throws DataError.
std::unique_ptr<Snapshot> open_snapshot(const std::filesystem::path& path,
                                        const SnapshotOptions& options = {});
// The snapshot, or the part of it, that a scene's [read] asks for. Throws DataError.
std::unique_ptr<Snapshot> open_snapshot_for(const std::filesystem::path& path,
                                            const ReadSettings& read);

}  // namespace splotchcl
