#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "load/placement.h"
#include "load/select_particles.h"
#include "load/type_fields.h"
#include "scene/particle_columns.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A type's column, and of how many particles.
struct ColumnOfType {
  Column column;
  std::size_t count;
};
// One after the other, `width` values for each particle: held in memory, or streamed where they are
// too many or ranks share them.
Column joined(const std::vector<ColumnOfType>& parts, std::size_t width, bool is_shared);

// Reads the fields of one component: the particles that it selects of the types that it
// draws, one type after the other. Messages name the component and the scene's key that
// asked for the field.
class ComponentFields {
 public:
  // `snapshot` is the component's own or the scene's. Throws UsageError when it has none of
  // the component's types. Reads nothing yet. Where particles are spread over ranks, each derives
  // and selects of its own; what is asked for here is of all ranks.
  // `periodic_box` is the box across whose faces it selects.
  // `number` is the component's in the scene, from 0.
  ComponentFields(const Component& component, std::size_t number, const Snapshot& snapshot,
                  const MissingSizes& sizes, std::vector<std::string>& notes,
                  const std::optional<BoxSides>& periodic_box = std::nullopt);
  ComponentFields(const ComponentFields&) = delete;
  ComponentFields& operator=(const ComponentFields&) = delete;

  // Refuses fields and selections that the particles do not have, before anything is read.
  void check(const SortOrder& sort) const;
  // Finds the selected particles; before all that follows.
  void select();

  const SnapshotInfo& snapshot_info() const { return snapshot_.info(); }
  std::size_t count() const;  // particles of all types together
  std::size_t count_before_selecting() const;
  // Over all of them.
  ParticlePass pass() const;
  // As they are placed in the scene: origin() + positions().
  Vec3 origin() const;
  Column positions() const;
  // Where the scene's box is periodic and they are in it, brings particles to their images nearest
  // to a center, which becomes their origin.
  void wrap_around(const Vec3& center, Particles& particles) const;
  // A note on positions of what is drawn that single precision rounds too much.
  std::optional<std::string> rounded_positions(const DrawnComponent& drawn) const;
  // One value per particle; of a vector field its length. Throws UsageError when a type
  // does not have the field.
  Column scalars(const std::string& field, const std::string& key) const;
  // Three values per particle, of a vector field.
  Column vectors(const std::string& field, const std::string& key) const;
  bool masses_are_known() const;
  Column masses() const;
  // Mass over density, in units of `unit` of it: in cgs a float may not hold it. `key` is the
  // scene's that asked for it.
  Column volumes(const std::string& key, double unit) const;
  // How many particles of the snapshot each stands for, where only a part of them is read: the
  // mean over the component's types.
  double particles_per_drawn() const;
  // Weights times how much of each particle is there, 0 to 1, between two snapshots, and how many
  // more it stands for than the mean. Absent weights are 1.
  Column with_factors(const Column& weights) const;
  // h as the scene says, before the placement's scale: a fixed size, a field of the file,
  // or, for "smoothing_length" where the file has none, found from the particles themselves.
  Column smoothing_lengths() const;

  // Around positions(), in blocks of particles; null where no index beside the snapshot tells.
  std::shared_ptr<const ParticleBoxes> boxes() const;

  // The same particles, merged, for such weights; null where no tree beside the snapshot has them.
  std::shared_ptr<const TreeOfComponent> tree(WeightModel weight) const;

  // Adds "component NAME: text" to the notes.
  void note(const std::string& text) const;
  // For messages: the component's name, or its number where it has none.
  std::string name() const;
  std::string label() const;  // "component NAME"

 private:
  bool stand_for_the_same() const;
  float factor_of(const TypeFields& type) const;
  Column weight_factors() const;  // absent: 1 for all
  Column rim_factors(const TypeFields& type) const;
  using Read = std::function<Column(const TypeFields&)>;
  Column collected(const std::string& what, const Read& read, std::size_t width = 1) const;
  void note_lost_ids();
  void add_up_counts(std::size_t type);
  std::size_t count_of(std::size_t type) const;
  std::size_t own_count_of(std::size_t type) const;
  std::string particles_key() const;
  std::string placed_key() const;
  [[noreturn]] void refuse_types() const;

  const Component& component_;
  std::size_t number_;
  const Snapshot& snapshot_;
  std::vector<std::string>& notes_;
  std::optional<BoxSides> periodic_box_;
  std::vector<TypeFields> types_;
  std::vector<std::shared_ptr<const ParticleIndices>> selected_;  // null: all of the type
  std::shared_ptr<SpreadParticles> spread_;                       // null: all particles are here
  std::vector<std::size_t> counts_, own_begins_;  // of all ranks, and this one's first, by types
};

}  // namespace splotchcl
