#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "between/interpolation.h"
#include "snapshot/derived_snapshots.h"
#include "splotchcl/sequence.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// How stored velocities become changes of the stored positions: over a time of the runs, or
// over the scale factor, with dx/da = u a^p / (a^2 H(a)) (docs/time.md).
struct Motion {
  double first_time = 0, second_time = 0;  // or scale factors
  double first_rate = 1, second_rate = 1;  // factors on stored velocities
};

// Throws UsageError where the snapshots do not tell enough, or are of the same time.
Motion find_motion(const SnapshotInfo& first, const SnapshotInfo& second,
                   const SequenceSettings& settings);

// H(a) in units of H0, of a universe of matter, curvature and a cosmological constant.
double expansion_rate(double scale_factor, double omega_matter, double omega_lambda);

// One snapshot's part of a path.
struct PathEnd {
  Column position;
  Vec3 origin = {{0, 0, 0}};
  Column velocity;  // absent: straight lines
  double rate = 0;  // velocity * rate is the tangent: the path's change over the interval
};

// How one type's particles get from one snapshot to the other. With a period, each particle takes
// the shorter way and stays inside. With velocities, the path is the cubic with the tangents m of
// both ends:
//   x0 + (3 f^2 - 2 f^3) (x1 - x0) + (f - 2 f^2 + f^3) m0 + (f^3 - f^2) m1
// and particles that vanish or appear move on straight along their tangent.
struct TypePath {
  PathEnd first, second;
  std::optional<PeriodicRange> period;
  std::string note;  // what a user should know of it; mostly nothing
};

// Positions at a fraction of the way, relative to first.origin.
ColumnBetween interpolate_positions(const TypePath& path, std::shared_ptr<const IdMatch> match,
                                    double fraction);

// A period from 0 or around 0, whichever holds more of both snapshots' particles, and how many lie
// farther beside it than a hundredth of its side.
struct FoundPeriod {
  PeriodicRange range;
  std::uint64_t outside = 0, particles = 0;

  // A box is that of the particles unless more than a hundredth of them lie elsewhere.
  bool is_of_particles() const { return 100 * outside <= particles; }
};

FoundPeriod find_period(const BoxSides& box, const PathEnd& first, const PathEnd& second);

// How well velocities fit displacements: the root mean square of the mean tangents over that
// of the displacements, of particles in both. Nothing where none moves.
std::optional<double> tangent_ratio(const TypePath& path, const IdMatch& match);

// A field of a particle type.
using TypeField = std::pair<int, std::string>;

// One snapshot of a sequence: its columns are read once. May be used by several threads.
class SequenceMember : public DerivedSnapshot {
 public:
  explicit SequenceMember(std::unique_ptr<Snapshot> snapshot)
      : DerivedSnapshot(std::move(snapshot)) {}

  Column read(int type, const std::string& field) const override;

  std::set<TypeField> fields_read() const;  // by canonical names

 private:
  mutable std::mutex mutex_;
  mutable std::map<TypeField, Column> columns_;
};

// Two snapshots that follow each other, with their particles matched.
class SnapshotPair {
 public:
  // Columns of a type that a snapshot does not have are absent.
  const TypePath& path(int type) const;  // read at the first call

  std::shared_ptr<const SequenceMember> first, second;
  std::map<int, std::shared_ptr<const IdMatch>> matches;  // of every type that either has
  std::optional<BoxSides> box;                            // periodic
  std::optional<Motion> motion;                           // with hermite
  std::vector<std::string> notes;

 private:
  PathEnd path_end(const SequenceMember& member, int type, double rate) const;

  mutable std::mutex mutex_;
  mutable std::map<int, TypePath> paths_;
};

// A column of a member, absent where the member has nothing of the type.
Column read_or_nothing(const SequenceMember& member, int type, const std::string& field);

// Matches the particles of all types. `box` is periodic; unset: as both headers say. Throws
// DataError when the two have none in common or no ids, UsageError when there are no velocities for
// hermite.
std::shared_ptr<const SnapshotPair> make_pair(std::shared_ptr<const SequenceMember> first,
                                              std::shared_ptr<const SequenceMember> second,
                                              const SequenceSettings& settings,
                                              const std::optional<BoxSides>& box = {});

// For snapshots without a particle in common.
[[noreturn]] void refuse_strangers(const SnapshotInfo& first, const SnapshotInfo& second);

}  // namespace splotchcl
