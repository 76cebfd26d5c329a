#pragma once

#include "formats/snapshot_checks.h"
#include "testing.h"

namespace splotchcl::test {

// A snapshot and what is read from it, a test: `contents` are files, which are all read alike.
struct SnapshotRow {
  std::string name;
  std::vector<std::string> contents;
  // Between " | ": "FIELD VALUES", of which positions are from 0; "unit FIELD U", "no FIELD", "no
  // unit FIELD" and "count N", of the first type or of the one after FIELD or count ("mass/4 7 8");
  // "table_mass M", "types N", "fields N", "ids NUMBERS", "whole FIELD NUMBERS", "format F", "time
  // T", "redshift Z", "hubble H", "box SIDES", "origin X", "no box" (or cosmology, redshift), "note
  // PART OF ONE", "notes N", "no notes"; or "refused PART OF THE MESSAGE", where it is opened,
  // "unreadable", where it is read after that, and "misuse" where the call is wrong.
  std::string expected;
  SnapshotOptions options = {};
};

inline void PrintTo(const SnapshotRow& row, std::ostream* out) {
  *out << row.name;
}
inline std::string name_of_row(const ::testing::TestParamInfo<SnapshotRow>& info) {
  return info.param.name;
}

// Those of a file (text_rows.h) in tests/formats: parts of what is expected stand in lines of their
// own, options in "with columns A, B", "with skip_lines N" and "with units A, B".
std::vector<SnapshotRow> snapshot_rows(const std::string& file);

// Rows are its parameters in whatever file of tests; contents are the bytes of a file "snap".
class SnapshotFile : public ::testing::TestWithParam<SnapshotRow> {};

// The parts of a text between bars.
std::vector<std::string> parts_between_bars(const std::string& text);

// Of the snapshot at this path, whether it opens or not.
void expect_snapshot(const std::filesystem::path& path, const SnapshotOptions& options,
                     const std::string& expected);

}  // namespace splotchcl::test
