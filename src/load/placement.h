#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/particle_columns.h"
#include "splotchcl/frame.h"
#include "splotchcl/particles.h"
#include "splotchcl/periodic.h"
#include "splotchcl/scene.h"
#include "splotchcl/selection.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// Where the particles of a placed component lie: x' = placed_origin + placed position, the
// sum in double precision (selection.h, Placement). `origin` is that of the positions.
Vec3 placed_origin(const Placement& placement, const Vec3& center, const Vec3& origin);

// Positions relative to placed_origin(), held in memory or made as they are wanted. A placement
// that neither turns nor scales moves the origin alone, and this is the column itself.
Column placed_positions(const Placement& placement, const Vec3& center, const Vec3& origin,
                        const Column& position, bool streams = false);

// Whether the column stays as it is.
bool only_moves(const Placement& placement);

// By Rodrigues' formula, right-handed.
Vec3 rotated(const Vec3& v, const Vec3& axis, double angle_degrees);

// Of particles: how far from their origin one lies along an axis, and the least of their smoothing
// lengths above 0. What is not finite does not count.
struct PlaceExtremes {
  PlaceExtremes();

  float largest_offset = 0, smallest_length;

  void take(const PlaceExtremes& other);
};

// Whether positions are offsets from an origin that is not 0.
bool are_offsets(const Particles& particles);

PlaceExtremes find_extremes(const Particles& particles, const ParticlePass& pass);

// Whether there may be something to tell of rounded positions; else nobody need look.
bool may_be_rounded(const PlaceExtremes& extremes, double size_factor);

// A note where positions were stored as doubles, as offsets from an origin that is not 0, and the
// spacing of single precision there is more than a tenth of the size h that is drawn: how many
// particles, and how much of h at worst. Nothing where all lie as they should, or as the file has
// them.
std::optional<std::string> tell_rounded_positions(const DrawnComponent& component,
                                                  const ParticlePass& pass);

// The box that periodic.wrap uses. Throws UsageError where neither the scene nor
// the snapshot says one.
BoxSides periodic_box(const PeriodicSettings& settings, const SnapshotInfo& snapshot);

// Whether it is a part of the periodic box: what is placed elsewhere is not.
bool is_in_the_box(const Component& component);

// Positions relative to a center, each particle at its periodic image nearest to that, along each
// axis by itself: d = x + shift becomes d - side * round(d / side), in double precision, where
// `shift` leads from the origin of the positions to the center. Values that are not finite stay so.
// Held in memory, or made as they are wanted.
Column wrapped_positions(const Vec3& shift, const BoxSides& box, const Column& position,
                         bool streams = false);

// Whether particles lie in the periodic box that their snapshot's header names: a header's box may
// be that of the run that a cutout is of, or mean nothing.

// Between which coordinates particles lie; lowest above highest where there are none.
struct PositionExtent {
  PositionExtent();

  Vec3 lowest, highest;
  std::uint64_t particles = 0;  // at finite positions

  bool is_empty() const { return particles == 0; }
  double span(std::size_t axis) const { return highest.a[axis] - lowest.a[axis]; }
  void take(const PositionExtent& other);
};

// Of all particles of a type. Found once for a snapshot.
PositionExtent extent_of_type(const Snapshot& snapshot, int type);

// Whether all lie within one period, wherever that begins: along each axis they span no more than
// its side, but for the rounding of single precision.
bool lies_in_one_period(const PositionExtent& extent, const BoxSides& box);

// Whether they reach over half of the box along the axis, so that what shows the box shows them.
// Too few to tell do.
bool fills_box(const PositionExtent& extent, const BoxSides& box, std::size_t axis);

// The middle of the period that the particles lie in: of the box from 0, of one around 0, or else
// of the particles themselves.
Vec3 middle_of_period(const PositionExtent& extent, const BoxSides& box);

// The periodic box of particles, and where they lie in it.
struct PeriodicRegion {
  std::optional<BoxSides> box;  // unset: there is none
  PositionExtent extent;        // of the snapshot's particles, as far as they were looked at
};

// All particles of these types are looked at, and a sample of each other type.
PositionExtent find_extent(const Snapshot& snapshot, const std::vector<int>& types);

// "the box of 1 in the header is not used: ..."
std::string tell_box_is_not_used(const BoxSides& box, const PositionExtent& extent);

}  // namespace splotchcl
