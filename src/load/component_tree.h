#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/particle_columns.h"
#include "splotchcl/load.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "tree/build_tree.h"
#include "tree/particle_tree.h"
#include "tree/tree_file.h"

namespace splotchcl {

// The tree beside a snapshot of a component that takes whole types, one after the other, where the
// snapshot has them. Null where there is none, or it is not of what the component draws: other
// sizes or weights, a field that the tree does not have, particles that are placed elsewhere.
std::shared_ptr<const TreeOfComponent> component_tree(const Component& component,
                                                      const Snapshot& snapshot,
                                                      const std::vector<int>& types,
                                                      WeightModel weight);

// The same of particles that are drawn at their periodic images nearest to a center.
std::shared_ptr<const TreeOfComponent> wrapped_tree(const TreeOfComponent& tree, const Vec3& center,
                                                    const BoxSides& periodic_box);

// Fields whose ranges decide what suggest_scene() draws: a tree keeps a sample of them.
constexpr const char* fields_of_suggestions[] = {"density", "temperature", "internal_energy",
                                                 "stellar_age"};

// Values of a type's field, or positions, of which a sample is looked at: every `stride`-th
// particle's, with a pass over these. They lie in the tree beside a snapshot of many particles,
// else they are those of all.
struct ValuesToSample {
  Column values;
  std::size_t stride;
  ParticlePass pass;
};
ValuesToSample values_to_sample(const Snapshot& snapshot, int type, const std::string& field);

// Whether there is one beside the snapshot, or one has been given.
bool has_tree(const Snapshot& snapshot);
// Trees that were made of the snapshot's particles in memory take the place of those beside it.
void give_trees(const Snapshot& snapshot, const Trees& trees);

// What to tell of a tree beside the snapshot that is not of its files; empty: nothing.
std::string tell_stale_tree(const Snapshot& snapshot);

// Of the scene's components that draw the type: what they take color and intensity from.
std::vector<std::string> fields_shown(const Scene& scene, int type);

// How the first of the scene's components that draw the type colors its particles by these fields.
// Nothing where it takes other ones, or colors that no tree serves. Throws UsageError for a palette
// that there is not.
std::optional<ColorRule> colors_shown(const DecidedScene& decided, int type,
                                      const std::vector<std::string>& fields);

// What a tree of one type is made of: its particles as scenes draw them, with masses as weights
// where these are known, and the fields of these names. Throws as loading a component does.
TreeSource tree_source(const Snapshot& snapshot, int type, const std::vector<std::string>& fields,
                       std::vector<std::string>& notes, const LoadProgress& progress);
// What the tree of many particles keeps of them, in memory; of fewer nothing.
std::optional<ParticleSample> sample_to_keep(const Snapshot& snapshot, const TreeSource& source);

}  // namespace splotchcl
