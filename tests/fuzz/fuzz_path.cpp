#include "film/path/path_table.h"
#include "fuzz/fuzz.h"
#include "splotchcl/scene_file.h"

// A path file, and the scene of each of its frames.
void splotchcl::fuzz::fuzz_path(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  static const Scene scene = parse_scene(
      "snapshot = 'snapshot'\n[camera]\nposition = [0, 0, -9]\nlook_at = [0, 0, 0]\n"
      "[[component]]\nname = 'gas'\ncolor.field = 'density'\n",
      "fuzz");
  fuzz::write_scratch(data, size);
  try {
    const PathTable table(fuzz::scratch_file(), scene);
    for (int row = 0; row < std::min(table.row_count(), 20); ++row) {
      try {
        apply_settings(scene, table.settings(row));
      } catch (const Error&) {
        // a frame that cannot be drawn
      }
    }
  } catch (const Error&) {
    // refused
  }
}
