// Pictures of a few particles of any values, drawn on a device: every pixel is a number.
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "fuzz/fuzz.h"
#include "splotchcl/array_snapshot.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/scene_file.h"

namespace {

constexpr std::array<const char*, 8> scenes = {
    "tolerance = 0.001\n[[component]]\nabsorption = 'none'\n",
    "tolerance = 0.001\n[[component]]\n",
    "tolerance = 0.001\n[[component]]\nabsorption = 0.5\ncolor = { field = 'mass' }\n",
    "tolerance = 1e-5\n[[component]]\nabsorption = 'none'\n",
    "tolerance = 1e-5\n[[component]]\nabsorption = 0.5\ncolor = { field = 'mass' }\n",
    "tolerance = 0\n[[component]]\n",
    "tolerance = 0.01\n[camera]\nprojection = 'fisheye'\nposition = [0, 0, 5]\nlook_at = "
    "[0, 0, 0]\n"
    "[[component]]\n",
    "tolerance = 0.001\n[camera]\nprojection = 'orthographic'\nposition = [0, 0, 5]\n"
    "look_at = [0, 0, 0]\n[[component]]\nabsorption = 'none'\n"};

splotchcl::FrameDrawer& drawer() {
  static splotchcl::FrameDrawer drawer;
  return drawer;
}

}  // namespace

// The first byte chooses the scene, what follows is floats: five for each particle.
void splotchcl::fuzz::fuzz_device(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  constexpr std::size_t floats_per_particle = 5, most_particles = 64;
  if (size < 1 + floats_per_particle * sizeof(float)) return;
  const std::size_t count =
      std::min(most_particles, (size - 1) / (floats_per_particle * sizeof(float)));
  std::vector<float> values(floats_per_particle * count);
  std::memcpy(values.data(), data + 1, values.size() * sizeof(float));
  const float* const position = values.data();
  const float* const mass = position + 3 * count;
  try {
    ArraySnapshot arrays;
    arrays.set_field(0, "position", position, count, 3);
    arrays.set_field(0, "mass", mass, count);
    arrays.set_field(0, "smoothing_length", mass + count, count);
    const Scene scene = parse_scene(scenes[data[0] % scenes.size()], "scene",
                                    {"snapshot=\"arrays\"", "image.size=[24,16]"});
    for (const Picture& picture : drawer().draw(scene, arrays).pictures) {
      for (const float value : picture.image.pixels) {
        if (std::isnan(value)) std::abort();
      }
    }
  } catch (const Error&) {
    // refused
  }
}
