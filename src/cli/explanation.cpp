#include "cli/explanation.h"

#include <fmt/format.h>

#include <iostream>
#include <sstream>

#include "common/utf8.h"
#include "estimate/frame_estimate.h"
#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/views.h"

namespace splotchcl::cli {
namespace {

std::string explain_estimate(const FramePlan& plan, const Frame& frame, const Scene& scene,
                             const DrawOptions& options, int pictures) {
  if (options.reference) return "time: no estimate for the reference renderer\n";
  try {
    const int drawings = pictures * static_cast<int>(views_of(scene, frame).size());
    return explain(estimate_frame(frame, plan, options.device, options.memory_bytes), drawings);
  } catch (const DeviceError&) {
    return "memory and time: no estimate without an OpenCL device\n";
  }
}

}  // namespace

void print_explanation(const FramePlan& plan, const Frame& frame, const Scene& scene,
                       const DrawOptions& options, int pictures) {
  std::istringstream lines(explain(plan, frame) +
                           explain_estimate(plan, frame, scene, options, pictures));
  for (std::string line; std::getline(lines, line);)
    std::cout << "# " << printable(line) << "\n";
  std::cout << "\n" << format_scene(scene);
}

}  // namespace splotchcl::cli
