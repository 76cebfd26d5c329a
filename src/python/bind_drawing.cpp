#include <mutex>

#include "python/bindings.h"
#include "python/progress.h"
#include "python/source.h"
#include "splotchcl/film.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/load.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::python {
namespace {

// A device, or the reference, and what is told while it draws.
class Drawer {
 public:
  Drawer(const std::string& device, bool by_reference, bool certify)
      : drawer_(without_python([&] {
          FrameDrawerOptions options{device, by_reference,
                                     [this](const std::string& what, double fraction) {
                                       if (progress_ != nullptr) (*progress_)(what, fraction);
                                     },
                                     certify};
          options.light = PictureLight::both;
          return FrameDrawer(options);
        })) {}

  DrawnFrame draw(const Scene& scene, const Source& source, const Progress& progress) {
    return without_python([&] {
      const std::lock_guard<Turn> mine(turn_);
      const std::lock_guard<Turn> mine_to_read(source.turn());
      source.refresh();
      progress_ = &progress;
      try {
        DrawnFrame drawn = drawer_.draw(scene, source.snapshot());
        progress_ = nullptr;
        return drawn;
      } catch (...) {
        progress_ = nullptr;
        throw;
      }
    });
  }

 private:
  Turn turn_;
  const Progress* progress_ = nullptr;  // while it draws
  FrameDrawer drawer_;
};

py::Dict describe(const RenderStats& stats) {
  py::Dict stages, serial;
  for (const StageTime& stage : stats.stages)
    stages.set(stage.stage, stage.seconds);
  for (const StageTime& part : stats.serial)
    serial.set(part.stage, part.seconds);
  py::Dict text;
  text.set("device", stats.device);
  text.set("particles", stats.particles);
  text.set("bad_particles", stats.bad_particles);
  text.set("drawn_particles", stats.drawn_particles);
  text.set("tile_entries", stats.tile_entries);
  text.set("device_bytes", stats.device_bytes);
  text.set("build_seconds", stats.build_seconds);
  text.set("total_seconds", stats.total_seconds);
  text.set("stages", stages);
  text.set("serial", serial);
  return text;
}

// As the program stores them.
ImageFileOptions file_options(const Scene& scene, const RenderStats& stats,
                              const PixelPlaces& places) {
  ImageFileOptions options = image_file_options(
      scene, {{"splotchcl:scene", format_scene(scene)}, {"splotchcl:device", stats.device}});
  options.places = places;
  return options;
}

bool has_all_levels(const FinishSettings& finish) {
  return finish.exposure && finish.white;
}

// Pictures by what tells their files apart, notes, statistics, and the scene with the exposure and
// the white that the pictures decided, or None where it left none to them.
py::Object draw(Drawer& drawer, const Scene& scene, const Source& source, py::Object report) {
  const Progress progress(std::move(report));
  DrawnFrame drawn = drawer.draw(scene, source, progress);
  Scene shown = scene;
  if (drawn.finish) shown.finish = *drawn.finish;
  py::Dict pictures;
  for (Picture& picture : drawn.pictures) {
    pictures.set(picture.suffix, PictureObject{std::move(picture.image),
                                               file_options(shown, drawn.stats, picture.places),
                                               std::move(picture.light)});
  }
  const bool is_decided = !has_all_levels(scene.finish) && has_all_levels(shown.finish);
  return py::make_tuple(pictures, drawn.all_notes(), describe(drawn.stats),
                        is_decided ? py::to(shown) : py::none());
}

py::Dict describe(const DeviceInfo& device) {
  py::Dict text;
  text.set("name", device.name);
  text.set("platform", device.platform);
  text.set("driver", device.driver);
  text.set("is_gpu", device.is_gpu);
  text.set("compute_units", device.compute_units);
  text.set("memory_bytes", device.memory_bytes);
  text.set("is_default", device.is_default);
  return text;
}

}  // namespace

void bind_drawing(py::Module& module) {
  py::Class<Drawer>(module, "splotchcl._core.Drawer")
      .init<std::string, bool, bool>()
      .def("draw", py::function<&draw>);
  module.def("devices", [] {
    const std::vector<DeviceInfo> devices = without_python([] { return list_devices(); });
    std::vector<py::Dict> texts;
    for (const DeviceInfo& device : devices)
      texts.push_back(describe(device));
    return texts;
  });
}

namespace {

const char* name_of(FilmState state) {
  switch (state) {
    case FilmState::complete:
      return "complete";
    case FilmState::complete_before:
      return "complete before";
    case FilmState::part_is_drawn:
      return "part is drawn";
    case FilmState::joined_by_another:
      break;
  }
  return "joined by another";
}

// The film's state, its number of frames, and notes.
py::Object make(const std::filesystem::path& scene, const std::filesystem::path& output,
                const std::vector<std::string>& settings, const std::string& device,
                bool by_reference, const std::string& frames, const std::string& part,
                py::Object report_to) {
  const Progress progress(std::move(report_to));
  std::vector<std::string> notes;
  FilmOptions options;
  options.scene = scene;
  options.output = output;
  options.settings = settings;
  options.device = device;
  options.by_reference = by_reference;
  options.frames = frames;
  options.part = part;
  FilmReport report;
  report.note = [&notes](const std::string& note) { notes.push_back(note); };
  report.progress = progress.function();
  report.frame = [&progress](int, std::size_t done, std::size_t total) {
    progress("drawing", static_cast<double>(done) / static_cast<double>(total));
  };
  const FilmResult result = without_python([&] { return make_film(options, report); });
  return py::make_tuple(name_of(result.state), result.frames, std::move(notes));
}

}  // namespace

void bind_films(py::Module& module) {
  module.def("make_film", py::function<&make>);
}

}  // namespace splotchcl::python
