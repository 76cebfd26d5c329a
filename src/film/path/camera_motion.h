#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/curves.h"
#include "splotchcl/camera.h"
#include "splotchcl/path.h"
#include "splotchcl/scene.h"

namespace splotchcl {

// How far a film is, 0 at its first and 1 at its last frame.
double part_of_film(double frame, int frames);

// From 0 to 1 as the argument goes, slowly at both ends.
double eased(double part);

// The camera on an orbit or a flight, or standing still.
class CameraMotion {
 public:
  // An orbit needs a scene with a camera. Throws UsageError.
  CameraMotion(const Scene& scene, int frames);

  // "key=value" for what moves.
  std::vector<std::string> settings(double frame) const;

 private:
  std::vector<std::string> on_orbit(double frame) const;
  std::vector<std::string> on_flight(double frame) const;
  double part_of_turn(double frame) const;

  PathSettings path_;
  Camera camera_;
  int frames_;
  std::optional<Flight> flight_;
  double look_ahead_ = 0;
};

}  // namespace splotchcl
