#include <functional>
#include <map>

#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "python/bindings.h"
#include "python/progress.h"
#include "splotchcl/error.h"
#include "splotchcl/galaxy.h"

namespace splotchcl::python {
namespace {

using Given = std::map<std::string, py::Object>;
using Set = std::function<void(GalaxySettings&, PyObject*)>;

template <typename Value>
Set member(Value GalaxySettings::*value) {
  return [value](GalaxySettings& settings, PyObject* given) {
    settings.*value = py::from<Value>(given);
  };
}

// As the command line names them.
const std::map<std::string, Set>& settings_by_name() {
  using S = GalaxySettings;
  static const std::map<std::string, Set> known = {
      {"center", member(&S::center)},
      {"inclination", member(&S::inclination_degrees)},
      {"position_angle", member(&S::position_angle_degrees)},
      {"radius", member(&S::radius_pixels)},
      {"size", member(&S::size_kpc)},
      {"threshold", member(&S::threshold)},
      {"removes_stars", member(&S::removes_stars)},
      {"flare", member(&S::flare)},
      {"gas_height", member(&S::gas_height_kpc)},
      {"cloud_points", member(&S::cloud_points)},
      {"cloud_radius", member(&S::cloud_radius_pixels)},
      {"dust", member(&S::dust)},
      {"dust_height", member(&S::dust_height_kpc)},
      {"dust_points", member(&S::dust_points)},
      {"detail", member(&S::detail)},
      {"disk_stars", member(&S::disk_stars)},
      {"disk_width", member(&S::disk_width)},
      {"disk_height", member(&S::disk_height_kpc)},
      {"disk_light", member(&S::disk_light)},
      {"bulge_stars", member(&S::bulge_stars)},
      {"bulge_radius", member(&S::bulge_radius_kpc)},
      {"bulge_light", member(&S::bulge_light)},
      {"clusters", member(&S::clusters)},
      {"cluster_stars", member(&S::cluster_stars)},
      {"cluster_light", member(&S::cluster_light)},
      {"clockwise", member(&S::turns_clockwise)},
      {"seed", member(&S::seed)},
  };
  return known;
}

GalaxySettings settings_of(const Given& given) {
  GalaxySettings settings;
  for (const auto& [name, value] : given) {
    const auto found = settings_by_name().find(name);
    if (found == settings_by_name().end()) throw UsageError("galaxy: there is no " + name);
    try {
      found->second(settings, value.get());
    } catch (const py::CastError&) {
      throw UsageError("galaxy: " + name + ": found " + py::repr(value.get()) +
                       ", expected a value as its default");
    }
  }
  return settings;
}

// As the command does it, the file's checks included.
void make_file(const std::filesystem::path& picture, const std::filesystem::path& output,
               const Given& given, std::optional<double> gamma, double speed, double core,
               const std::optional<std::filesystem::path>& rotation_curve) {
  GalaxySettings settings = settings_of(given);
  without_python([&] {
    check_output_path(output);
    check_outputs({{output, "path"}}, [&] {
      std::set<std::filesystem::path> inputs = {picture};
      if (rotation_curve) inputs.insert(*rotation_curve);
      return inputs;
    });
    settings.rotation =
        rotation_curve ? read_rotation_curve(*rotation_curve) : RotationCurve::flat(speed, core);
    write_galaxy(output, read_galaxy(picture, settings, gamma));
  });
}

}  // namespace

void bind_galaxy(py::Module& module) {
  module.def("make_galaxy_file", py::function<&make_file>);
}

}  // namespace splotchcl::python
