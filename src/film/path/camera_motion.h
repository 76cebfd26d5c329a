#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/flight.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// The camera on an orbit or a flight, or standing still.
class CameraMotion {
 public:
  // An orbit needs a scene with a camera. Throws UsageError.
  CameraMotion(const Scene& scene, int frames);

  // "key=value" for what moves.
  std::vector<std::string> settings(int frame) const;

 private:
  std::vector<std::string> on_orbit(int frame) const;
  std::vector<std::string> on_flight(int frame) const;

  PathSettings path_;
  Camera camera_;
  int frames_;
  std::optional<Flight> flight_;
  double look_ahead_ = 0;
};

}  // namespace splotchcl
