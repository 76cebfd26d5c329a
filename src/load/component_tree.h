#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

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

// Whether there is one beside the snapshot, or one has been given.
bool has_tree(const Snapshot& snapshot);
// Trees that were made of the snapshot's particles in memory take the place of those beside it.
void give_trees(const Snapshot& snapshot, const Trees& trees);

// What to tell of a tree beside the snapshot that is not of its files; empty: nothing.
std::string tell_stale_tree(const Snapshot& snapshot);

// Of the scene's components that draw the type: what they take color and intensity from.
std::vector<std::string> fields_shown(const Scene& scene, int type);

// What a tree of one type is made of: its particles as scenes draw them, with masses as weights
// where these are known, and the fields of these names. Throws as loading a component does.
TreeSource tree_source(const Snapshot& snapshot, int type, const std::vector<std::string>& fields,
                       std::vector<std::string>& notes, const LoadProgress& progress);

}  // namespace splotchcl
