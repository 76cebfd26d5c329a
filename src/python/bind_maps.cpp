#include <mutex>

#include "map/shape.h"
#include "python/bindings.h"
#include "python/interface/casts.h"
#include "python/progress.h"
#include "python/source.h"
#include "splotchcl/map.h"
#include "splotchcl/reference.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::python {
namespace {

// Lowest row first, as files of maps have it: the view turns rows around and copies nothing.
py::ArrayLayout layout_of(const Map& map, const std::vector<float>& values) {
  constexpr std::int64_t size = sizeof(float);
  const std::int64_t width = map.width, height = map.height;
  const float* const last_row = values.data() + (height - 1) * width;
  if (map.shape == MapShape::healpix || map.shape == MapShape::profile) {
    return {last_row, "f4", {width}};
  }
  if ((map.velocity || map.shape == MapShape::voxels) && &values == &map.values) {
    const std::int64_t channels = map.planes();
    return {
        last_row, "f4", {channels, height, width}, {size * width * height, -size * width, size}};
  }
  return {last_row, "f4", {height, width}, {-size * width, size}};
}

// The effective numbers of particles of a map.
struct Noise {
  std::shared_ptr<const Map> map;
};

const char* name_of(MapShape shape) {
  switch (shape) {
    case MapShape::plane:
      return "plane";
    case MapShape::velocities:
      return "velocities";
    case MapShape::healpix:
      return "healpix";
    case MapShape::sky:
      return "sky";
    case MapShape::voxels:
      return "voxels";
    case MapShape::profile:
      return "profile";
    case MapShape::histogram:
      return "histogram";
  }
  return "";
}

// Name, unit and edges of each.
std::vector<std::tuple<std::string, std::string, std::vector<double>>> axes_of(const Map& map) {
  std::vector<std::tuple<std::string, std::string, std::vector<double>>> axes;
  for (const MapAxis& axis : map.axes) {
    std::vector<double> edges;
    for (int i = 0; i <= axis.cells; ++i)
      edges.push_back(axis.edge(i));
    axes.emplace_back(axis.name, axis.unit, std::move(edges));
  }
  return axes;
}

// A device, or the reference; it keeps compiled kernels and buffers from map to map.
class MapDrawer {
 public:
  MapDrawer(std::string device, bool by_reference, bool certify)
      : by_reference_(by_reference), certify_(certify), device_(std::move(device)) {}

  // A map, and notes.
  py::Object draw(const Scene& scene, const Source& source, py::Object report) {
    const Progress progress(std::move(report));
    std::vector<std::string> notes;
    auto map = std::make_shared<Map>(without_python([&] {
      const std::lock_guard<Turn> mine(turn_);
      const std::lock_guard<Turn> mine_to_read(source.turn());
      source.refresh();
      notes = source.snapshot().info().notes;
      const ProgressDuring during(*this, progress);
      // Sums in cells need no device.
      const bool is_drawn = !is_made_of_cells(shape_of(scene.map));
      return draw_map(scene, source.snapshot(), is_drawn ? drawing() : DrawFrame(), notes,
                      progress.function());
    }));
    return py::make_tuple(std::move(map), std::move(notes));
  }

 private:
  class ProgressDuring {
   public:
    ProgressDuring(MapDrawer& drawer, const Progress& progress) : drawer_(drawer) {
      drawer_.progress_ = &progress;
    }
    ~ProgressDuring() { drawer_.progress_ = nullptr; }
    ProgressDuring(const ProgressDuring&) = delete;
    ProgressDuring& operator=(const ProgressDuring&) = delete;

   private:
    MapDrawer& drawer_;
  };

  void tell(const char* what, double part) const {
    if (progress_ != nullptr) (*progress_)(what, part);
  }

  DrawFrame drawing() {
    if (by_reference_) {
      return [this](const Frame& frame) {
        const auto tell_part = [this](double part) { tell("drawing with the reference", part); };
        return reference::render(frame, tell_part).to_float();
      };
    }
    if (!renderer_) start();
    return [this](const Frame& frame) { return renderer_->render(frame); };
  }

  void start() {
    RendererOptions options;
    options.device = device_;
    options.certify = certify_;
    options.progress = [this](double part) { tell("drawing", part); };
    renderer_.emplace(options);
  }

  bool by_reference_, certify_;
  std::string device_;
  Turn turn_;
  const Progress* progress_ = nullptr;  // while it draws
  std::optional<Renderer> renderer_;
};

double read_length(const std::string& text, const Scene& scene, const Source& source,
                   const std::string& what) {
  return without_python([&] {
    return source.in_turn(
        [&](const Snapshot& snapshot) { return read_map_length(text, scene, snapshot, what); });
  });
}

std::vector<std::string> write(const Map& map, const std::filesystem::path& path,
                               const Scene& scene, const Source& source) {
  return without_python([&] {
    const SnapshotInfo info = source.in_turn([](const Snapshot& s) { return s.info(); });
    check_map_path(path);
    check_map_output(path, scene, info);
    return write_map(
        path, map, scene, info,
        {{"splotchcl:scene", format_scene(scene)}, {"splotchcl:version", SPLOTCHCL_VERSION}});
  });
}

}  // namespace

void bind_maps(py::Module& module) {
  py::Class<Noise>(module, "splotchcl._core.Noise")
      .property("__array_interface__", [](const Noise& noise) {
        return layout_of(*noise.map, noise.map->effective_particles);
      });
  py::Class<Map>(module, "splotchcl._core.Map")
      .property("__array_interface__", [](const Map& map) { return layout_of(map, map.values); })
      .property("noise",
                [](const std::shared_ptr<Map>& map) -> std::optional<Noise> {
                  if (map->effective_particles.empty()) return std::nullopt;
                  return Noise{map};
                })
      .property("shape", [](const Map& map) { return name_of(map.shape); })
      .property("axes", py::function<&axes_of>)
      .property("width", py::variable<&Map::width>)
      .property("height", py::variable<&Map::height>)
      .property("quantity", py::variable<&Map::quantity>)
      .property("unit", py::variable<&Map::unit>)
      .property("length_unit", py::variable<&Map::length_unit>)
      .property("right_name", py::variable<&Map::right_name>)
      .property("up_name", py::variable<&Map::up_name>)
      .property("pixel", py::variable<&Map::pixel>)
      .property("velocity",
                [](const Map& map) -> std::optional<std::tuple<int, double, double, std::string>> {
                  if (!map.velocity) return std::nullopt;
                  const VelocityAxis& axis = *map.velocity;
                  return std::make_tuple(axis.channels, axis.first, axis.step, axis.unit);
                })
      .property("center_right", py::variable<&Map::center_right>)
      .property("center_up", py::variable<&Map::center_up>)
      .property("tolerance", py::variable<&Map::tolerance>)
      .property("particles", py::variable<&Map::particles>)
      .property("bad_particles", py::variable<&Map::bad_particles>)
      .def("save", py::function<&write>);
  py::Class<MapDrawer>(module, "splotchcl._core.MapDrawer")
      .init<std::string, bool, bool>()
      .def("draw", py::function<&MapDrawer::draw>);
  module.def("read_map_length", py::function<&read_length>);
}

}  // namespace splotchcl::python
