#pragma once

#include "formats/snapshot_checks.h"
#include "testing.h"

namespace splotchcl::test {

// A snapshot and what is read from it, a test: `contents` are files, which are all read alike.
struct SnapshotRow {
  const char* name;
  std::vector<std::string> contents;
  // Between " | ": "FIELD VALUES", of which positions are from 0; "unit FIELD U", "no FIELD" and
  // "count N", of the first type or of the one after FIELD or count ("mass/4 7 8"); "types N",
  // "fields N", "ids NUMBERS", "format F", "time T", "redshift Z", "hubble H", "box SIDES", "no
  // box" (or cosmology, redshift), "note PART OF ONE", "notes N", "no notes"; or "refused PART OF
  // THE MESSAGE", "misuse" where the call is wrong.
  const char* expected;
  SnapshotOptions options = {};
};

inline void PrintTo(const SnapshotRow& row, std::ostream* out) {
  *out << row.name;
}
inline std::string name_of_row(const ::testing::TestParamInfo<SnapshotRow>& info) {
  return info.param.name;
}

// The parts of a text between bars.
std::vector<std::string> parts_between_bars(const std::string& text);

// Of the snapshot at this path, whether it opens or not.
void expect_snapshot(const std::filesystem::path& path, const SnapshotOptions& options,
                     const std::string& expected);

}  // namespace splotchcl::test
