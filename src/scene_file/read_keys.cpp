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
          {"Names for the columns of a text table or a plain NumPy array, in their order; `-` for "
           "one that is not needed. See formats.md.",
           "", "those in the file"}),
      excluding(
          key<ReadSettings, int>(
              "read.every", integer(1, most),
              [](const ReadSettings& read) {
                return read.max_particles ? std::nullopt : std::optional(read.every);
              },
              [](ReadSettings& read, int value) {
                read.every = value;
                read.max_particles.reset();
              },
              {"Only every N-th particle of each type is drawn, brighter by as much as is left "
               "out."}),
          {"read.max_particles"}),
      key<ReadSettings, int>(
          "read.max_particles", integer(1, most),
          [](const ReadSettings& read) { return read.max_particles; },
          [](ReadSettings& read, int value) {
            read.max_particles = value;
            read.every = 1;
          },
          {"At most this many particles are drawn, chosen at random and brighter by as much as is "
           "left out.",
           "", "all"}),
      key("read.seed", integer(0, most), &ReadSettings::seed,
          {"Another seed chooses other particles for `max_particles`."}),
      key("read.neighbours", integer(1, most_neighbors), &ReadSettings::neighbors,
          {"Where the file has no smoothing lengths: how many particles their spheres hold."}),
      key("read.cache_smoothing_lengths", boolean(), &ReadSettings::cache_smoothing_lengths,
          {"Whether smoothing lengths that had to be found are kept in a file beside the "
           "snapshot, for the next time."}),
  };
}

}  // namespace splotchcl::scene_file
