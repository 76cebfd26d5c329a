#pragma once

#include <vector>

#include "adversary/trial.h"
#include "splotchcl/frame.h"

namespace splotchcl::adversary {

// A place of a group, in pixels of the whole picture, and what each of its clouds is like.
struct Place {
  double x = 0, y = 0, sigma = 1, depth = 1;
  int copies = 1;
  const CloudGroup* group = nullptr;
};

int whole(double value);

// What of the whole picture is drawn.
Rectangle crop_of(const Trial& trial);

std::vector<Place> places_of(const Trial& trial);

}  // namespace splotchcl::adversary
