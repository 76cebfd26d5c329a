#include <fmt/format.h>

#include <cstddef>

#include "cli/commands.h"
#include "index/snapshot_index.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::cli {

int run_index(const IndexOptions& options, Console& console) {
  const auto snapshot = open_snapshot(options.snapshot);
  const SnapshotIndex index = SnapshotIndex::make(
      *snapshot, [&console](double done) { console.progress("reading positions", done); });
  index.write(snapshot->info());
  std::size_t blocks = 0;
  for (const SnapshotIndex::Type& type : index.types()) {
    blocks += type.boxes.size();
    if (type.has_smoothing_lengths) continue;
    console.note(fmt::format(
        "type {} has no smoothing lengths in its file: its index serves scenes that say their "
        "size (size.fixed)",
        type.type));
  }
  console.done(
      fmt::format("{}: {} blocks", SnapshotIndex::path_for(snapshot->info()).string(), blocks));
  return 0;
}

}  // namespace splotchcl::cli
