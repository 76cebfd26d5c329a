#include "io/load/load_frame_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/common/nearest_name.h"
#include "io/load/smoothing_lengths.h"
#include "io/snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The columns of several types, one after the other. `values_per_particle` is 3 for
// positions.
Column joined(const std::vector<Column>& columns, const std::vector<const ParticleTypeInfo*>& types,
              std::size_t values_per_particle = 1) {
  if (columns.size() == 1) return columns.front();
  const Column& first = columns.front();
  const bool all_the_same =
      std::all_of(columns.begin(), columns.end(), [&first](const Column& column) {
        return column.is_uniform() && column.uniform_value() == first.uniform_value();
      });
  if (all_the_same) return first;
  std::size_t total = 0;
  for (const ParticleTypeInfo* const type : types)
    total += static_cast<std::size_t>(type->count);
  std::vector<float> values;
  values.reserve(total * values_per_particle);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::size_t size = static_cast<std::size_t>(types[k]->count) * values_per_particle;
    const Column& column = columns[k];
    if (column.is_uniform()) {
      values.insert(values.end(), size, column.uniform_value());
    } else {
      values.insert(values.end(), column.data(), column.data() + size);
    }
  }
  return Column::owning(std::move(values));
}

bool all_are_sizes(const Column& column) {
  return std::all_of(column.data(), column.data() + column.size(),
                     [](float h) { return std::isfinite(h) && h > 0; });
}

Column lengths_of_vectors(const Column& vectors) {
  std::vector<float> lengths(vectors.size() / 3);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    lengths[i] = std::hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]);
  }
  return Column::owning(std::move(lengths));
}

}  // namespace

ComponentFields::ComponentFields(const Component& component, const Snapshot& snapshot,
                                 std::vector<std::string>& notes)
    : component_(component), snapshot_(snapshot), notes_(notes) {
  for (const int type : component.types) {
    const ParticleTypeInfo* const info = snapshot.info().find_type(type);
    if (info != nullptr) {
      types_.push_back(info);
    } else if (component.types.size() > 1) {
      note(fmt::format("the snapshot has no particles of type {}", type));
    }
  }
  if (types_.empty()) refuse_types();
}

void ComponentFields::refuse_types() const {
  std::vector<int> present;
  for (const ParticleTypeInfo& type : snapshot_.info().types)
    present.push_back(type.type);
  throw UsageError(
      fmt::format("{}: {} has no particles of type {}, expected types with particles: {}", label(),
                  snapshot_.info().files.front().string(), fmt::join(component_.types, " or "),
                  fmt::join(present, ", ")));
}

std::size_t ComponentFields::count() const {
  std::size_t count = 0;
  for (const ParticleTypeInfo* const type : types_)
    count += static_cast<std::size_t>(type->count);
  return count;
}

Column ComponentFields::positions() const {
  std::vector<Column> columns;
  for (const auto* type : types_)
    columns.push_back(snapshot_.read(type->type, "position"));
  return joined(columns, types_, 3);
}

Column ComponentFields::scalars(const std::string& field, const std::string& key) const {
  std::vector<Column> columns;
  for (const auto* type : types_)
    columns.push_back(scalars_of_type(*type, field, key));
  return joined(columns, types_);
}

Column ComponentFields::vectors(const std::string& field, const std::string& key) const {
  std::vector<Column> columns;
  for (const auto* type : types_) {
    const FieldInfo* const info = find_field(*type, field);
    if (info == nullptr) refuse_field(*type, field, key);
    if (info->values_per_particle != 3) {
      throw UsageError(fmt::format(
          "{}: {} is \"{}\", which has {} value{} per particle, expected a field with 3", label(),
          key, field, info->values_per_particle, info->values_per_particle == 1 ? "" : "s"));
    }
    columns.push_back(snapshot_.read(type->type, field));
  }
  return joined(columns, types_, 3);
}

bool ComponentFields::masses_are_known() const {
  return std::all_of(types_.begin(), types_.end(),
                     [](const ParticleTypeInfo* type) { return has_masses(*type); });
}

Column ComponentFields::masses() const {
  std::vector<Column> columns;
  for (const auto* type : types_)
    columns.push_back(masses_of_type(*type));
  return joined(columns, types_);
}

Column ComponentFields::smoothing_lengths() const {
  if (component_.size_fixed) return Column::uniform(static_cast<float>(*component_.size_fixed));
  std::vector<Column> columns;
  for (const auto* type : types_) {
    columns.push_back(canonical_field_name(component_.size_field) == "smoothing_length"
                          ? smoothing_lengths_of_type(*type)
                          : scalars_of_type(*type, component_.size_field, "size.field"));
  }
  return joined(columns, types_);
}

