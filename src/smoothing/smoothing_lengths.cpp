#include "smoothing/smoothing_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>
#include <vector>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Index = std::uint32_t;  // half of what the tree needs per particle
using Point = std::array<float, 3>;
using Shift = std::array<double, 3>;

constexpr std::size_t block_size = 4096;
constexpr double fallback_fraction = 1e-3;
constexpr double unit_sphere = 4.188790204786391;  // 4 pi / 3

// The finite positions, as nanoflann asks for them.
class Cloud {
 public:
  Cloud(const float* positions, std::size_t count) : positions_(positions), size_(count) {
    std::vector<Index> finite;
    for (std::size_t i = 0; i < count; ++i) {
      const float* const p = positions + 3 * i;
      const bool is_finite = is_finite_position(p);
      if (!is_finite && !has_gaps_) {
        for (std::size_t j = 0; j < i; ++j)
          finite.push_back(static_cast<Index>(j));
        has_gaps_ = true;
      } else if (is_finite && has_gaps_) {
        finite.push_back(static_cast<Index>(i));
      }
    }
    if (!has_gaps_) return;
    finite_ = std::move(finite);
    size_ = finite_.size();
  }

  std::size_t particle(std::size_t point) const { return has_gaps_ ? finite_[point] : point; }
  const float* position(std::size_t point) const { return positions_ + 3 * particle(point); }

  std::size_t kdtree_get_point_count() const { return size_; }
  float kdtree_get_pt(std::size_t point, std::size_t axis) const { return position(point)[axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // nanoflann computes it
  }

 private:
  const float* positions_;
  std::size_t size_;
  bool has_gaps_ = false;
  std::vector<Index> finite_;  // only where some are not
};

// Distances in double: squares of lengths in centimetres leave single precision.
using Metric = nanoflann::L2_Simple_Adaptor<float, Cloud, double, Index>;
using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 3, Index>;

// The order of the points in the tree's leaves, whatever this version of nanoflann calls it.
template <class T>
auto leaf_order(const T& tree, int) -> decltype((tree.vAcc)) {
  return tree.vAcc;
}
template <class T>
auto leaf_order(const T& tree, long) -> decltype((tree.vAcc_)) {
  return tree.vAcc_;
}

// Keeps the k smallest squared distances, for nanoflann. More than k are collected before the
// largest are thrown away, all at once: that takes half the time of a heap.
class NearestDistances {
 public:
  using DistanceType = double;

  explicit NearestDistances(std::size_t k) : k_(k) { distances_.reserve(2 * k); }
  // Distances from `bound` on are not wanted.
  void start(std::size_t self, double bound) {
    self_ = self;
    worst_ = bound;
    distances_.clear();
  }
  void start_image() { self_ = std::numeric_limits<std::size_t>::max(); }

  std::size_t size() const { return distances_.size(); }
  bool full() const { return distances_.size() >= k_; }
  double worstDist() const { return worst_; }
  // False ends the search: nothing is nearer than where all k coincide with the particle, and
  // there may be any number that do.
  bool addPoint(double squared, std::size_t point) {
    if (point == self_ || squared >= worst_) return true;
    distances_.push_back(squared);
    if (distances_.size() == 2 * k_) drop_largest();
    return worst_ > 0;
  }

  // The k-th smallest. Infinite where there are not so many below the bound.
  double farthest() {
    if (!full()) return std::numeric_limits<double>::infinity();
    drop_largest();
    return worst_;
  }

 private:
  void drop_largest() {
    const auto last = distances_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
    std::nth_element(distances_.begin(), last, distances_.end());
    worst_ = *last;
    distances_.resize(k_);
  }

