#include <fmt/format.h>

#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>

#include "cli/commands.h"
#include "common/output_files.h"
#include "film/frames/film_scene.h"
#include "film/path_plot/path_plot.h"
#include "scene/constants.h"
#include "scene/statistics.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/picture.h"

namespace splotchcl::cli {
namespace {

constexpr std::size_t particle_limit = 1000000;  // plotted, of all components together

std::vector<Vec3> sample_particles(const Frame& frame) {
  const auto total = static_cast<std::size_t>(particle_count(frame));
  const std::size_t stride = sample_stride(total, particle_limit);
  std::vector<Vec3> sample;
  for (const DrawnComponent& component : frame.components) {
    const Particles& particles = component.particles;
    for (std::size_t i = 0; i < particles.count; i += stride) {
      Vec3 at = particles.origin;
      for (std::size_t axis = 0; axis < 3; ++axis)
        at.a[axis] += static_cast<double>(particles.position[3 * i + axis]);
      if (std::isfinite(boost::qvm::mag(at))) sample.push_back(at);
    }
  }
  return sample;
}

// Where an eye's picture ends to the left and right: as its frustum says, which need not be even,
// or in wide angles as far as they are drawn.
SecondEye second_eye(const CameraFrame& camera, const Vec3& position, int width,
                     double half_angle) {
  constexpr double widest = 1.3;  // radians
  const auto edge = [&](double tangent) {
    return boost::qvm::normalized(camera.forward + tangent * camera.right);
  };
  if (half_angle > widest) return {position, edge(-std::tan(widest)), edge(std::tan(widest))};
  return {position, edge(-camera.center_x / camera.focal_pixels),
          edge((width - camera.center_x) / camera.focal_pixels)};
}

// The eyes of a frame: one, or two where the scene has a pair.
void add_cameras(const Scene& scene, const Frame& frame, PathPlot& plot) {
  const std::vector<FrameView> views = views_of(scene, frame);
  const CameraFrame& first = views.front().frame.camera;
  plot.cameras.push_back(first);
  plot.look_at.push_back(scene.camera->look_at);
  plot.sky.push_back(scene.camera->sky);
  plot.half_angles.push_back(0.5 * field_of_view_degrees(*scene.camera) * pi / 180);
  for (const FrameView& view : views) {
    const CameraFrame& camera = view.frame.camera;
    // In wide angles an eye is beside the camera for whatever direction is looked at.
    const Vec3 eye = camera.position + camera.eye_offset * frame.camera.right;
    if (boost::qvm::mag(eye - first.position) > 0) {
      plot.second_eyes.push_back(
          second_eye(camera, eye, view.frame.width, plot.half_angles.back()));
      return;
    }
  }
}

}  // namespace

int run_path(const PathOptions& options, Console& console) {
  check_image_path(options.output);
  FilmScene film(options.scene, options.settings);
  check_outputs({{options.output, "--output"}},
                [&] { return film_files_read(options.scene, film.scene(), film.path()); });
  console.status("reading");
  film.decide();
  const Scene start = film.scene_at(0);
  const std::shared_ptr<const Snapshot> snapshot = film.snapshot_at(start);
  std::vector<std::string> notes = film.notes();
  Frame frame = load_frame(start, *snapshot, notes);
  console.note_each_once(notes);
  PathPlot plot;
  plot.particles = sample_particles(frame);
  plot.box_size = snapshot->info().box_size;
  frame.components.clear();
  for (int i = 0; i < film.path().frame_count(); ++i) {
    const Scene scene = film.scene_at(i);
    frame.camera = make_camera_frame(*scene.camera, frame.width, frame.height);
    add_cameras(scene, frame, plot);
  }
  // A pair of eyes in some frames only cannot be told apart by their number.
  if (plot.second_eyes.size() != plot.cameras.size()) plot.second_eyes.clear();
  console.status("drawing");
  write_image(options.output, draw_path_plot(plot));
  console.done(
      fmt::format("{}: the path of {} frames", options.output.string(), film.path().frame_count()));
  return 0;
}

}  // namespace splotchcl::cli
