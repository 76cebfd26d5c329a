#pragma once

#include <vector>

#include "certificate/certificate.h"
#include "device/frame/records.h"
#include "device/frame/stage_context.h"

namespace splotchcl {

// Collects what a frame's splats add up to, from the lists that were drawn: the stage `certify`.
// Not for extended precision, whose bound holds for any splats.
class Certifier {
 public:
  explicit Certifier(const StageContext& context);

  void collect(const TileLists& lists);
  // Of all lists so far; waits for the device. Octaves without splats are left out.
  CollectedSplats collected() const;

 private:
  void start();
  void collect_in_groups(const TileLists& lists, const shared::CertifyParameters& parameters) const;

  const StageContext& context_;
  shared::CertifyParameters parameters_{};
  compute::program program_;
  Buffer<float> cells_;
  bool has_started_ = false;
};

}  // namespace splotchcl
