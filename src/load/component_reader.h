#pragma once

#include <optional>
#include <string>

#include "load/component_fields.h"
#include "splotchcl/frame.h"
#include "splotchcl/palette.h"
#include "splotchcl/scene.h"

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
  // The component with all of its particles, but for ranges and the reference column.
  DrawnComponent drawn(WeightModel weight);

 private:
  void select();
  const Column& read_once(std::optional<Column>& column, const std::string& field, const char* key);
  Column weights(WeightModel weight) const;

  const Component& component_;
  const SortOrder& sort_;
  ComponentFields& fields_;
  bool is_selected_ = false;
  std::optional<Column> color_, intensity_;
};

}  // namespace splotchcl
