#include "film/movie/film_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "common/words.h"
#include "film/movie/boxes.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Boxes do not tell squeezed pictures from others: players know them by their shape.
FilmLayout::Eyes eyes_of(StereoLayout layout) {
  switch (layout) {
    case StereoLayout::side_by_side:
    case StereoLayout::side_by_side_half:
      return FilmLayout::Eyes::side_by_side;
    case StereoLayout::top_bottom:
    case StereoLayout::top_bottom_half:
      return FilmLayout::Eyes::top_bottom;
    default:
      return FilmLayout::Eyes::one;
  }
}

}  // namespace

FilmLayout layout_of(const Scene& scene) {
  FilmLayout layout;
  if (scene.stereo) layout.eyes = eyes_of(scene.stereo->layout);
  if (!scene.camera || scene.camera->projection != Projection::equirectangular) return layout;
  const double width = field_of_view_degrees(*scene.camera);
  layout.panorama = {width, width * scene.image.height / scene.image.width};
  return layout;
}

bool can_tell(const std::filesystem::path& path, const FilmLayout& layout) {
  const std::string ending = lower_ending(path);
  return ending == ".mp4" || ending == ".mov" || !layout.panorama;
}

namespace {

// The part of a whole that is left out on each of two sides, as a fraction of 2^32.
std::uint32_t left_out(double shown, double whole) {
  constexpr double scale = 4294967296.0;
  const double part = std::clamp(0.5 * (1 - shown / whole), 0.0, 0.5);
  return static_cast<std::uint32_t>(std::lround(std::min(part * scale, scale - 1)));
}

Bytes stereo_box(FilmLayout::Eyes eyes) {
  Bytes mode = {0};
  if (eyes == FilmLayout::Eyes::top_bottom) mode = {1};
  if (eyes == FilmLayout::Eyes::side_by_side) mode = {2};
  return full_box("st3d", mode);
}

Bytes panorama_box(const FilmLayout::Panorama& panorama) {
  constexpr double around = 360, from_pole_to_pole = 180;
  const std::uint32_t beside = left_out(panorama.width, around);
  const std::uint32_t above = left_out(panorama.height, from_pole_to_pole);
  const std::string source = "splotchcl";
  Bytes name(source.begin(), source.end());
  name.push_back(0);
  const Bytes straight_ahead = joined({big_endian(0), big_endian(0), big_endian(0)});
  const Bytes bounds =
      joined({big_endian(above), big_endian(above), big_endian(beside), big_endian(beside)});
  const Bytes projection = joined({full_box("prhd", straight_ahead), full_box("equi", bounds)});
  return box("sv3d", joined({full_box("svhd", name), box("proj", projection)}));
}

}  // namespace

void write_layout(const std::filesystem::path& film, const FilmLayout& layout) {
  Bytes boxes = stereo_box(layout.eyes);
  if (layout.panorama) boxes = joined({boxes, panorama_box(*layout.panorama)});
  add_to_video(film, boxes);
}

}  // namespace splotchcl
