#pragma once

#include <string>
#include <vector>

#include "finish/finish_picture.h"
#include "reference/frames.h"
#include "splotchcl/image.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

// A scene with its frame and snapshot, none of which need particles to be finished.
namespace splotchcl::test {

inline Image plain_image(int width, int height, const std::array<float, 3>& light = {0, 0, 0}) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 3; ++c)
        image.at(x, y)[c] = light[c];
    }
  }
  return image;
}

// Half a length unit per pixel at the look-at point.
struct FinishScene {
  Scene scene;
  Frame frame;
  SnapshotInfo snapshot;

  explicit FinishScene(int width = 400, int height = 300) {
    scene.image.width = width;
    scene.image.height = height;
    frame = empty_frame(width, height);
    frame.camera.pixels_per_length = 2;
    frame.camera.focal_pixels = 2;
    snapshot.files = {"folder/snapshot_006"};
    snapshot.time = 0.25;
    snapshot.redshift = 3;
    ParticleTypeInfo gas;
    gas.type = 0;
    gas.count = 1;
    gas.fields = {{"position", "POS", 3, "kpc"}, {"internal_energy", "U", 1, "km^2/s^2"}};
    snapshot.types = {gas};
  }

  void add_component(const std::string& name, const Palette& palette, const ScalarMap& map) {
    Component component;
    component.name = name;
    component.color.field = "internal_energy";
    scene.components.push_back(component);
    DrawnComponent drawn;
    drawn.name = name;
    drawn.palette = palette;
    drawn.color = map;
    frame.components.push_back(drawn);
  }

  // The picture that is made of an even one.
  Image finish(const std::array<float, 3>& light = {0, 0, 0},
               const DrawFrame& draw = DrawFrame()) const {
    Image image = plain_image(frame.crop.width, frame.crop.height, light);
    PictureFinish(scene, frame, snapshot).apply(image, scene.finish, draw);
    return image;
  }
};

}  // namespace splotchcl::test
