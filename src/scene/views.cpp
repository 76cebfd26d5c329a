#include "scene/views.h"

#include <algorithm>

#include "splotchcl/cube.h"
#include "splotchcl/scene.h"

namespace splotchcl {
namespace {

constexpr int sheet_columns = 3, sheet_rows = 2;

bool is_cube(const Scene& scene) {
  return scene.camera && scene.camera->projection == Projection::cube;
}

bool is_sheet(const Scene& scene) {
  return is_cube(scene) && scene.camera->cube_layout == CubeLayout::sheet;
}

std::vector<ViewPlace> face_places(const Scene& scene) {
  if (!is_cube(scene)) return {ViewPlace()};
  std::vector<ViewPlace> places;
  // Names and places do not depend on the camera.
  const std::array<CubeFace, 6> faces = cube_faces({});
  for (int i = 0; i < 6; ++i) {
    const CubeFace& face = faces[static_cast<std::size_t>(i)];
    ViewPlace place;
    place.face = i;
    if (is_sheet(scene)) {
      place.column = face.column;
      place.row = face.row;
    } else {
      place.suffix = std::string("_") + face.name;
    }
    places.push_back(place);
  }
  return places;
}

ViewPlace seen_by(Eye eye, ViewPlace place, const Scene& scene) {
  place.eye = eye;
  const bool second = eye == Eye::right;
  switch (scene.stereo->layout) {
    case StereoLayout::files:
      place.suffix = (second ? "_right" : "_left") + place.suffix;
      break;
    case StereoLayout::side_by_side:
    case StereoLayout::side_by_side_half:
      if (second) place.column += is_sheet(scene) ? sheet_columns : 1;
      break;
    case StereoLayout::top_bottom:
    case StereoLayout::top_bottom_half:
      if (second) place.row += is_sheet(scene) ? sheet_rows : 1;
      break;
    case StereoLayout::anaglyph:
    case StereoLayout::anaglyph_half_color:
    case StereoLayout::anaglyph_gray:
      break;  // both at the same place
  }
  return place;
}

}  // namespace

std::vector<ViewPlace> view_places(const Scene& scene) {
  const std::vector<ViewPlace> faces = face_places(scene);
  if (!scene.stereo) return faces;
  std::vector<ViewPlace> places;
  for (const Eye eye : {Eye::left, Eye::right}) {
    for (const ViewPlace& face : faces)
      places.push_back(seen_by(eye, face, scene));
  }
  return places;
}

std::vector<PictureSize> picture_sizes(const Scene& scene, int view_width, int view_height) {
  std::vector<PictureSize> sizes;
  const Squeezing squeezing = squeezing_of(scene);
  for (const ViewPlace& place : view_places(scene)) {
    auto size = std::find_if(sizes.begin(), sizes.end(),
                             [&](const PictureSize& s) { return s.suffix == place.suffix; });
    if (size == sizes.end()) size = sizes.insert(sizes.end(), {place.suffix, 0, 0});
    size->width = std::max(size->width, (place.column + 1) * view_width / squeezing.columns);
    size->height = std::max(size->height, (place.row + 1) * view_height / squeezing.rows);
  }
  return sizes;
}

Squeezing squeezing_of(const Scene& scene) {
  if (!scene.stereo) return {1, 1};
  switch (scene.stereo->layout) {
    case StereoLayout::side_by_side_half:
      return {2, 1};
    case StereoLayout::top_bottom_half:
      return {1, 2};
    default:
      return {1, 1};
  }
}

std::vector<FrameView> views_of(const Scene& scene, const Frame& frame) {
  std::vector<FrameView> views;
  for (const ViewPlace& place : view_places(scene))
    views.push_back({place.suffix, frame_of_view(scene, frame, place)});
  return views;
}

Frame frame_of_view(const Scene& scene, const Frame& frame, const ViewPlace& place) {
  Frame view = frame;
  if (place.eye) view.camera = eye_camera(view.camera, view.projection, *scene.stereo, *place.eye);
  if (place.face)
    view.camera = cube_faces(view.camera)[static_cast<std::size_t>(*place.face)].camera;
  return view;
}

}  // namespace splotchcl
