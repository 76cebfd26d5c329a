#include "load/component_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "load/component_fields.h"
#include "load/components.h"
#include "load/missing_sizes.h"
#include "load/passes.h"
#include "load/placement.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/statistics.h"
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

// Null where there is none of the type.
std::shared_ptr<const TreeOfType> known_tree(const Snapshot& snapshot, int type) {
  const std::optional<Trees>& trees = known_trees(snapshot);
  if (!trees) return nullptr;
  const auto found = std::find_if(trees->begin(), trees->end(),
                                  [type](const auto& known) { return known->type == type; });
  return found == trees->end() ? nullptr : *found;
}

// Among a tree's; nothing where it is not there, -1 where the scene names none.
std::optional<int> field_of(const std::vector<std::string>& fields, const std::string& name) {
  if (name.empty()) return -1;
  const std::string canonical = canonical_field_name(name);
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const std::string& field) {
    return canonical.empty() ? field == name : canonical_field_name(field) == canonical;
  });
  if (found == fields.end()) return std::nullopt;
  return static_cast<int>(found - fields.begin());
}

// A number as field_of() gives it.
Column field_in(const StoredParticles& particles, int number) {
  return number < 0 ? Column() : particles.fields[static_cast<std::size_t>(number)];
}

// Loose particles of all parts; none where they stay in the snapshot.
Particles particles_in_order(const std::vector<TreeOfComponent::Part>& parts, const Vec3& origin) {
  const bool are_there = std::all_of(parts.begin(), parts.end(),
                                     [](const auto& part) { return part.tree->particles; });
  if (!are_there) return {};
  using Part = TreeOfComponent::Part;
  const auto all = [&parts](std::size_t width, const auto& column_of) {
    std::vector<ColumnOfType> columns;
    for (const Part& part : parts)
      columns.push_back({column_of(part), static_cast<std::size_t>(part.tree->order_count)});
    return joined(columns, width, false);
  };
  Particles particles;
  for (const Part& part : parts)
    particles.count += static_cast<std::size_t>(part.tree->order_count);
  particles.origin = origin;
  particles.position = all(3, [](const Part& part) { return part.tree->particles->position; });
  particles.smoothing_length =
      all(1, [](const Part& part) { return part.tree->particles->smoothing_length; });
  particles.weight = all(1, [](const Part& part) { return part.tree->particles->weight; });
  particles.color =
      all(1, [](const Part& part) { return field_in(*part.tree->particles, part.color); });
  particles.intensity =
      all(1, [](const Part& part) { return field_in(*part.tree->particles, part.intensity); });
  return particles;
}

// Null where all particles have to be looked at; ranks do that together.
const TreeOfType* tree_with_sample(const Snapshot& snapshot, int type) {
  const TreeOfType* const tree =
      has_shared_passes(snapshot) ? nullptr : known_tree(snapshot, type).get();
  if (tree == nullptr || !tree->sample) return nullptr;
  const bool is_of_use =
      tree->sample->stride == least_sample_stride(static_cast<std::size_t>(tree->count)) &&
      tree->sample->origin == snapshot.position_origin();
  return is_of_use ? tree : nullptr;
}

// Of a field that the sample has, or of positions.
std::optional<Column> kept_values(const TreeOfType& tree, const std::string& field) {
  const ParticleSample& sample = *tree.sample;
  if (field == "position") return sample.particles.position;
  if (const std::optional<int> number = field_of(tree.fields, field))
    return field_in(sample.particles, *number);
  const auto& names = sample.other_names;
  const auto other = std::find(names.begin(), names.end(), field);
  if (other == names.end()) return std::nullopt;
  return sample.others[static_cast<std::size_t>(other - names.begin())];
}

// None for several types, whose particles are sampled together.
void take_sample(const Snapshot& snapshot, TreeOfComponent& tree) {
  if (tree.parts.size() != 1) return;
  const TreeOfComponent::Part& part = tree.parts.front();
  if (tree_with_sample(snapshot, part.tree->type) == nullptr) return;
  const ParticleSample& sample = *part.tree->sample;
  const StoredParticles& stored = sample.particles;
  Particles& particles = tree.sample;
  particles.count = stored.smoothing_length.size();
  particles.origin = sample.origin;
  particles.position = stored.position;
  particles.smoothing_length = stored.smoothing_length;
  particles.weight = stored.weight;
  particles.color = field_in(stored, part.color);
  particles.intensity = field_in(stored, part.intensity);
  tree.sample_stride = sample.stride;
}

// In place of what they were, whose origin changes.
void wrap_around(const Vec3& center, const BoxSides& periodic_box, Particles& particles) {
  constexpr bool streams = true;  // only what is looked at is wrapped
  particles.position =
      wrapped_positions(Vec3(particles.origin - center), periodic_box, particles.position, streams);
  particles.origin = center;
}

}  // namespace

