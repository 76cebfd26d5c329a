#pragma once

#include <string>
#include <vector>

#include "load/component_fields.h"
#include "map/geometry.h"
#include "map/velocity_channels.h"
#include "splotchcl/map_settings.h"

namespace splotchcl {

// What is summed for a map: for each particle of the matter a weight, and a value.
struct MapQuantity {
  enum class Kind { column, counts, mean, dispersion, integral };
  Kind kind = Kind::column;
  Column weight;  // >= 0: mass, volume, 1, or a field
  double weight_unit = 1;
  Column value;  // of mean, dispersion and integral
  std::string description;
  VelocityChannels channels;  // of a sum

  // Whether a particle has a weight, and a value where that is wanted.
  bool is_good(std::size_t i) const;
};

// Reads no particles: refuses settings that contradict each other.
void check_quantity(const MapSettings& settings);

// `type` is one of the particles'. Throws UsageError for fields that the particles do not have,
// DataError for weights below 0.
MapQuantity read_quantity(const MapSettings& settings, const MapGeometry& geometry,
                          const ComponentFields& fields, int type, std::size_t count);

}  // namespace splotchcl
