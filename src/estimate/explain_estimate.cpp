#include <fmt/format.h>

#include "estimate/frame_estimate.h"

namespace splotchcl {
namespace {

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.3g} MB", static_cast<double>(bytes) / 1e6);
}

std::string count(double number) {
  return number < 1e5 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g} million", number / 1e6);
}

// Two digits, or all before the point.
std::string rounded(double number) {
  return number < 10 ? fmt::format("{:.2g}", number) : fmt::format("{:.0f}", number);
}

}  // namespace

std::string rounded_duration(double seconds) {
  if (seconds < 100) return rounded(seconds) + " s";
  if (seconds < 6000) return rounded(seconds / 60) + " min";
  return rounded(seconds / 3600) + " h";
}

std::string explain(const FrameEstimate& estimate, int drawings) {
  std::string text = fmt::format(
      "memory: {} of buffers on the device, for the plan's chunks, lists and grids; {} of "
      "particles\n",
      megabytes(estimate.device_bytes), megabytes(estimate.particle_bytes));
  if (estimate.windows > 0) {
    text +=
        fmt::format("  drawn in about {} windows of depth, since there is room for {} (--memory)\n",
                    estimate.windows, megabytes(estimate.memory_limit));
  }
  if (!estimate.seconds) {
    return text + "time: no estimate, since no rates were measured on a GPU\n";
  }
  const std::string each = drawings > 1 ? fmt::format(" ({} drawings, {} each)", drawings,
                                                      rounded_duration(*estimate.seconds))
                                        : std::string();
  text += fmt::format("time: about {} to draw{}, an estimate\n",
                      rounded_duration(drawings * *estimate.seconds), each);
  text += fmt::format(
      "  {} splats in {} entries of tiles, at rates that were measured on two cores of an\n"
      "  AMD EPYC through PoCL 3.1, for the {} compute units of {};\n"
      "  without reading, compiling kernels and writing\n",
      count(estimate.splats), count(estimate.tile_entries), estimate.compute_units,
      estimate.device);
  return text;
}

}  // namespace splotchcl
