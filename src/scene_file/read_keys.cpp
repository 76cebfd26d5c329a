#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {

Keys read_keys() {
  constexpr int most = 2147483647;
  constexpr int most_neighbors = 4096;
  return {
      key<ReadSettings, std::vector<std::string>>(
          "read.columns", texts(),
          [](const ReadSettings& read) {
            return read.columns.empty() ? std::nullopt : std::optional(read.columns);
          },
          [](ReadSettings& read, const std::vector<std::string>& value) { read.columns = value; },
          {"Names for the columns of a text table or plain NumPy array, in order; `-` skips one. "
           "See formats.md.",
           "", "those in the file"}),
      excluding(key<ReadSettings, int>(
                    "read.every", integer(1, most),
                    [](const ReadSettings& read) {
                      return read.max_particles ? std::nullopt : std::optional(read.every);
                    },
                    [](ReadSettings& read, int value) {
                      read.every = value;
                      read.max_particles.reset();
                    },
                    {"Draw every N-th particle of each type, brighter by as much as is left out."}),
                {"read.max_particles"}),
      key<ReadSettings, int>(
          "read.max_particles", integer(1, most),
          [](const ReadSettings& read) { return read.max_particles; },
          [](ReadSettings& read, int value) {
            read.max_particles = value;
            read.every = 1;
          },
          {"Draw at most this many particles, chosen at random and brighter likewise.", "", "all"}),
      key("read.seed", integer(0, most), &ReadSettings::seed, {"The seed of that choice."}),
      key("read.neighbours", integer(1, most_neighbors), &ReadSettings::neighbors,
          {"If the file has no smoothing lengths: how many particles their spheres hold."}),
      key("read.cache_smoothing_lengths", boolean(), &ReadSettings::cache_smoothing_lengths,
          {"Store smoothing lengths that had to be found in a file beside the snapshot, for "
           "reuse."}),
  };
}

}  // namespace splotchcl::scene_file
