// Two small galaxies of stars fall into each other and draw themselves as they go: the
// particles never leave the memory of the simulation.
//   in_situ_cpp [FOLDER]     writes in_situ_0.png, in_situ_1.png, ...
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "splotchcl/array_snapshot.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/load.h"
#include "splotchcl/scene_file.h"

namespace {

const char* const scene_text = R"(
snapshot = "memory"
[image]
size = [480, 270]
gamma = 2
[camera]
position = [0, -7, 5]
look_at = [0, 0, 0]
sky = [0, 0, 1]
field_of_view = 50
[[component]]
types = ["stars"]
size = { fixed = 0.12 }
color = { field = "speed", min = 0.2, max = 1.6 }
palette = "temperature"
brightness = 0.5
)";

struct Stars {
  std::vector<float> position, velocity, speed;
  std::size_t count() const { return speed.size(); }
};

// A disk that turns around a heavy first particle.
void add_galaxy(Stars& stars, int count, double x, double vx, double tilt, std::mt19937& engine) {
  const auto uniform = [&engine] { return static_cast<double>(engine()) / 4294967296.0; };
  const double c = std::cos(tilt), s = std::sin(tilt);
  for (int i = 0; i < count; ++i) {
    const double radius = i == 0 ? 0 : 0.15 + 1.1 * std::sqrt(uniform());
    const double angle = 6.283185307 * uniform();
    const double speed = i == 0 ? 0 : 1 / std::sqrt(radius);
    const double px = radius * std::cos(angle), py = radius * std::sin(angle);
    const double wx = -speed * std::sin(angle), wy = speed * std::cos(angle);
    for (const double value : {x + px, c * py, s * py})
      stars.position.push_back(static_cast<float>(value));
    for (const double value : {vx + wx, c * wy, s * wy})
      stars.velocity.push_back(static_cast<float>(value));
    stars.speed.push_back(0);
  }
}

// Only the two centres have mass: leapfrog with a softened pull.
void pull(Stars& stars, std::size_t second, float time) {
  for (std::size_t i = 0; i < stars.count(); ++i) {
    for (const std::size_t center : {std::size_t{0}, second}) {
      float d[3], square = 0.02F;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        d[axis] = stars.position[3 * center + axis] - stars.position[3 * i + axis];
        square += d[axis] * d[axis];
      }
      const float strength = i == center ? 0 : time / (square * std::sqrt(square));
      for (std::size_t axis = 0; axis < 3; ++axis)
        stars.velocity[3 * i + axis] += strength * d[axis];
    }
  }
}

void step(Stars& stars, std::size_t second, float time) {
  pull(stars, second, time / 2);
  for (std::size_t i = 0; i < stars.position.size(); ++i)
    stars.position[i] += time * stars.velocity[i];
  pull(stars, second, time / 2);
  for (std::size_t i = 0; i < stars.count(); ++i) {
    stars.speed[i] =
        std::hypot(stars.velocity[3 * i], stars.velocity[3 * i + 1], stars.velocity[3 * i + 2]);
  }
}

int run(const std::filesystem::path& folder) {
  std::mt19937 engine(1);
  Stars stars;
  constexpr int half = 4000, pictures = 3, steps_per_picture = 60;
  add_galaxy(stars, half, -1.8, 0.35, 0.3, engine);
  add_galaxy(stars, half, 1.8, -0.35, 1.2, engine);

  // The snapshot borrows the arrays, once; each picture reads what is in them then.
  splotchcl::ArraySnapshot snapshot("in_situ");
  snapshot.set_field(4, "position", stars.position.data(), stars.count(), 3);
  snapshot.set_field(4, "speed", stars.speed.data(), stars.count());
  splotchcl::Scene scene = splotchcl::parse_scene(scene_text, "in_situ");
  splotchcl::FrameDrawer drawer;
  std::vector<std::string> notes;

  for (int picture = 0; picture < pictures; ++picture) {
    for (int i = 0; i < steps_per_picture; ++i)
      step(stars, half, 0.01F);
    snapshot.changed();
    // What the first picture chooses from the data, such as its exposure, holds for all.
    if (picture == 0) scene = splotchcl::fixed_scene(splotchcl::decide(scene, snapshot, notes));
    const splotchcl::DrawnFrame drawn = drawer.draw(scene, snapshot);
    const auto path = folder / ("in_situ_" + std::to_string(picture) + ".png");
    splotchcl::write_pictures(path, drawn.pictures, splotchcl::image_file_options(scene));
    std::printf("%s\n", path.c_str());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 ? argv[1] : ".");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "in_situ: %s\n", error.what());
    return 1;
  }
}
