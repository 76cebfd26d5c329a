#pragma once

#include <filesystem>
#include <optional>

#include "splotchcl/scene.h"

namespace splotchcl {

// What players must know of a film's pictures to show them as they are meant.
struct FilmLayout {
  enum class Eyes { one, side_by_side, top_bottom };
  // Of a panorama, in degrees.
  struct Panorama {
    double width = 360, height = 180;
  };

  Eyes eyes = Eyes::one;
  std::optional<Panorama> panorama;

  bool is_plain() const { return eyes == Eyes::one && !panorama; }
};

FilmLayout layout_of(const Scene& scene);

// Whether a film of this name can say all of it: .mp4 and .mov can, .mkv and .webm say the eyes.
bool can_tell(const std::filesystem::path& path, const FilmLayout& layout);

// Writes it into a film of MP4 or QuickTime: boxes st3d and sv3d, as spherical video has them in
// its second version. Throws DataError where the film is not built as expected.
void write_layout(const std::filesystem::path& film, const FilmLayout& layout);

}  // namespace splotchcl
