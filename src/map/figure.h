#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "map/map_colors.h"
#include "splotchcl/image.h"
#include "splotchcl/map.h"

namespace splotchcl {

// A piece of a contour: two places in pixels from the top left corner of the map.
using ContourPiece = std::array<std::array<double, 2>, 2>;

// Where the map, linear along the lines between centers of neighboring pixels, has the value: by
// marching squares (Lorensen & Cline 1987 in two dimensions). A saddle is cut by the mean of its
// corners. Squares with a corner that is not a number have none.
std::vector<ContourPiece> contour_pieces(const Map& map, double level);

// What figures of a map have in common.
struct Figure {
  const Map& map;
  MapColors colors;
  Palette palette;
  std::string label;           // of the color bar, with raised digits
  std::vector<double> levels;  // of contours

  // The palette's color of each pixel, as displayed; gray where there is no value.
  Image picture() const;
  // On pixels that the colors do not show, a line each.
  std::vector<std::string> notes() const;
};

// A sphere as a picture of the whole sky, so many pixels wide, by Mollweide's projection: longitude
// 0 in the middle, growing to the left; not a number around it.
Map picture_of_sphere(const Map& map, int width);

// Throws UsageError for a palette that there is none of, or limits that cannot be.
Figure plan_figure(const Map& map, const MapSettings& settings);

// Refuses before anything is drawn what would be refused afterwards: limits of colors, a palette, a
// font, placeholders that there are none of. Throws UsageError.
void check_figure(const Scene& scene, const SnapshotInfo& snapshot);

// The picture with contours, color bar, scale bar and texts upon it.
Image draw_figure(const Figure& figure, const Scene& scene, const SnapshotInfo& snapshot);

// A page with axes around the picture; lines and texts are lines and texts. `path` is for messages.
std::vector<unsigned char> encode_pdf(const std::filesystem::path& path, const Figure& figure,
                                      const Scene& scene, const SnapshotInfo& snapshot);

// The page as a picture, as wide as the scene's.
Image draw_figure_with_axes(const Figure& figure, const Scene& scene, const SnapshotInfo& snapshot);

// Lines of this width in pixels upon the picture, of this light.
void draw_lines(const std::vector<ContourPiece>& pieces, double width, float light, Image& image);
// The same in white with dark edges.
void draw_contours(const std::vector<ContourPiece>& pieces, double width, Image& image);

}  // namespace splotchcl
