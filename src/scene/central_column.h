#pragma once

#include <cmath>

#include "splotchcl/scene.h"

namespace splotchcl {

// w, the column of matter through a particle's centre, before intensity and colour:
// see WeightModel. `value` is the particle's mass or density, or with a constant weight a
// factor, sigma its width; lengths are the snapshot's.
inline double central_column(WeightModel model, double value, double h, double sigma) {
  constexpr double pi = 3.14159265358979323846;
  switch (model) {
    case WeightModel::mass:
      return value / (pi * sigma * sigma);
    case WeightModel::density:
      return value * sigma * std::sqrt(pi);
    case WeightModel::constant:
      return value / h;
  }
  return 0;
}

}  // namespace splotchcl
