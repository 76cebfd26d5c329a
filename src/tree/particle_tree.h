#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/particles.h"
#include "splotchcl/scene.h"
#include "splotchcl/vector.h"
#include "tree/sampled_field.h"

namespace splotchcl {

// The particles of one type in an octree, of which nodes stand for all particles below them as one
// Gaussian each (docs/tree.md). Lengths are in sides of the tree's cube; a node's cell is the
// cube's over 2^level along each axis. What a node's bytes mean is in node_bytes.h.
struct TreeNode {
  std::uint16_t place[3] = {};  // of the centroid, in parts of the cell
  std::uint16_t deviation = 0;  // of the members' places along one axis: root mean square
  std::uint16_t size = 0;       // root mean square of h
  std::uint8_t third = 0, fourth = 0, uneven = 0;  // roots of NodeShape's
  std::uint8_t widest = 0;                         // h, rounded up
  std::uint8_t members = 0;                        // how many are sampled, narrow_bits(), rest_bit
  std::uint8_t reach = 0;                          // NodeMoments::reach, rounded up
  float flux = 0;                                  // sum of masses, of h, or of density times h^3

  // A node of its parent's particles that lie in octants with too few for nodes of their own. It
  // has the octant of one of these, and the parent's cell.
  static constexpr std::uint8_t rest_bit = 0x80, narrow_shift = 4;
  bool is_rest() const { return (members & rest_bit) != 0; }
  // All members where they are sampled, alike in flux; 0: only some are.
  std::uint8_t all_sampled() const { return members & 0x0f; }
  std::uint8_t narrow() const { return (members >> narrow_shift) & 7; }
  int cell_level(std::size_t level) const { return static_cast<int>(level) - (is_rest() ? 1 : 0); }
};
static_assert(sizeof(TreeNode) == 20);

// What one ColorRule makes of all members of a node together, weighted by their flux.
struct MeanColor {
  std::uint16_t channels[3] = {};  // of the mean, in parts of 2^exponent
  std::int8_t exponent = 0;
  std::uint8_t deviation = 0;  // of a member's color from the mean: root mean square
  // Of the mean of a member's color times its way from the centroid, in cells: the length. Both
  // are those of the channel where they are largest, and of rough_bits().
  std::uint8_t dipole = 0;

  static MeanColor of(const std::array<double, 3>& mean, double deviation, double dipole);
  std::array<float, 3> mean() const;
};
static_assert(sizeof(MeanColor) == 10);

// Nodes of one level in Morton order. Particles of a node that lie in none of the next level are
// loose: they follow each other in the tree's `order`.
struct TreeLevel {
  static constexpr std::uint64_t group = 64;  // nodes

  std::uint64_t count = 0;
  const TreeNode* nodes = nullptr;
  const SampledField* fields = nullptr;           // of each node as many as the tree has
  const MeanColor* colors = nullptr;              // where the tree has any
  const std::uint8_t* children = nullptr;         // a bit for each octant of the cell with a node
  const std::uint8_t* loose = nullptr;            // particles
  const std::uint64_t* first_children = nullptr;  // in the next level, of each group
  const std::uint64_t* first_loose = nullptr;     // in the order, likewise

  std::uint64_t first_child(std::uint64_t node) const;
  std::uint64_t first_loose_particle(std::uint64_t node) const;
};

// Values of particles as the snapshot has them; of fields those of the tree.
struct StoredParticles {
  Column position, smoothing_length, weight;
  std::vector<Column> fields;
};

// Every `stride`-th particle of the snapshot. What follows from a sample of all particles, such as
// ranges and the camera, is found here without a look at the snapshot, which may be larger than
// memory.
struct ParticleSample {
  std::uint64_t stride = 1;
  Vec3 origin = {{0, 0, 0}};  // of the positions
  StoredParticles particles;
  std::vector<std::string> other_names;  // of fields that are no tree's: most_others at most
  std::vector<Column> others;

  static constexpr std::size_t most_others = 4;
};

struct TreeOfType {
  static constexpr std::size_t levels_at_most = 22;  // keys of 21 bits along each axis

  int type = 0;
  std::uint64_t count = 0;  // particles of the snapshot
  std::uint64_t bad = 0;    // of them not in the tree
  WeightModel weight = WeightModel::mass;
  Vec3 origin = {{0, 0, 0}};             // the cube's lower corner, in the snapshot's lengths
  double side = 1;                       // of the cube
  std::vector<std::string> fields;       // names of scenes
  std::optional<std::uint64_t> colors;   // ColorRule::key() of those that nodes have
  std::vector<TreeLevel> levels;         // from the root on, which is one node; empty: no particles
  const std::uint32_t* order = nullptr;  // of loose particles: their places in the snapshot
  std::uint64_t order_count = 0;
  std::optional<StoredParticles> particles;  // loose; unset: in the snapshot; else no `order`
  std::optional<ParticleSample> sample;      // unset: of few particles
  std::shared_ptr<const void> owner;         // of all memory

  std::uint64_t node_count() const;
};

// The tree of a component of a scene, whose particles are those of types one after the other.
class TreeOfComponent {
 public:
  struct Part {
    std::shared_ptr<const TreeOfType> tree;
    std::uint64_t first = 0;           // particle of the component
    int color = -1, intensity = -1;    // among the tree's fields; -1: none is used
    std::uint64_t first_in_order = 0;  // loose particle of in_order
  };
  std::vector<Part> parts;
  // Particles are drawn at the image nearest to a center; 0: they are where the file has them.
  Vec3 period = {{0, 0, 0}}, center = {{0, 0, 0}};
  // Loose particles of all parts; none: they are taken from among the component's.
  Particles in_order;
  // Every sample_stride-th particle of the component; none: they have to be looked at.
  Particles sample;
  std::uint64_t sample_stride = 1;
};

}  // namespace splotchcl
