#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "load/component_fields.h"
#include "map/geometry.h"
#include "splotchcl/map_settings.h"

namespace splotchcl {

// Channels of equal width in the velocity along the line of sight, in the snapshot's unit.
struct VelocityChannels {
  int count = 0;  // 0: there are none
  double first_edge = 0, width = 0;
  Column velocity;  // positive: away from who looks
  // Lines are exp(-(v / b)^2) around it; absent: all of a particle has one velocity.
  Column thermal;

  bool is_good(std::size_t i) const;
  // Of a particle, how much lies in a channel.
  double part(std::size_t i, int channel) const;
};

// Throws UsageError where lines are to be broadened and the unit of velocities is not known.
VelocityChannels read_channels(const MapSettings& settings, const MapGeometry& geometry,
                               const ComponentFields& fields, int type, std::size_t count);

// Positive for what moves away from who looks at the map; `key` is the scene's that asked for it.
Column velocities_along(const Vec3& forward, const ComponentFields& fields, std::size_t count,
                        const char* key);

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
