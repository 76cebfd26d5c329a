#pragma once

#include <optional>
#include <string>
#include <vector>

#include "splotchcl/camera.h"
#include "splotchcl/image.h"
#include "splotchcl/periodic.h"

namespace splotchcl {

// The second eye of a pair, with the directions of the left and right edge of what it sees.
struct SecondEye {
  Vec3 position, left, right;
};

// What the plot of a film's set-up shows.
struct PathPlot {
  std::vector<CameraFrame> cameras;    // of each frame
  std::vector<Vec3> look_at;           // of each frame
  std::vector<Vec3> sky;               // of each frame
  std::vector<SecondEye> second_eyes;  // of each frame, or none
  std::vector<double> half_angles;     // of view, horizontal, in radians, of each frame
  std::vector<Vec3> particles;         // or a sample of them
  std::optional<BoxSides> box_size;    // of a periodic box that begins at 0
};

// The places where particles crowd most: cells of a grid over the bulk of them that hold more
// than all their neighbours and a hundredth of what the fullest holds, the fullest first.
struct DenseCell {
  Vec3 center;      // the mean place of the particles in the cell and its neighbours
  double size = 0;  // a side of the cell
};
std::vector<DenseCell> densest_cells(const std::vector<Vec3>& particles, std::size_t limit);

// Two projections side by side, x-y and x-z, at one scale: the particles and their outline,
// the densest cells by rank, the camera's way from blue to red with its look-at points, and at
// some frames its sky and right vectors, its view, and the second eye with its own. Throws
// UsageError where no font is found.
Image draw_path_plot(const PathPlot& plot);

}  // namespace splotchcl