  std::size_t k_;
  std::size_t self_ = 0;
  double worst_ = 0;
  std::vector<double> distances_;
};

std::vector<Shift> image_shifts(const BoxSides& box) {
  std::vector<Shift> shifts;
  for (const double x : {-box[0], 0.0, box[0]}) {
    for (const double y : {-box[1], 0.0, box[1]}) {
      for (const double z : {-box[2], 0.0, box[2]}) {
        if (x != 0 || y != 0 || z != 0) shifts.push_back({x, y, z});
      }
    }
  }
  return shifts;
}

class NeighborSearch {
 public:
  NeighborSearch(const Cloud& cloud, const std::optional<BoxSides>& box)
      : cloud_(cloud), tree_(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    if (box) shifts_ = image_shifts(*box);
  }

  // The particle's squared distance to the last of the neighbours that `nearest` keeps, which is
  // below `bound`; infinite where it is not.
  double farthest_squared(std::size_t point, double bound, NearestDistances& nearest) const {
    const float* const position = cloud_.position(point);
    nearest.start(point, bound);
    tree_.findNeighbors(nearest, position, nanoflann::SearchParams());
    nearest.start_image();
    for (const Shift& shift : shifts_) {
      const Point image = shifted(position, shift);
      if (squared_distance_to_all(image) < nearest.worstDist()) {
        tree_.findNeighbors(nearest, image.data(), nanoflann::SearchParams());
      }
    }
    return nearest.farthest();
  }

  double distance(std::size_t point, std::size_t other) const {
    const float* const p = cloud_.position(point);
    const float* const q = cloud_.position(other);
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double difference = static_cast<double>(p[axis]) - static_cast<double>(q[axis]);
      squared += difference * difference;
    }
    return std::sqrt(squared);
  }

  // Neighbours in the order are neighbours in space, which keeps caches warm.
  std::size_t point_in_order(std::size_t i) const { return leaf_order(tree_, 0)[i]; }

  double extent() const {
    double extent = 0;
    for (const auto& side : tree_.root_bbox) {
      extent = std::max(extent, static_cast<double>(side.high) - static_cast<double>(side.low));
    }
    return extent;
  }

 private:
  static Point shifted(const float* position, const Shift& shift) {
    Point image;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      image[axis] = static_cast<float>(static_cast<double>(position[axis]) + shift[axis]);
    }
    return image;
  }

  // To the box around all particles.
  double squared_distance_to_all(const Point& point) const {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& side = tree_.root_bbox[axis];
      const double x = static_cast<double>(point[axis]);
      const double outside =
          std::max({0.0, static_cast<double>(side.low) - x, x - static_cast<double>(side.high)});
      squared += outside * outside;
    }
    return squared;
  }

  const Cloud& cloud_;
  Tree tree_;
  std::vector<Shift> shifts_;
};

// Finds squared distances of points that lie close to one another, one after the other. A point's
// neighbors are no farther than those of the point before and the way between both.
class NeighborWalk {
 public:
  NeighborWalk(const NeighborSearch& search, std::size_t neighbors)
      : search_(search), nearest_(neighbors) {}

  double farthest_squared(std::size_t point) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double bound = infinity;
    if (has_last_) {
      constexpr double rounding = 1 + 1e-5;  // of places in single precision, and below
      const double farthest = last_distance_ + search_.distance(last_, point);
      bound = rounding * farthest * farthest;
      if (bound == 0) bound = infinity;  // nothing is below 0
    }
    double squared = search_.farthest_squared(point, bound, nearest_);
    if (squared == infinity) squared = search_.farthest_squared(point, infinity, nearest_);
    has_last_ = true;
    last_ = point;
    last_distance_ = std::sqrt(squared);
    return squared;
  }

 private:
  const NeighborSearch& search_;
  NearestDistances nearest_;
  bool has_last_ = false;
  std::size_t last_ = 0;
  double last_distance_ = 0;
};

// Lengths of zero, of particles that coincide with all their neighbours, become `fallback`
// or the smallest length of another particle.
void replace_zeros(std::vector<float>& lengths, double fallback) {
  float smallest = std::numeric_limits<float>::infinity();
  for (const float length : lengths) {
    if (length > 0) smallest = std::min(smallest, length);  // false for not-a-number
  }
  if (!std::isfinite(smallest)) smallest = static_cast<float>(fallback);
  std::replace(lengths.begin(), lengths.end(), 0.0F, smallest);
}

