#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "splotchcl/sequence.h"

namespace splotchcl {

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
