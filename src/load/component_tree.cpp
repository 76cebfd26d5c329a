#include "load/component_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "load/component_fields.h"
#include "load/missing_sizes.h"
#include "load/placement.h"
#include "snapshot/field_names.h"
#include "snapshot/load_memory.h"

namespace splotchcl {
namespace {

constexpr const char* trees_key = "tree";

// Read once for all frames of a film.
const std::optional<Trees>& known_trees(const Snapshot& snapshot) {
  return snapshot.memory().get<std::optional<Trees>>(
      trees_key, [&snapshot] { return read_trees(snapshot.info()); });
}

// Among the tree's; nothing where it is not there, -1 where the scene names none.
std::optional<int> field_of(const TreeOfType& tree, const std::string& name) {
  if (name.empty()) return -1;
  const std::string canonical = canonical_field_name(name);
  const auto found =
      std::find_if(tree.fields.begin(), tree.fields.end(), [&](const std::string& field) {
        return canonical.empty() ? field == name : canonical_field_name(field) == canonical;
      });
  if (found == tree.fields.end()) return std::nullopt;
  return static_cast<int>(found - tree.fields.begin());
}

}  // namespace

std::shared_ptr<const TreeOfComponent> component_tree(const Component& component,
                                                      const Snapshot& snapshot,
                                                      const std::vector<int>& types,
                                                      WeightModel weight) {
  const bool is_in_place = !component.placement.moves() && !component.size_fixed &&
                           component.color_vector.empty() &&
                           canonical_field_name(component.size_field) == "smoothing_length";
  if (!is_in_place || !known_trees(snapshot)) return nullptr;
  auto tree = std::make_shared<TreeOfComponent>();
  std::uint64_t first = 0;
  for (const int type : types) {
    const Trees& trees = *known_trees(snapshot);
    const auto found = std::find_if(trees.begin(), trees.end(),
                                    [type](const auto& known) { return known->type == type; });
    if (found == trees.end() || (*found)->weight != weight) return nullptr;
    const std::optional<int> color = field_of(**found, component.color.field);
    const std::optional<int> intensity = field_of(**found, component.intensity.field);
    if (!color || !intensity) return nullptr;
    tree->parts.push_back({*found, first, *color, *intensity});
    first += (*found)->count;
  }
  return tree;
}

std::shared_ptr<const TreeOfComponent> wrapped_tree(const TreeOfComponent& tree, const Vec3& center,
                                                    const BoxSides& periodic_box) {
  auto wrapped = std::make_shared<TreeOfComponent>(tree);
  wrapped->center = center;
  for (std::size_t axis = 0; axis < 3; ++axis)
    wrapped->period.a[axis] = periodic_box[axis];
  return wrapped;
}

bool has_tree(const Snapshot& snapshot) {
  return known_trees(snapshot).has_value();
}

void give_trees(const Snapshot& snapshot, const Trees& trees) {
  snapshot.memory().set(trees_key, std::optional<Trees>(trees));
}

std::string tell_stale_tree(const Snapshot& snapshot) {
  if (known_trees(snapshot) || !tree_is_there(snapshot.info())) return {};
  return fmt::format(
      "{} is not used: it is of other files than those beside it, damaged, or someone else's; "
      "splotchcl tree makes it anew",
      tree_path(snapshot.info()).string());
}

std::vector<std::string> fields_shown(const Scene& scene, int type) {
  std::set<std::string> fields;
  for (const Component& component : scene.components) {
    if (std::find(component.types.begin(), component.types.end(), type) == component.types.end())
      continue;
    for (const FieldMap* const map : {&component.color, &component.intensity}) {
      if (!map->field.empty()) fields.insert(map->field);
    }
  }
  return {fields.begin(), fields.end()};
}

TreeSource tree_source(const Snapshot& snapshot, int type, const std::vector<std::string>& fields,
                       std::vector<std::string>& notes, const LoadProgress& progress) {
  Component component;
  component.types = {type};
  Scene scene;
  scene.components = {component};
  ComponentFields particles(component, 0, snapshot, missing_sizes(scene, progress), notes);
  particles.select();
  TreeSource source;
  source.type = type;
  source.count = particles.count();
  source.origin = particles.origin();
  source.position = particles.positions();
  source.smoothing_length = particles.smoothing_lengths();
  source.weight = particles.masses_are_known() ? WeightModel::mass : WeightModel::constant;
  if (particles.masses_are_known()) source.weights = particles.masses();
  for (const std::string& field : fields)
    source.fields.push_back({field, particles.scalars(field, "--fields")});
  return source;
}

}  // namespace splotchcl
