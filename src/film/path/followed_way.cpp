#include "film/path/followed_way.h"

#include <cstddef>
#include <utility>

#include "scene/curves.h"

namespace splotchcl {
namespace {

std::function<Vec3(double)> curve_through(const std::vector<FollowedMoment>& moments,
                                          FollowedWay::Kind kind) {
  std::vector<double> knots;
  for (const FollowedMoment& moment : moments)
    knots.push_back(moment.index);
  std::vector<Spline> axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const FollowedMoment& moment : moments)
      values.push_back(moment.center.a[axis]);
    axes.emplace_back(knots, values,
                      kind == FollowedWay::Kind::smooth ? SplineKind::natural : SplineKind::linear);
  }
  if (kind == FollowedWay::Kind::steps) {
    return [moments](double index) {
      std::size_t last = 0;
      while (last + 1 < moments.size() && moments[last + 1].index <= index)
        ++last;
      return moments[last].center;
    };
  }
  return [axes = std::move(axes)](double index) {
    return Vec3{{axes[0].at(index), axes[1].at(index), axes[2].at(index)}};
  };
}

std::function<Vec3(double)> turn_through(const std::vector<FollowedMoment>& moments) {
  std::vector<double> knots;
  std::vector<Vec3> directions;
  for (const FollowedMoment& moment : moments) {
    knots.push_back(moment.index);
    directions.push_back(moment.up);
  }
  if (!(boost::qvm::mag(directions.front()) > 0)) return [](double) { return Vec3{{0, 0, 0}}; };
  const DirectionTrack track(knots, directions, true);
  return [track](double index) { return track.at(index); };
}

}  // namespace

FollowedWay::FollowedWay(std::vector<FollowedMoment> moments, double radius, Kind kind)
    : center_(curve_through(moments, kind)), up_(turn_through(moments)), radius_(radius) {}

Vec3 FollowedWay::center(double index) const {
  return center_(index);
}

Vec3 FollowedWay::up(double index) const {
  return up_(index);
}

}  // namespace splotchcl
