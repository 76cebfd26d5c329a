#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/particles.h"
#include "tree/field_colors.h"
#include "tree/particle_tree.h"

namespace splotchcl {

// The particles that a tree is made of. All are looked at several times, stretch by stretch.
struct TreeSource {
  int type = 0;
  std::uint64_t count = 0;
  Vec3 origin = {{0, 0, 0}};  // of the positions
  Column position, smoothing_length;
  WeightModel weight = WeightModel::mass;
  Column weights;  // masses or densities; of constant weights absent
  struct Field {
    std::string name;
    Column values;
  };
  std::vector<Field> fields;  // most_fields at most
  // Of these colors, nodes have the mean of all members.
  std::optional<ColorRule> colors;
};

struct TreeOptions {
  // Particles of a node at least: fewer are loose. 2 to 32.
  unsigned least = 4;
  std::uint64_t particles_at_once = 0;  // that are held in memory; 0: as many as serve
};

// On all cores, to the same bits on any number. Memory: some 70 bytes for each particle at once,
// and the tree. Throws UsageError where more than 255 particles lie in one place, so that no tree
// tells them apart, and for more than 2^32 - 1 particles.
TreeOfType build_tree(const TreeSource& source, const TreeOptions& options,
                      const std::function<void(double)>& progress = {});

// h times this is a particle's standard deviation with the usual kernel.width: what nodes' errors
// are stored for.
constexpr double usual_deviation_per_h = 0.27386127875258304;  // sqrt(3 / 40)

}  // namespace splotchcl