Column ComponentFields::scalars_of_type(const ParticleTypeInfo& type, const std::string& field,
                                        const std::string& key) const {
  const FieldInfo* const info = find_field(type, field);
  if (info == nullptr) {
    const std::string canonical = canonical_field_name(field);
    if (canonical == "smoothing_length") return smoothing_lengths_of_type(type);
    if (canonical == "density") return densities_of_type(type);
    if (canonical == "mass" && type.table_mass) return masses_of_type(type);
    refuse_field(type, field, key);
  }
  const Column column = snapshot_.read(type.type, field);
  if (info->values_per_particle == 1) return column;
  if (info->values_per_particle == 3) {
    return snapshot_.derived(type.type, "length of " + info->name,
                             [&] { return lengths_of_vectors(column); });
  }
  throw UsageError(fmt::format(
      "{}: {} is \"{}\", which has {} values per particle, expected a field with 1 or 3", label(),
      key, field, info->values_per_particle));
}

void ComponentFields::refuse_field(const ParticleTypeInfo& type, const std::string& field,
                                   const std::string& key) const {
  std::vector<std::string> names;
  for (const FieldInfo& known : type.fields)
    names.push_back(known.name);
  throw UsageError(fmt::format(
      "{}: {} is \"{}\", which particles of type {} in {} do not have, expected one of {}{}",
      label(), key, field, type.type, snapshot_.info().files.front().string(),
      fmt::join(names, ", "), did_you_mean(nearest_name(field, names))));
}

Column ComponentFields::masses_of_type(const ParticleTypeInfo& type) const {
  if (find_field(type, "mass") != nullptr) return snapshot_.read(type.type, "mass");
  if (type.table_mass) return Column::uniform(static_cast<float>(*type.table_mass));
  throw UsageError(fmt::format(
      "{}: weight is \"mass\", but particles of type {} in {} have no masses; set weight to "
      "\"constant\"",
      label(), type.type, snapshot_.info().files.front().string()));
}

Column ComponentFields::densities_of_type(const ParticleTypeInfo& type) const {
  const Column mass = has_masses(type) ? masses_of_type(type) : Column::uniform(1);
  const Column h = smoothing_lengths_of_type(type);
  note(fmt::format("type {} has no density in the file; estimated from its smoothing lengths",
                   type.type));
  return snapshot_.derived(type.type, "density", [&] {
    return densities_from_smoothing_lengths(mass, h, static_cast<std::size_t>(type.count));
  });
}

Column ComponentFields::smoothing_lengths_of_type(const ParticleTypeInfo& type) const {
  if (find_field(type, "smoothing_length") != nullptr) {
    return snapshot_.read(type.type, "smoothing_length");
  }
  const auto found = found_lengths_.find(type.type);
  if (found != found_lengths_.end()) return found->second;
  return found_lengths_[type.type] =
             snapshot_.derived(type.type, "smoothing_length", [&] { return find_lengths(type); });
}

Column ComponentFields::find_lengths(const ParticleTypeInfo& type) const {
  const std::size_t count = static_cast<std::size_t>(type.count);
  const char* reason = "";
  if (has_masses(type) && find_field(type, "density") != nullptr) {
    const Column lengths = smoothing_lengths_from_density(
        masses_of_type(type), snapshot_.read(type.type, "density"), count);
    if (all_are_sizes(lengths)) {
      note(fmt::format(
          "type {} has no smoothing lengths in the file; they follow from density and mass",
          type.type));
      return lengths;
    }
    reason = ", and some of its densities or masses are not above 0";
  }
  note(
      fmt::format("type {} has no smoothing lengths in the file{}; each particle is given one that "
                  "reaches to neighbour {}",
                  type.type, reason, particles_in_sphere));
  const Column position = snapshot_.read(type.type, "position");
  return find_smoothing_lengths(position, count, periodic_box(position));
}

// The box of the header, unless particles lie outside of one period of it.
std::optional<double> ComponentFields::periodic_box(const Column& position) const {
  const std::optional<double> box = snapshot_.info().box_size;
  if (!box || !(*box > 0)) return std::nullopt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float lowest = std::numeric_limits<float>::infinity();
    float highest = -lowest;
    for (std::size_t i = axis; i < position.size(); i += 3) {
      if (!std::isfinite(position[i])) continue;
      lowest = std::min(lowest, position[i]);
      highest = std::max(highest, position[i]);
    }
    if (static_cast<double>(highest) - static_cast<double>(lowest) > *box) return std::nullopt;
  }
  return box;
}

void ComponentFields::note(const std::string& text) const {
  const std::string line = label() + ": " + text;
  // Two of a component's values may rest on the same fact.
  if (std::find(notes_.begin(), notes_.end(), line) == notes_.end()) notes_.push_back(line);
}

std::string ComponentFields::label() const {
  return "component " + component_.name;
}

}  // namespace splotchcl
