#pragma once

#include <functional>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

struct Scene;

// What is followed, in one snapshot.
struct FollowedMoment {
  double index = 0;  // the snapshot's
  Vec3 center = {{0, 0, 0}};
  Vec3 up = {{0, 0, 0}};  // its angular momentum, of length 1; 0: not asked for
};

// Where it is at all times of a film.
class FollowedWay {
 public:
  // Between the moments: the earlier one, on straight lines, or on one smooth curve.
  enum class Kind { steps, straight, smooth };

  // At least one moment, by rising index. In a periodic box each center is the image nearest to the
  // one before, so that the way goes on beyond faces.
  FollowedWay(std::vector<FollowedMoment> moments, double radius, Kind kind);

  // At an index of the sequence.
  Vec3 center(double index) const;
  Vec3 up(double index) const;
  // In the snapshot in which it was chosen.
  double radius() const { return radius_; }

 private:
  std::function<Vec3(double)> center_, up_;
  double radius_;
};

// Finds what the scene's path follows, for a film in which all of these indices are drawn.
using FindFollowed =
    std::function<FollowedWay(const Scene& scene, const std::vector<double>& indices)>;

}  // namespace splotchcl
