#pragma once

#include <cstdint>

#include "device/frame/records.h"
#include "device/frame/stage_context.h"

namespace splotchcl {

// The light of one part of a sum's splats added to that of another.
class LightAdder {
 public:
  explicit LightAdder(const StageContext& context) : context_(context) {}

  SplatLight add(SplatLight to, SplatLight from) const;

 private:
  void add_planes(const Planes& to, const Planes& from, std::size_t grid) const;
  void add(const char* kernel, const shared::AddLightParameters& parameters, std::size_t planes,
           const Buffer<float>& to, const Buffer<float>& from) const;

  const StageContext& context_;
};

}  // namespace splotchcl
