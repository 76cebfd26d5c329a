#pragma once

#include <functional>

#include "adversary/judge.h"
#include "adversary/trial.h"
#include "device/scenes.h"

namespace splotchcl::adversary {

// A trial and what it was measured to be.
struct Finding {
  Trial trial;
  Measurement measurement;
};

// Changes some of the numbers of a trial, and now and then its groups. `step` is of the ranges
// that the numbers have.
Trial changed(const Trial& trial, double step, test::Random& random);

// Looks for the largest error over promise by hill climbing from several starts of `start`: an
// evolution strategy of one parent and one child, with steps that grow with success and shrink
// without. `goes_on` is asked before each picture.
Finding search(const std::function<Trial(test::Random&)>& start, Judge& judge, test::Random& random,
               const std::function<bool()>& goes_on);

}  // namespace splotchcl::adversary
