#pragma once

#include <cstdint>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"
#include "splotchcl/image.h"

namespace splotchcl {

// Planes of all grids to the picture: the stage `resolve`.
class Resolver {
 public:
  explicit Resolver(const StageContext& context);

  Image resolve(Planes planes) const;

 private:
  Planes collect(Planes planes) const;
  void blur(const Planes& planes, std::uint32_t source, std::uint32_t target,
            const shared::GridPart& part, double sigma2, bool add) const;
  void refine(const Planes& planes, std::uint32_t coarse, std::uint32_t fine,
              const shared::GridPart& part, bool add) const;
  Buffer<float> upload_background(std::size_t stride) const;
  void resolve_in_place(const Planes& planes, Image& image) const;
  void write_pixels(const Planes& planes, const compute::buffer& pixels) const;

  const StageContext& context_;
  shared::ResolveParameters parameters_{};
  compute::program program_, grids_program_;
};

}  // namespace splotchcl