std::shared_ptr<const TreeOfComponent> component_tree(const Component& component,
                                                      const Snapshot& snapshot,
                                                      const std::vector<int>& types,
                                                      WeightModel weight) {
  const bool is_in_place = !component.placement.moves() && !component.size_fixed &&
                           component.color_vector.empty() &&
                           canonical_field_name(component.size_field) == "smoothing_length";
  if (!is_in_place) return nullptr;
  auto tree = std::make_shared<TreeOfComponent>();
  std::uint64_t first = 0, first_in_order = 0;
  for (const int type : types) {
    const auto known = known_tree(snapshot, type);
    if (!known || known->weight != weight) return nullptr;
    const std::optional<int> color = field_of(known->fields, component.color.field);
    const std::optional<int> intensity = field_of(known->fields, component.intensity.field);
    if (!color || !intensity) return nullptr;
    const bool has_order = known->order != nullptr || known->order_count == 0;
    if (!has_order && !known->particles) return nullptr;
    tree->parts.push_back({known, first, *color, *intensity, first_in_order});
    first += known->count;
    first_in_order += known->order_count;
  }
  tree->in_order = particles_in_order(tree->parts, snapshot.position_origin());
  take_sample(snapshot, *tree);
  return tree;
}

std::shared_ptr<const TreeOfComponent> wrapped_tree(const TreeOfComponent& tree, const Vec3& center,
                                                    const BoxSides& periodic_box) {
  auto wrapped = std::make_shared<TreeOfComponent>(tree);
  wrapped->center = center;
  for (std::size_t axis = 0; axis < 3; ++axis)
    wrapped->period.a[axis] = periodic_box[axis];
  wrap_around(center, periodic_box, wrapped->in_order);
  wrap_around(center, periodic_box, wrapped->sample);
  return wrapped;
}

ValuesToSample values_to_sample(const Snapshot& snapshot, int type, const std::string& field) {
  if (const TreeOfType* const tree = tree_with_sample(snapshot, type)) {
    const ParticleSample& sample = *tree->sample;
    const auto kept = kept_values(*tree, field);
    if (kept) {
      return {*kept, static_cast<std::size_t>(sample.stride),
              ParticlePass(sample.particles.smoothing_length.size())};
    }
  }
  return {snapshot.read(type, field), 1, pass_over(snapshot, type)};
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

namespace {

bool draws(const Component& component, int type) {
  const auto& types = component.types;
  return std::find(types.begin(), types.end(), type) != types.end();
}

}  // namespace

std::vector<std::string> fields_shown(const Scene& scene, int type) {
  std::set<std::string> fields;
  for (const Component& component : scene.components) {
    if (!draws(component, type)) continue;
    for (const FieldMap* const map : {&component.color, &component.intensity}) {
      if (!map->field.empty()) fields.insert(map->field);
    }
  }
  return {fields.begin(), fields.end()};
}

std::optional<ColorRule> colors_shown(const DecidedScene& decided, int type,
                                      const std::vector<std::string>& fields) {
  const std::vector<Component>& components = decided.scene.components;
  const auto found =
      std::find_if(components.begin(), components.end(),
                   [type](const Component& component) { return draws(component, type); });
  if (found == components.end() || !found->color_vector.empty()) return std::nullopt;
  const std::optional<int> color = field_of(fields, found->color.field);
  const std::optional<int> intensity = field_of(fields, found->intensity.field);
  if (!color || !intensity) return std::nullopt;
  Palette palette = choose_palette(*found);
  if (palette.has_own_absorption()) return std::nullopt;
  const auto c = static_cast<std::size_t>(found - components.begin());
  return ColorRule{*color, *intensity, decided.components[c].color, decided.components[c].intensity,
                   std::move(palette)};
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

namespace {

// Those that suggest_scene() looks at, and that are no tree's.
std::vector<std::string> fields_to_sample(const Snapshot& snapshot, const TreeSource& source) {
  static_assert(std::size(fields_of_suggestions) <= ParticleSample::most_others);
  const ParticleTypeInfo& info = *snapshot.info().find_type(source.type);
  std::vector<std::string> others;
  for (const char* const name : fields_of_suggestions) {
    const bool is_known = std::any_of(source.fields.begin(), source.fields.end(),
                                      [name](const auto& field) { return field.name == name; });
    const FieldInfo* const field = find_field(info, name);
    if (!is_known && field != nullptr && field->values_per_particle == 1) others.emplace_back(name);
  }
  return others;
}

}  // namespace

std::optional<ParticleSample> sample_to_keep(const Snapshot& snapshot, const TreeSource& source) {
  // A sample of fewer would be more than a few per cent of their tree.
  constexpr std::size_t least_stride = 64;
  const auto count = static_cast<std::size_t>(source.count);
  const std::size_t stride = least_sample_stride(count);
  if (stride < least_stride) return std::nullopt;
  Places places(ceil_divide(count, stride));
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = i * stride;
  const auto picked = [&places](const Column& column, std::size_t width) {
    return picked_column(column, width, places, run_on_all_cores);
  };
  ParticleSample sample;
  sample.stride = stride;
  sample.origin = source.origin;
  StoredParticles& particles = sample.particles;
  particles.position = picked(source.position, 3);
  particles.smoothing_length = picked(source.smoothing_length, 1);
  particles.weight = picked(source.weights, 1);
  for (const TreeSource::Field& field : source.fields)
    particles.fields.push_back(picked(field.values, 1));
  for (const std::string& name : fields_to_sample(snapshot, source)) {
    sample.other_names.push_back(name);
    sample.others.push_back(picked(snapshot.read(source.type, name), 1));
  }
  return sample;
}

}  // namespace splotchcl
