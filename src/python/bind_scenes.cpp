#include <mutex>

#include "film/follow/followed_particles.h"
#include "film/path/film_path.h"
#include "formula/formula.h"
#include "open_scene/shown_snapshot.h"
#include "python/bindings.h"
#include "python/progress.h"
#include "python/source.h"
#include "scene_file/keys.h"
#include "scene_file/suggested.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_source.h"
#include "splotchcl/views.h"

namespace splotchcl::python {
namespace {

using Settings = std::vector<std::string>;
using Notes = std::vector<std::string>;

// A scene whose file names hold wherever it is written to.
Scene with_absolute_names(Scene scene) {
  scene_file::change_file_names(scene, [](const std::string& name) {
    return name.empty() ? name : std::filesystem::absolute(name).string();
  });
  return scene;
}

py::Object open(const std::filesystem::path& path, const Settings& settings) {
  SceneWithSnapshot opened = without_python([&] { return open_scene(path, settings); });
  return py::make_tuple(std::move(opened.scene), std::make_shared<Source>(opened.snapshot),
                        std::move(opened.notes), std::move(opened.suggested));
}

Scene with_settings(const Scene& scene, const Settings& settings, const Scene* suggested) {
  return scene_file::apply_settings_to_suggested(scene, suggested, settings);
}

template <typename Work>
auto in_turn(const Source& source, Work&& work) {
  return without_python([&] {
    const std::lock_guard<Turn> mine(source.turn());
    source.refresh();
    return work();
  });
}

// For as long as the source is there.
std::shared_ptr<const Snapshot> not_owned(const Snapshot& snapshot) {
  return {std::shared_ptr<const Snapshot>(), &snapshot};
}

py::Object as_tuple(SceneWithSnapshot opened) {
  return py::make_tuple(std::move(opened.scene), std::move(opened.notes),
                        std::move(opened.suggested));
}

py::Object decide_scene(const Scene& scene, const Source& source, py::Object report) {
  const Progress progress(std::move(report));
  Notes notes;
  Scene fixed = in_turn(source, [&] {
    return fixed_scene(decide(scene, source.snapshot(), notes, progress.function()));
  });
  return py::make_tuple(std::move(fixed), std::move(notes));
}

std::vector<Scene> scenes_of_path(const Scene& scene) {
  Notes notes;
  const FilmPath path(scene, notes, find_followed);
  path.check(scene);
  std::vector<Scene> scenes;
  for (int frame = 0; frame < path.frame_count(); ++frame)
    scenes.push_back(path.scene_at(scene, frame));
  return scenes;
}

void bind_scene(py::Module& module) {
  py::Class<Scene>(module, "splotchcl._core.Scene")
      .def("with_settings", py::function<&with_settings>)
      .def("to_toml", py::function<&format_scene>)
      .def("with_absolute_names", py::function<&with_absolute_names>)
      .def("frames",
           [](const Scene& scene) { return without_python([&] { return scenes_of_path(scene); }); })
      .def("component_names",
           [](const Scene& scene) {
             std::vector<std::string> names;
             for (const Component& component : scene.components)
               names.push_back(component.name);
             return names;
           })
      .property("gamma", [](const Scene& scene) { return scene.image.gamma; })
      .property("size", [](const Scene& scene) {
        return std::make_pair(scene.image.width, scene.image.height);
      });
}

}  // namespace

void bind_scenes(py::Module& module) {
  bind_scene(module);
  module.def("open_scene", py::function<&open>);
  module.def("scene_keys", py::function<&scene_file::key_names>);
  module.def("read_scene", [](const std::filesystem::path& path, const Settings& settings) {
    return read_scene_file(path, settings);
  });
  module.def("parse_scene", [](const std::string& text, const Settings& settings) {
    return parse_scene(text, "scene", settings);
  });
  module.def("snapshot_of", [](const Scene& scene) {
    return without_python([&] { return std::make_shared<Source>(SnapshotSource().at(scene)); });
  });
  module.def("show_snapshot", [](const Source& source, const Settings& settings) {
    return as_tuple(
        in_turn(source, [&] { return show_snapshot(not_owned(source.snapshot()), settings); }));
  });
  module.def("show_scene", [](const Scene& scene, const Scene* suggested, const Source& source,
                              const Settings& settings) {
    return as_tuple(in_turn(source, [&] {
      SceneWithSnapshot opened;
      opened.scene = scene;
      opened.snapshot = not_owned(source.snapshot());
      if (suggested != nullptr) opened.suggested = *suggested;
      return show_scene(std::move(opened), settings);
    }));
  });
  module.def("may_be_formula", py::function<&Formula::may_be>);
  module.def("tell_not_drawn", [](const Scene& scene, const Source& source) {
    return in_turn(source, [&] { return tell_not_drawn(scene, source.snapshot()); });
  });
  module.def("decide", py::function<&decide_scene>);
}

}  // namespace splotchcl::python
