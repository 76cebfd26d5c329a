#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "image/png_file.h"
#include "python/bindings.h"
#include "python/progress.h"
#include "splotchcl/compare.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/palette_file.h"

namespace splotchcl::python {
namespace {

py::buffer_info buffer_of_picture(const PictureObject& picture) {
  constexpr auto size = static_cast<py::ssize_t>(sizeof(float));
  const Image& linear = picture.linear();
  const auto width = static_cast<py::ssize_t>(linear.width);
  const auto height = static_cast<py::ssize_t>(linear.height);
  constexpr bool is_read_only = true;
  return {const_cast<float*>(linear.pixels.data()),  // read-only all the same
          size,
          py::format_descriptor<float>::format(),
          3,
          {height, width, py::ssize_t{4}},
          {4 * size * width, 4 * size, size},
          is_read_only};
}

py::bytes bytes_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
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

py::dict compare(const PictureObject& picture, const PictureObject& reference, double limit) {
  const ImageDifference difference =
      without_python([&] { return compare_images(picture.linear(), reference.linear(), limit); });
  py::dict result;
  result["worst"] = difference.worst;
  result["worst_pixel"] = py::make_tuple(difference.worst_x, difference.worst_y);
  result["worst_channel"] = difference.worst_channel;
  result["maximum"] = difference.overall.maximum;
  result["rms"] = difference.overall.rms;
  result["psnr"] = difference.overall.psnr;
  result["relative_l2"] = difference.overall.relative_l2;
  result["pixels_beyond"] = difference.pixels_beyond;
  result["pixels_not_finite"] = difference.pixels_not_finite;
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

void bind_pictures(py::module_& module) {
  py::class_<PictureObject>(module, "Picture", py::buffer_protocol())
      .def_buffer(&buffer_of_picture)
      .def_property_readonly("width", [](const PictureObject& p) { return p.image.width; })
      .def_property_readonly("height", [](const PictureObject& p) { return p.image.height; })
      .def("display",
           [](const PictureObject& p) {
             return bytes_of(without_python([&] { return display(p); }));
           })
      .def("png",
           [](const PictureObject& p) { return bytes_of(without_python([&] { return png(p); })); })
      .def("save", [](const PictureObject& p, const std::filesystem::path& path,
                      bool display) { without_python([&] { save(p, path, display); }); })
      .def("compare", &compare);
  module.def("read_image", [](const std::filesystem::path& path) {
    return without_python([&] { return PictureObject{read_image(path), {}}; });
  });
  module.def("palette_colors", &palette_colors);
}

}  // namespace splotchcl::python
