#pragma once

#include <optional>
#include <string>
#include <vector>

#include "splotchcl/stereo.h"
#include "splotchcl/views.h"

namespace splotchcl {

// Where one view of a scene goes: to which picture, and to which of its equal parts.
struct ViewPlace {
  std::string suffix;  // of the picture
  int column = 0, row = 0;
  std::optional<Eye> eye;
  std::optional<int> face;  // of cube_faces()
};

// In the order in which they are drawn; views of one picture follow each other.
std::vector<ViewPlace> view_places(const Scene& scene);

// So many columns and rows of a view become one of its picture.
struct Squeezing {
  int columns = 1, rows = 1;
};
Squeezing squeezing_of(const Scene& scene);

// The frame of one view.
Frame frame_of_view(const Scene& scene, const Frame& frame, const ViewPlace& place);

}  // namespace splotchcl
