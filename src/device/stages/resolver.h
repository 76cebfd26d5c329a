#pragma once

#include <cstdint>
#include <vector>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "splotchcl/image.h"

namespace splotchcl {

// Planes of all grids to the picture: the stage `resolve`.
class Resolver {
 public:
  explicit Resolver(const StageContext& context);

  Image resolve(Planes planes) const;

  // An ordered plan's planes before its first slab.
  SlabLight start_slabs() const;
  // What coarse grids hold of a slab's wide splats, laid among the narrow ones; they are empty
  // then.
  Planes lay_slab(Planes planes, SlabLight& slab) const;
  // The next slab's splats lie behind all that the planes hold, that of other sources, too.
  void begin_slab(const Planes& planes, const SlabLight& slab) const;
  // The largest of all slabs together in each of the picture's blocks (BlockErrors).
  std::vector<float> errors_of_slabs(const SlabLight& slab) const;

 private:
  // For what each step of collect() and lay_slab() makes along one axis of a grid.
  Buffer<float> room_for_columns() const;
  // Down to grids of this level.
  Planes collect(Planes planes, std::size_t finest, const Buffer<float>& columns) const;
  void refine_columns(const Planes& planes, const shared::RefineParameters& parameters,
                      const Buffer<float>& columns) const;
  shared::RefineParameters refine_parameters(std::uint32_t coarse, std::uint32_t fine,
                                             const shared::GridPart& part) const;
  void blur(const Planes& planes, std::uint32_t source, std::uint32_t target,
            const shared::GridPart& part, double sigma2, bool add,
            const Buffer<float>& columns) const;
  void refine(const Planes& planes, std::uint32_t coarse, std::uint32_t fine,
              const shared::GridPart& part, bool add, const Buffer<float>& columns) const;
  Buffer<float> upload_background(std::size_t stride) const;
  void resolve_in_place(const Planes& planes, Image& image) const;
  void write_pixels(const Planes& planes, const compute::buffer& pixels) const;

  const StageContext& context_;
  shared::ResolveParameters parameters_{};
  Program program_, grids_program_, slab_program_;
};

}  // namespace splotchcl
