#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "splotchcl/frame.h"

namespace splotchcl::view {

// A part of a frame's particles that has the light of all: each stands for as many as were left
// out. Which these are depends on their number alone, so that a picture that is turned does not
// flicker.
class FrameSampler {
 public:
  // At most about `particles` of all components together; 0: all. What was gathered for one of the
  // last frames is used again where the frame has the same columns.
  Frame sample(const Frame& frame, std::uint64_t particles);

 private:
  struct Kept {
    Particles source, sample;
    std::uint64_t last_frame = 0;  // that used it
  };
  const Particles& sample_component(std::size_t component, const Particles& all, std::size_t count);
  void forget_unused();

  std::uint64_t frame_ = 0;
  std::map<std::pair<std::size_t, std::size_t>, Kept> kept_;  // by component and count
};

}  // namespace splotchcl::view
