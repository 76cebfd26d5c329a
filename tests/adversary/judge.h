#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "adversary/trial.h"
#include "splotchcl/frame.h"
#include "splotchcl/renderer.h"

namespace splotchcl::adversary {

// What a trial's picture is off, against the reference.
struct Measurement {
  LightPlan plan = LightPlan::emission;
  double promise = 0;             // the tolerance, or what tolerance 0 promises
  double error = 0;               // the largest |frame - reference| / max(1, |reference|)
  double certified = 0;           // what the renderer says that it is at most; 0: it says nothing
  double over_certified = 0;      // the most that a pixel errs over what is certified of it
  int x = 0, y = 0, channel = 0;  // where, in what is drawn
  double drawn = 0, exact = 0;
  double ratio() const { return std::max(error / promise, over_certified); }
};

// Measures trials. Keeps its renderers, so that kernels are compiled once.
class Judge {
 public:
  Measurement measure(const Trial& trial);

 private:
  Measurement measure_map_or_refusal(const Trial& trial);
  Renderer& renderer(CompositeShape shape, bool certify);
  std::map<std::pair<CompositeShape, bool>, std::unique_ptr<Renderer>> renderers_;
};

}  // namespace splotchcl::adversary
