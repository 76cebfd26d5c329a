#pragma once

#include "device/frame/records.h"
#include "device/frame/stage_context.h"

namespace splotchcl {

// Lists to light: adds the splats of lists to the planes, or lays them behind what is
// already there: the stage `composite`.
class Compositor {
 public:
  explicit Compositor(const StageContext& context);

  // No light at all, on the picture's own grid.
  Planes start() const;
  // `splats` are those that the lists were made of.
  Planes composite(const TileLists& lists, const SplatMemory& splats, Planes planes) const;

 private:
  void clear_grid(std::size_t grid, Planes& planes) const;
  void join(const TileLists& lists, const shared::CompositeParameters& parameters,
            const Buffer<float>& partials, const Planes& planes) const;

  const StageContext& context_;
  shared::CompositeParameters parameters_{};
  compute::program program_;
};

}  // namespace splotchcl
