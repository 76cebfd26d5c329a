#pragma once

#include <cstdint>
#include <string>
#include <vector>

// What the original program draws, restated from docs/original-files.md in double precision
// and nothing else: it shares no code with this program.
namespace splotchcl::test {

struct OriginalParticle {
  double x, y, z;
  double h;      // as the snapshot has it
  double color;  // already normalised to 0..1
  double intensity = 1;
};

struct OriginalPicture {
  int xres = 32, yres = 32;
  double fov = 45;
  bool is_flat = false;
  bool a_eq_e = true;
  double gray_absorption = 0.2;
  double minrad_pix = 1;
  double size_fac = 1, smooth_factor = 1, brightness = 1;
  double camera[3] = {0, 0, 0}, lookat[3] = {0, 0, 1}, sky[3] = {0, 1, 0};
  std::vector<double> palette;  // red, green, blue of each knot, 0..255
};

// Bytes, three for each pixel, row 0 at the top.
std::vector<std::uint8_t> draw_as_original(const OriginalPicture& picture,
                                           std::vector<OriginalParticle> particles);

}  // namespace splotchcl::test
