#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {

Keys periodic_keys() {
  return written_if_set({
      key("periodic.wrap", boolean(), &PeriodicSettings::wrap,
          {"Draw each particle at its periodic image nearest to `camera.look_at`, so that the "
           "point looked at is the middle of the box."}),
      key("periodic.box", number(more_than(0)), &PeriodicSettings::box,
          {"Side of the periodic box.", "length", "as the snapshot's header says"}),
  });
}

}  // namespace splotchcl::scene_file
