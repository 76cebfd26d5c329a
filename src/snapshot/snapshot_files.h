#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/hash.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A file name of a multi-file set: snapshot_002.1.hdf5 is base snapshot_002, index 1,
// ending ".hdf5". Indices have no leading zeros.
struct MemberName {
  std::filesystem::path base;  // with its folder
  int index = 0;
  std::string ending;  // "", ".hdf5" or ".h5"
};
std::optional<MemberName> parse_member_name(const std::filesystem::path& path);

// Those of its set that are there, numbered from 0 without a gap, `most` of them at most.
std::vector<std::filesystem::path> numbered_files(
    const MemberName& name, std::size_t most = std::numeric_limits<std::size_t>::max());

// A path that goes on within a file, to one of its groups: steps.h5/Step#3,
// openpmd.h5/data/100.
struct PathInFile {
  std::filesystem::path file;
  std::string group;
};
std::optional<PathInFile> path_in_file(const std::filesystem::path& path);

// The names of the `count` files of the set that `member` belongs to, in order; a link that is
// none of a set beside it belongs to that of the file it points to. Throws DataError when the name
// is not that of a member or when a file is missing.
std::vector<std::filesystem::path> find_members(const std::filesystem::path& member, int count);

// The files that are there of the set that `member` would belong to by its name, numbered from 0
// without a gap; itself alone where its name is not that of a member of such a set. Links are as
// above.
std::vector<std::filesystem::path> find_siblings(const std::filesystem::path& member);

// The existing file that `path` stands for when it is the base name of a set or lacks
// its ending. Throws DataError when there is none, or more than one.
std::filesystem::path find_by_base_name(const std::filesystem::path& path);

// Of the names, lengths and times of a snapshot's files, as they are now.
WordHash hash_of_files(const SnapshotInfo& info);

// Whether they are still those that the snapshot was opened with.
bool has_files_as_opened(const SnapshotInfo& info);

// For a snapshot that opens its files by their names again. Throws DataError where they are others
// than those of its header.
void check_files_are_the_same(const SnapshotInfo& info);

// Tells whether a path is a file or a folder, or the base name of a set, or lacks its ending.
// Reads each folder once, for looking up many names.
class ExistingFiles {
 public:
  bool have(const std::filesystem::path& path);
  // All files that are there of the set that a path is one of, or stands for. Without a set, the
  // file itself.
  std::vector<std::filesystem::path> files_of(const std::filesystem::path& path);

  // What is in a folder; nothing where there is none.
  const std::set<std::string>& names_in(const std::filesystem::path& folder);

 private:
  std::map<std::filesystem::path, std::set<std::string>> names_;  // by folder
};

struct ListedSnapshot {
  double index = 0;  // what scenes call it
  std::filesystem::path path;
};

// The snapshots that exist, by rising index. Throws UsageError when there are none or one of
// a list is missing.
std::vector<ListedSnapshot> list_snapshots(const SequenceSettings& settings);

// The snapshot at or before an index, and how far it is to the next one: 0 <= fraction < 1.
struct SequencePlace {
  std::size_t snapshot = 0;
  double fraction = 0;
};

// Throws UsageError for an index outside of the list.
SequencePlace find_place(const std::vector<ListedSnapshot>& list, double index);

// A pattern has %d, %3d or %03d once or more, and no other conversion; %% is a percent sign.
bool is_snapshot_pattern(const std::string& text);
std::string fill_pattern(const std::string& pattern, int number);
// A path as part of a pattern: its own percent signs are no conversions.
std::string as_pattern(const std::string& path);

}  // namespace splotchcl
