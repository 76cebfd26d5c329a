#pragma once

#include <list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "load/component_fields.h"
#include "load/missing_sizes.h"
#include "splotchcl/frame.h"
#include "splotchcl/palette.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// What a component shines and absorbs in; white where particles have colors of their own. Throws
// UsageError for a palette that there is not.
Palette choose_palette(const Component& component);

// Says that without a field all of a component's particles have the first color of its palette, if
// that is much darker than the palette's others.
std::optional<std::string> tell_dark_color(const Component& component, const Palette& palette);

// Reads the particles of one component when they are first asked for, and once. Refers to the
// component and its fields.
class ComponentReader {
 public:
  ComponentReader(const Component& component, const SortOrder& sort, ComponentFields& fields)
      : component_(component), sort_(sort), fields_(fields) {}

  const Component& component() const { return component_; }
  const ComponentFields& fields() const { return fields_; }

  // The scene's, or the one that suits the snapshot. Reads nothing.
  WeightModel weight() const;
  bool has_read() const { return is_selected_; }
  // Of the particles that are selected.
  std::size_t count();
  // One value per particle; absent where the component names no field.
  const Column& color();
  const Column& intensity();
  // As ComponentFields has it, for weight().
  const std::shared_ptr<const TreeOfComponent>& tree(WeightModel weight);
  // The component with all of its particles, but for ranges and the reference column.
  DrawnComponent drawn(WeightModel weight);
  // The same without its particles, of which nothing is read.
  DrawnComponent dark(WeightModel weight) const;

 private:
  void select();
  const Column& read_once(std::optional<Column>& column, const std::string& field, const char* key);
  Column weights(WeightModel weight) const;

  const Component& component_;
  const SortOrder& sort_;
  ComponentFields& fields_;
  bool is_selected_ = false;
  std::optional<Column> color_, intensity_;
  std::optional<std::shared_ptr<const TreeOfComponent>> tree_;
};

// The components of a scene with their snapshots. Refuses whatever can be refused before any
// particle is read. Refers to the scene, the snapshot and the notes.
class OpenComponents {
 public:
  // Throws UsageError, or DataError for snapshots of components that cannot be opened.
  // `periodic_box` is the box that particles are wrapped into.
  OpenComponents(const Scene& scene, const Snapshot& snapshot, const MissingSizes& sizes,
                 std::vector<std::string>& notes,
                 const std::optional<BoxSides>& periodic_box = std::nullopt);

  // A frame is loaded from now on: what the snapshots remember and frames no longer ask for is
  // forgotten.
  void begin_load();

  // In the order of the scene's components.
  std::list<ComponentFields>& fields() { return fields_; }

 private:
  std::vector<std::shared_ptr<const Snapshot>> companions_;
  std::set<const Snapshot*> sources_;
  std::list<ComponentFields> fields_;
};

// Throws UsageError for a scene that leaves its components to a look, which only opening it with
// its snapshot chooses (open_scene).
void require_chosen_components(const Scene& scene);

}  // namespace splotchcl
