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

  // All that coarse grids hold on the picture's own.
  Planes to_picture(Planes planes) const;
  Image resolve(Planes planes) const;
  // Of the picture's planes that hold depths or opacities: how deep they are at most,
  // in numbers of the kernel's own.
  Buffer<float> find_deepest(const Planes& planes) const;
  // The depth of the deepest channel of each of the picture's blocks (BlockErrors).
  std::vector<float> depths_of_blocks(const Buffer<float>& deepest) const;

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
  // Where a level's light is; null where it has none.
  struct LevelLight {
    const Buffer<float>* memory = nullptr;
    std::uint32_t grid = 0;  // as kernels number it (all_grids)
  };
  CollectingRoom room_for_collecting() const;
  // Down to grids of this level.
  LevelLight collect(const Planes& planes, int finest, const CollectingRoom& room) const;
  // What the level's own grids hold.
  LevelLight light_of_level(const Planes& planes, int level, const CollectingRoom& room) const;
  std::vector<std::size_t> blurs_with_light(const Planes& planes, int level) const;
  void blur(const Planes& planes, const std::vector<std::size_t>& blurs, int level,
            const LevelLight& target, bool add, const CollectingRoom& room) const;
  void blur_in_strips(const Planes& planes, const std::vector<std::size_t>& blurs, int level,
                      const LevelLight& target, bool add) const;
  void blur_by_axes(const Planes& planes, std::size_t blur, int level, const LevelLight& target,
                    bool add, const Buffer<float>& columns) const;
  std::size_t items_of(std::size_t eights) const;
  void refine_columns(const LevelLight& coarse, const shared::RefineParameters& parameters,
                      const Buffer<float>& columns) const;
  shared::RefineParameters refine_parameters(std::uint32_t coarse, std::uint32_t fine,
                                             const shared::GridPart& part) const;
  void refine(const LevelLight& coarse, const LevelLight& fine, const shared::GridPart& part,
              bool add, const Buffer<float>& columns) const;
  Buffer<float> upload_background(std::size_t stride) const;
  void resolve_in_place(const Planes& planes, Image& image) const;
  void write_pixels(const Planes& planes, const compute::buffer& pixels) const;

  const StageContext& context_;
  shared::ResolveParameters parameters_{};
  Program program_, grids_program_, blur_program_, slab_program_, deepest_program_;
};

}  // namespace splotchcl
