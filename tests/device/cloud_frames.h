#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "device/scenes.h"

// Ordered frames of random clouds, drawn in parts and by several ranks.
namespace splotchcl::test {

// Two components of so many clouds each.
inline Frame many_clouds(int count) {
  CloudSetup setup;
  setup.count = count;
  setup.sigma_high = 6;
  setup.column_high = 0.1;
  DrawnComponent first = random_clouds(setup);
  first.absorption = {Absorption::Kind::gray, 0.2};
  setup.seed = 2;
  DrawnComponent second = random_clouds(setup);
  second.absorption = {Absorption::Kind::gray, 0.4};
  return frame_of(setup.width, setup.height, {first, second});
}

inline Frame with_absorption(Frame frame, Absorption absorption) {
  for (DrawnComponent& component : frame.components)
    component.absorption = absorption;
  return frame;
}

inline Frame without_absorption(Frame frame) {
  return with_absorption(std::move(frame), {Absorption::Kind::none, 0});
}

// From a place before the clouds' middle.
inline Frame looked_at_from(Frame frame, double z,
                            Projection projection = Projection::perspective) {
  Camera camera;
  camera.position = {{0, 0, z}};
  camera.look_at = {{0, 0, 60}};
  camera.sky = {{0, -1, 0}};
  camera.projection = projection;
  frame.crop = {0, 0, frame.width, frame.height};
  frame.projection = projection;
  frame.camera = make_camera_frame(camera, frame.width, frame.height);
  return frame;
}

inline Frame panorama_of_clouds(int count) {
  Frame frame = many_clouds(count);
  frame.width = 120;
  frame.height = 60;
  return looked_at_from(std::move(frame), 50, Projection::equirectangular);
}

// The camera stands in some of them. As large as given.
inline Frame within_clouds(int width, int height) {
  Frame frame = many_clouds(300);
  frame.width = width;
  frame.height = height;
  frame.through_clouds = true;
  return looked_at_from(std::move(frame), 20);
}

inline Frame within_clouds() {
  const CloudSetup setup;
  return within_clouds(setup.width, setup.height);
}

// Fields to sort by of which nearly all are the same: one in `period` differs.
inline void give_few_fields(Frame& frame, std::size_t period) {
  for (DrawnComponent& component : frame.components) {
    std::vector<float> fields(component.particles.count, 1.0f);
    for (std::size_t i = 0; i < fields.size(); i += period)
      fields[i] = static_cast<float>(i % 3);
    component.particles.sort_field = Column::owning(fields);
  }
}

// Frames that have the bits of one piece however they are divided.
struct DividedFrame {
  const char* name;
  Frame frame;
  int slabs = -1;                // below 0: as many as seem to pay
  std::uint64_t windows = 6;     // to be drawn in
  std::uint64_t least = 6;       // of these, that there are
  std::vector<int> ranks = {2};  // to be drawn by
};

inline std::vector<DividedFrame> divided_frames() {
  Frame coarse = many_clouds(1000), by_field = coarse, exact = many_clouds(300);
  coarse.tolerance = 1e-2;
  exact.tolerance = 0;
  by_field.sort.by = SortOrder::By::field;
  give_few_fields(by_field, 10);
  Frame descending = by_field, empty = many_clouds(100);
  descending.sort.descending = true;
  empty.camera.position = {{0, 0, 1e6}};
  return {{"a slab", coarse, 1, 5, 5, {2, 4}},
          {"three slabs", coarse, 3, 5, 5, {2, 4}},
          {"splats of one key", by_field, -1, 12, 6, {2, 3}},
          {"splats of one key, descending", descending, -1, 12, 6, {2, 3}},
          {"extended precision", exact},
          {"copies of a panorama", panorama_of_clouds(500)},
          {"nothing", empty, -1, 1, 0, {3}}};
}

}  // namespace splotchcl::test
