#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "load/type_fields.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// Indices of particles in their type's columns, in increasing order.
using ParticleIndices = std::vector<std::size_t>;

// The particles that component.select and component.exclude leave of a type; null where
// the component has neither, and all are drawn. Spheres reach across the faces of a periodic box,
// unless its side is 0. Found once per snapshot. Throws UsageError for a field that the type does
// not have, DataError for ids and catalogs that cannot be read.
std::shared_ptr<const ParticleIndices> select_particles(
    const Component& component, const TypeFields& fields, const Snapshot& snapshot,
    const std::optional<BoxSides>& periodic_box = std::nullopt);

// Refuses, before anything is read, what select_particles() would.
void check_selection(const Component& component, const TypeFields& fields,
                     const Snapshot& snapshot);

// Which catalog of haloes is used without having been named, as a note; empty where none is.
std::string tell_found_catalog(const Component& component, const TypeFields& fields,
                               const Snapshot& snapshot);

// How many of the ids that the component lists no particle of its types has, as a note; empty where
// all are there. Found once per snapshot, which must be whole.
std::string tell_lost_ids(const Component& component, const std::vector<TypeFields>& types,
                          const Snapshot& snapshot);

// The field that tells wind from stars where these particles of IllustrisTNG hold both; null where
// they do not, or where the component has a condition of its own on it.
const FieldInfo* find_wind(const Component& component, const ParticleTypeInfo& type);

// The text that stands for the component's selection where it is remembered.
std::string selection_key(const Component& component, const std::optional<BoxSides>& periodic_box);

// What is selected of a column with `width` values per particle, held in memory or made as it is
// wanted; the column itself where `selected` is null or it is the same for all.
Column gather(const Column& column, const std::shared_ptr<const ParticleIndices>& selected,
              std::size_t width, bool streams);

}  // namespace splotchcl
