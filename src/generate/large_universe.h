#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "splotchcl/generate.h"

namespace splotchcl {

// What is told while a universe is made: a stage, and the fraction of it that is done.
using UniverseProgress = std::function<void(const std::string& stage, double fraction)>;

struct LargeUniverse {
  // More particles than this are made in parts.
  static constexpr std::uint64_t least = 30'000'000;

  std::uint64_t particles_of_file = 4'000'000;  // or more, so that there are at most 60 files
  std::uint64_t most_tracers = 8'000'000;       // that tell where the web has denser matter
};

struct WrittenUniverse {
  std::uint64_t gas = 0, stars = 0;
  std::vector<std::filesystem::path> files;
};

// generate_universe() for particles that memory does not hold, written as BASE.0, BASE.1, ...: in
// each file those of one region, in Morton order. Their smoothing lengths are those of the density
// in cells (CellLengths), within a fifth of those of neighbors for most. Needs some two gigabytes
// of memory, and 28 bytes a particle beside the files meanwhile. The same
// seed makes the same bytes on any number of cores. Files appear when all are complete. Throws
// UsageError for settings out of range or where such files are there already, and DataError.
WrittenUniverse write_large_universe(const std::filesystem::path& base,
                                     const GenerateSettings& settings,
                                     const LargeUniverse& large = {},
                                     const UniverseProgress& progress = {});

}  // namespace splotchcl