// Blocks are those of one rank.
std::vector<std::size_t> begins_of_ranks(std::size_t points, int ranks) {
  const std::size_t blocks = ceil_divide(points, block_size);
  std::vector<std::size_t> begins;
  for (int rank = 0; rank <= ranks; ++rank) {
    const std::size_t block =
        blocks * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks);
    begins.push_back(std::min(points, block * block_size));
  }
  return begins;
}

void check(const Column& position, std::size_t count, int neighbors) {
  if (neighbors < 1) throw UsageError("smoothing lengths need at least one neighbour");
  if (!position.is_array() || position.size() != 3 * count) {
    throw DataError("smoothing lengths need three coordinates for each particle");
  }
  if (count >= std::numeric_limits<Index>::max()) {
    throw DataError(
        "smoothing lengths can be found for up to 4 billion particles; name a field that has them");
  }
}

}  // namespace

Column find_smoothing_lengths(const Column& position, std::size_t count,
                              const std::optional<BoxSides>& periodic_box, int neighbors,
                              const Progress& progress, const SearchShare& share) {
  check(position, count, neighbors);
  const Cloud cloud(position.data(), count);
  const std::size_t points = cloud.kdtree_get_point_count();
  std::vector<float> lengths(count, std::numeric_limits<float>::quiet_NaN());
  if (points == 0) return Column::owning(std::move(lengths));

  const NeighborSearch search(cloud, periodic_box);
  const std::size_t k = std::min(static_cast<std::size_t>(neighbors), points - 1);
  const std::vector<std::size_t> begins = begins_of_ranks(points, share.ranks);
  const auto rank = static_cast<std::size_t>(share.rank);
  const std::size_t begin = begins[rank];
  std::vector<float> in_order(points);
  for_blocks(
      begins[rank + 1] - begin, block_size,
      [&](std::size_t first, std::size_t last) {
        NeighborWalk walk(search, k);
        for (std::size_t i = begin + first; i < begin + last; ++i) {
          const double squared = k == 0 ? 0 : walk.farthest_squared(search.point_in_order(i));
          in_order[i] = static_cast<float>(std::sqrt(squared));
        }
      },
      progress);
  if (share.join) share.join(in_order, begins);
  for (std::size_t i = 0; i < points; ++i)
    lengths[cloud.particle(search.point_in_order(i))] = in_order[i];
  const double extent = std::max(search.extent(), periodic_box ? periodic_box->longest() : 0);
  replace_zeros(lengths, extent > 0 ? fallback_fraction * extent : 1);
  return Column::owning(std::move(lengths));
}

Column smoothing_lengths_from_volume(const Column& volume, std::size_t count, int neighbors,
                                     bool streams, double volume_unit) {
  return smoothing_lengths_from_density(volume, Column::uniform(1), count, neighbors, streams,
                                        1 / volume_unit);
}

Column smoothing_lengths_from_density(const Column& mass, const Column& density, std::size_t count,
                                      int neighbors, bool streams, double density_unit) {
  const auto make = [=](std::size_t begin, std::size_t end, float* lengths) {
    const ColumnStretch masses(mass, begin, end), densities(density, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const double volume = neighbors * static_cast<double>(masses[i]) /
                            (density_unit * static_cast<double>(densities[i]));
      *lengths++ = static_cast<float>(std::cbrt(volume / unit_sphere));
    }
  };
  return make_column(count, streams, make);
}

Column densities_from_smoothing_lengths(const Column& mass, const Column& smoothing_length,
                                        std::size_t count, double neighbors, bool streams) {
  const auto make = [=](std::size_t begin, std::size_t end, float* densities) {
    const ColumnStretch masses(mass, begin, end), lengths(smoothing_length, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const double h = static_cast<double>(lengths[i]);
      *densities++ = static_cast<float>(neighbors * static_cast<double>(masses[i]) /
                                        (unit_sphere * h * h * h));
    }
  };
  return make_column(count, streams, make);
}

}  // namespace splotchcl
