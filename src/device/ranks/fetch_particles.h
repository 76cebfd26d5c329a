#pragma once

#include <memory>

#include "device/opencl/device_traits.h"
#include "splotchcl/communicator.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// As long as it lives, this rank has those particles of a frame that it draws, where they are
// spread over ranks; else it does nothing. A frame that is drawn again has the same share.
class FetchedParticles {
 public:
  // Collective.
  FetchedParticles(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits);
  ~FetchedParticles();
  FetchedParticles(const FetchedParticles&) = delete;
  FetchedParticles& operator=(const FetchedParticles&) = delete;

 private:
  std::shared_ptr<SpreadParticles> spread_;
};

}  // namespace splotchcl
