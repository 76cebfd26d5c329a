#include <algorithm>
#include <cmath>
#include <utility>

#include "image/picture_encoders.h"
#include "python/bindings.h"
#include "python/interface/casts.h"
#include "python/progress.h"
#include "splotchcl/compare.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/palette_file.h"

namespace splotchcl::python {
namespace {

py::ArrayLayout layout_of(const PictureObject& picture) {
  const Image& linear = picture.linear();
  return {linear.pixels.data(), "f4", {linear.height, linear.width, 4}};
}

py::Object bytes_of(const std::vector<std::uint8_t>& bytes) {
  return py::Object::owning(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(bytes.data()),
                                                      static_cast<Py_ssize_t>(bytes.size())));
}

std::vector<std::uint8_t> display(const PictureObject& picture) {
  return display_bytes("the picture", picture.image, picture.options);
}

std::vector<std::uint8_t> png(const PictureObject& picture) {
  const char* const name = "the picture";
  const auto [width, height] = std::pair(picture.image.width, picture.image.height);
  if (picture.options.bits == 16) {
    return encode_png(name, width, height, display_words(name, picture.image, picture.options));
  }
  return encode_png(name, width, height, display(picture));
}

py::Dict compare(const PictureObject& picture, const PictureObject& reference, double limit) {
  const ImageDifference difference =
      without_python([&] { return compare_images(picture.linear(), reference.linear(), limit); });
  py::Dict result;
  result.set("worst", difference.worst);
  result.set("worst_pixel", py::make_tuple(difference.worst_x, difference.worst_y));
  result.set("worst_channel", difference.worst_channel);
  result.set("maximum", difference.overall.maximum);
  result.set("rms", difference.overall.rms);
  result.set("psnr", difference.overall.psnr);
  result.set("relative_l2", difference.overall.relative_l2);
  result.set("pixels_beyond", difference.pixels_beyond);
  result.set("pixels_not_finite", difference.pixels_not_finite);
  return result;
}

// Like the program.
void save(const PictureObject& picture, const std::filesystem::path& path, bool as_displayed) {
  check_image_path(path);
  if (as_displayed || picture.light.pixels.empty()) {
    write_image(path, picture.image, picture.options);
  } else {
    const Picture both = {"", picture.image, picture.light, picture.options.places};
    write_pictures(path, {both}, picture.options);
  }
}

// 256 colors of a palette as a screen shows them.
std::vector<std::array<double, 3>> palette_colors(const std::string& name, double gamma) {
  constexpr int count = 256;
  const Palette palette = load_palette(name);
  std::vector<std::array<double, 3>> colors;
  for (int i = 0; i < count; ++i) {
    std::array<double, 3> color = sample_knots(palette.emission, i / double{count - 1});
    for (double& channel : color)
      channel = std::pow(std::clamp(channel, 0.0, 1.0), 1 / gamma);
    colors.push_back(color);
  }
  return colors;
}

}  // namespace

void bind_pictures(py::Module& module) {
  py::Class<PictureObject>(module, "splotchcl._core.Picture")
      .property("__array_interface__", [](const PictureObject& p) { return layout_of(p); })
      .property("width", [](const PictureObject& p) { return p.image.width; })
      .property("height", [](const PictureObject& p) { return p.image.height; })
      .def("display",
           [](const PictureObject& p) {
             return bytes_of(without_python([&] { return display(p); }));
           })
      .def("png",
           [](const PictureObject& p) { return bytes_of(without_python([&] { return png(p); })); })
      .def("save", [](const PictureObject& p, const std::filesystem::path& path,
                      bool display) { without_python([&] { save(p, path, display); }); })
      .def("compare", py::function<&compare>);
  module.def("read_image", [](const std::filesystem::path& path) {
    return without_python([&] { return PictureObject{read_image(path), {}}; });
  });
  module.def("palette_colors", py::function<&palette_colors>);
}

}  // namespace splotchcl::python
