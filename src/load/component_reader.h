#pragma once

#include <optional>

#include "load/component_fields.h"
#include "splotchcl/frame.h"
#include "splotchcl/scene.h"

namespace splotchcl {

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
