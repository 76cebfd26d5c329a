#include <cmath>

#include "splotchcl/map.h"

namespace splotchcl {

double MapAxis::edge(int i) const {
  const double part = static_cast<double>(i) / cells;
  if (i == cells) return last;
  return is_logarithmic ? first * std::pow(last / first, part) : first + part * (last - first);
}

int Map::planes() const {
  if (shape == MapShape::velocities) return velocity->channels;
  return shape == MapShape::voxels ? axes[2].cells : 1;
}

}  // namespace splotchcl
