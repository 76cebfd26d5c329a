// What the second frame of the same data costs when the camera has moved: it reads nothing, and
// blocks of particles that lie out of view are not projected. Beside it the frame alone, and the
// first one of a process; and what a picture costs as a file.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "machine.h"
#include "measure.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "table.h"

namespace splotchcl::bench {
namespace {

// Particles of which it is known together whether they are in view.
constexpr double particles_of_block = 8192;

// In the box of 50000 kpc/h that `splotchcl generate universe` makes.
struct View {
  const char* name;
  Vec3 position, look_at;
  double degrees;
};
constexpr View views[] = {
    {"outside, all in view", {{25000, -100000, 25000}}, {{25000, 25000, 25000}}, 40},
    {"in the box, 60 degrees", {{25000, 25000, 25000}}, {{25000, 50000, 25000}}, 60},
    {"in the box, 20 degrees", {{25000, 25000, 25000}}, {{50000, 30000, 20000}}, 20},
    {"outside, 3 degrees", {{25000, -100000, 25000}}, {{25000, 25000, 25000}}, 3},
};

std::string triple(const Vec3& v) {
  return "[" + fixed(v.a[0], 1) + ", " + fixed(v.a[1], 1) + ", " + fixed(v.a[2], 1) + "]";
}

// So far to the right in each frame, of the box's 50000.
Scene scene_of(const View& view, int frame, const Arguments& arguments) {
  Vec3 position = view.position;
  position.a[0] += 10.0 * frame;
  const std::vector<std::string> settings = {
      "snapshot=\"" + arguments.text("snapshot", "") + '"', "camera.position=" + triple(position),
      "camera.look_at=" + triple(view.look_at), "camera.field_of_view=" + fixed(view.degrees, 1)};
  return read_scene_file(arguments.text("scene", SPLOTCHCL_BENCH_FILMS "/universe.toml"), settings);
}

Frame load(const Scene& scene, const Snapshot& snapshot) {
  std::vector<std::string> notes;
  return load_frame(scene, snapshot, notes);
}

double blocks_of(const Frame& frame) {
  double blocks = 0;
  for (const DrawnComponent& component : frame.components)
    blocks += std::ceil(static_cast<double>(component.particles.count) / particles_of_block);
  return blocks;
}

struct Measured {
  Cost first;          // opened, loaded, drawn by a new renderer
  Runs second, alone;  // loaded from memory and drawn with boxes; drawn without
  double blocks = 0;
  RenderStats stats;  // of a second frame
  Image image;
};

RendererOptions options_for(const Arguments& arguments, bool columns_stay) {
  RendererOptions options;
  options.device = arguments.text("device", "");
  options.columns_stay = columns_stay;
  return options;
}

Measured measure_view(const View& view, const Arguments& arguments, int runs) {
  Measured measured;
  const Stopwatch first;
  const Scene scene = scene_of(view, 0, arguments);
  const std::unique_ptr<Snapshot> snapshot = open_snapshot(scene.snapshot);
  Renderer film(options_for(arguments, true));
  film.render(load(scene, *snapshot));
  measured.first = first.elapsed();

  Renderer alone(options_for(arguments, false));
  alone.render(load(scene, *snapshot));
  film.render(load(scene_of(view, 1, arguments), *snapshot));
  // By turns.
  for (int run = 0; run < runs; ++run) {
    const Scene moved = scene_of(view, 2 + run, arguments);
    const Stopwatch second;
    const Frame frame = load(moved, *snapshot);
    measured.image = film.render(frame);
    measured.second.add(second.elapsed());
    const Stopwatch of_frame;
    alone.render(frame);
    measured.alone.add(of_frame.elapsed());
  }
  measured.stats = film.stats();
  measured.blocks = blocks_of(load(scene, *snapshot));
  return measured;
}

// Written as a film's frames are, and read again as they are joined.
void print_cost_of_files(const Image& image, int runs) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("bench_films_" + std::to_string(::getpid()) + ".png");
  ImageFileOptions options;
  options.dithers = true;
  Runs writing, reading;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch of_writing;
    write_image(file, image, options);
    writing.add(of_writing.elapsed());
    const Stopwatch of_reading;
    read_image(file);
    reading.add(of_reading.elapsed());
  }
  std::filesystem::remove(file);
  std::printf("PNG of %dx%d: written in %s CPU s (%s s), read in %s CPU s\n", image.width,
              image.height, fixed(writing.median().cpu_seconds, 3).c_str(),
              fixed(writing.median().wall_seconds, 3).c_str(),
              fixed(reading.median().cpu_seconds, 3).c_str());
}

void run(const Arguments& arguments) {
  if (!arguments.has("snapshot")) {
    throw UsageError("found no snapshot, expected --snapshot FILE:\n" + arguments.help());
  }
  const int runs = arguments.number("runs", 5);
  std::printf("%s\n\n", describe(describe_machine(arguments.text("device", ""))).c_str());
  Table table({"camera", "particles drawn", "blocks left out", "blocks", "first frame, CPU s",
               "second, CPU s", "alone, CPU s", "second over alone", "second, s", "alone, s"});
  Image image;
  for (const View& view : views) {
    Measured measured = measure_view(view, arguments, runs);
    const Cost second = measured.second.median(), alone = measured.alone.median();
    const RenderStats& stats = measured.stats;
    table.add({view.name, std::to_string(stats.drawn_particles),
               std::to_string(stats.blocks_left_out), fixed(measured.blocks, 0),
               fixed(measured.first.cpu_seconds, 3), fixed(second.cpu_seconds, 3),
               fixed(alone.cpu_seconds, 3), fixed(second.cpu_seconds / alone.cpu_seconds, 2),
               fixed(second.wall_seconds, 3), fixed(alone.wall_seconds, 3)});
    if (image.pixels.empty()) image = std::move(measured.image);
  }
  std::printf("%s\nmedians of %d runs\n", table.text().c_str(), runs);
  print_cost_of_files(image, runs);
  if (arguments.has("csv")) table.write_csv(arguments.text("csv", ""));
}

}  // namespace
}  // namespace splotchcl::bench

int main(int count, char** words) {
  return splotchcl::bench::run_main(
      count, words,
      {"snapshot=FILE: absolute path of a universe that splotchcl generate made",
       "scene=FILE: what is drawn (bench/films/universe.toml)",
       "runs=COUNT: how often each frame is timed (5)", "device=NAME: part of a device's name",
       "csv=FILE: where the table goes"},
      splotchcl::bench::run);
}
