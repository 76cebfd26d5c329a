#pragma once

#include "device/frame/records.h"
#include "device/frame/stage_context.h"

namespace splotchcl {

// Lists to light: adds the splats of lists to the planes, or lays them behind what is
// already there: the stage `composite`.
class Compositor {
 public:
  explicit Compositor(const StageContext& context);

  // Lists have clouds around the camera from now on. The tables outlive it.
  void take_clouds(const CloudTables& clouds);

  // Planes of which nothing has been written to.
  Planes room() const;
  // No light at all, on the picture's own grid.
  Planes start() const;
  // `splats` are those that the lists were made of.
  Planes composite(const TileLists& lists, const Buffer<std::byte>& splats, Planes planes) const;

 private:
  // The kernels for some of the segments: of an ordered plan's coarse grids they add up.
  struct Kernels {
    Program composite;
    const CloudTables* clouds;
  };
  // The segments from `first` on.
  struct Part {
    std::uint32_t first = 0, end = 0;
  };
  void clear_grid(std::size_t grid, Planes& planes) const;
  void draw(const Part& part, const Kernels& kernels, const TileLists& lists,
            const Buffer<std::byte>& splats, const Buffer<float>& partials,
            const Planes& planes) const;
  void join(const Part& part, const Kernels& kernels, const TileLists& lists,
            const Buffer<float>& partials, const Planes& planes) const;
  shared::CompositeParameters parameters_of(const Part& part) const;

  const StageContext& context_;
  shared::CompositeParameters parameters_{};
  const CloudTables no_clouds_;
  Kernels layers_, slabs_;
};

}  // namespace splotchcl
