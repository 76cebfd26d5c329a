// Pictures, as backgrounds and comparisons read them. The first byte chooses the ending.
#include "fuzz/fuzz.h"
#include "splotchcl/image_file.h"

void splotchcl::fuzz::fuzz_image(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  constexpr const char* endings[] = {".png", ".exr", ".tif", ".hdr",
                                     ".jpg", ".bmp", ".ppm", ".tga"};
  if (size == 0) return;
  std::filesystem::path path = fuzz::scratch_file();
  path += endings[data[0] % std::size(endings)];
  {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  }
  try {
    // A header may claim any size: only what would be read in a moment is.
    const ImageFileInfo info = read_image_info(path);
    constexpr std::int64_t most_pixels = 1 << 18;
    if (std::int64_t{info.width} * info.height > most_pixels) return;
    const Image image = read_image(path);
    if (image.width != info.width || image.height != info.height) std::abort();
    LinearImageOptions options;
    options.longest_side = 16;
    const Image small = read_linear_image(path, options);
    if (small.width > 16 || small.height > 16) std::abort();
  } catch (const Error&) {
    // refused
  }
}
