#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

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

py::dict describe(const RenderStats& stats) {
  py::dict stages, serial;
  for (const StageTime& stage : stats.stages)
    stages[py::str(stage.stage)] = stage.seconds;
  for (const StageTime& part : stats.serial)
    serial[py::str(part.stage)] = part.seconds;
  py::dict text;
  text["device"] = stats.device;
  text["particles"] = stats.particles;
  text["bad_particles"] = stats.bad_particles;
  text["drawn_particles"] = stats.drawn_particles;
  text["tile_entries"] = stats.tile_entries;
  text["device_bytes"] = stats.device_bytes;
  text["build_seconds"] = stats.build_seconds;
  text["total_seconds"] = stats.total_seconds;
  text["stages"] = stages;
  text["serial"] = serial;
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
py::tuple draw(Drawer& drawer, const Scene& scene, const Source& source, py::object report) {
  const Progress progress(std::move(report));
  DrawnFrame drawn = drawer.draw(scene, source, progress);
  Scene shown = scene;
  if (drawn.finish) shown.finish = *drawn.finish;
  py::dict pictures;
  for (Picture& picture : drawn.pictures) {
    pictures[py::str(picture.suffix)] =
        PictureObject{std::move(picture.image), file_options(shown, drawn.stats, picture.places),
                      std::move(picture.light)};
  }
  const bool is_decided = !has_all_levels(scene.finish) && has_all_levels(shown.finish);
  return py::make_tuple(pictures, drawn.all_notes(), describe(drawn.stats),
                        is_decided ? py::cast(shown) : py::none());
}

py::dict describe(const DeviceInfo& device) {
  py::dict text;
  text["name"] = device.name;
  text["platform"] = device.platform;
  text["driver"] = device.driver;
  text["is_gpu"] = device.is_gpu;
  text["compute_units"] = device.compute_units;
  text["memory_bytes"] = device.memory_bytes;
  text["is_default"] = device.is_default;
  return text;
}

}  // namespace

void bind_drawing(py::module_& module) {
  py::class_<Drawer>(module, "Drawer")
      .def(py::init<const std::string&, bool, bool>())
      .def("draw", &draw);
  module.def("devices", [] {
    const std::vector<DeviceInfo> devices = without_python([] { return list_devices(); });
    std::vector<py::dict> texts;
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
py::tuple make(const std::filesystem::path& scene, const std::filesystem::path& output,
               const std::vector<std::string>& settings, const std::string& device,
               bool by_reference, const std::string& frames, const std::string& part,
               py::object report_to) {
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

void bind_films(py::module_& module) {
  module.def("make_film", &make);
}

}  // namespace splotchcl::python
