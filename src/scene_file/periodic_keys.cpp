#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {
namespace {

ValueType<BoxSides> box_sides() {
  const auto read = [](const toml::node& node) -> std::optional<BoxSides> {
    std::vector<double> sides;
    if (const auto side = number().read(node)) sides = {*side};
    if (const auto all = vector().read(node)) sides.assign(all->a, all->a + 3);
    return box_of(sides);
  };
  const auto write = [](const BoxSides& box) {
    return box.is_cube() ? write_number(box[0]) : vector().write(box.vector());
  };
  return {"a number > 0, or [x, y, z], each > 0", read, write};
}

}  // namespace

Keys periodic_keys() {
  return written_if_set({
      key("periodic.wrap", boolean(), &PeriodicSettings::wrap,
          {"Draw each particle at its periodic image nearest to `camera.look_at`."}),
      key("periodic.box", box_sides(), &PeriodicSettings::box,
          {"Side of the periodic box, or one for each axis.", "length",
           "as the snapshot's header says"}),
  });
}

}  // namespace splotchcl::scene_file
