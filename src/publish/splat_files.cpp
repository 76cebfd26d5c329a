#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "publish/viewer_splats.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Adds numbers to a file, their lowest bytes first, on any machine.
void append(std::string& file, std::uint32_t number) {
  for (int byte = 0; byte < 4; ++byte)
    file += static_cast<char>(number >> (8 * byte) & 255);
}

template <std::size_t count>
void append(std::string& file, const std::array<float, count>& numbers) {
  for (const float number : numbers) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    append(file, bits);
  }
}

constexpr float constant_harmonic = 0.28209479F;  // 1 / sqrt(4 pi)

// A color as the constant term of spherical harmonics has it in these files.
std::array<float, 3> harmonic_of(const std::array<float, 3>& color) {
  std::array<float, 3> harmonic{};
  for (std::size_t channel = 0; channel < 3; ++channel)
    harmonic[channel] = (color[channel] - 0.5F) / constant_harmonic;
  return harmonic;
}

// With the y axis up and the z axis towards the camera.
std::array<float, 3> upwards(const std::array<float, 3>& place) {
  return {place[0], -place[1], -place[2]};
}

using Put = std::function<void(std::string&, const ViewerSplat&)>;

void put_triple(std::string& file, const std::array<float, 3>& numbers) {
  fmt::format_to(std::back_inserter(file), "({}, {}, {})", numbers[0], numbers[1], numbers[2]);
}

void add_array(std::string& file, const char* name, const std::vector<ViewerSplat>& splats,
               const Put& put) {
  file += fmt::format("    {} = [", name);
  const char* comma = "";
  for (const ViewerSplat& splat : splats) {
    file += comma;
    put(file, splat);
    comma = ", ";
  }
  file += "]\n";
}

}  // namespace

std::string as_usda(const std::vector<ViewerSplat>& splats, const std::string& comment) {
  std::string file = "#usda 1.0\n(\n    \"Made by splotchcl: " + comment +
                     "\"\n    defaultPrim = \"Splats\"\n    upAxis = \"Y\"\n)\n\n"
                     "def ParticleField3DGaussianSplat \"Splats\"\n{\n"
                     "    uniform token projectionModeHint = \"perspective\"\n"
                     "    uniform token sortingModeHint = \"cameraDistance\"\n"
                     "    uniform int radiance:sphericalHarmonicsDegree = 0\n";
  add_array(file, "point3f[] positions", splats, [](std::string& text, const ViewerSplat& splat) {
    put_triple(text, upwards(splat.place));
  });
  add_array(file, "quatf[] orientations", splats,
            [](std::string& text, const ViewerSplat&) { text += "(1, 0, 0, 0)"; });
  add_array(file, "float3[] scales", splats, [](std::string& text, const ViewerSplat& splat) {
    put_triple(text, {splat.deviation, splat.deviation, splat.deviation});
  });
  add_array(file, "float[] opacities", splats, [](std::string& text, const ViewerSplat& splat) {
    fmt::format_to(std::back_inserter(text), "{}", splat.opacity);
  });
  add_array(file, "float3[] radiance:sphericalHarmonicsCoefficients", splats,
            [](std::string& text, const ViewerSplat& splat) {
              put_triple(text, harmonic_of(splat.color));
            });
  return file + "}\n";
}

namespace {

constexpr float least_opacity = 1e-6F;

std::string header_of(std::size_t count, const std::string& comment) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment made by splotchcl: {}\nelement vertex {}\n",
      comment, count);
  for (const char* const name :
       {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0",
        "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    header += fmt::format("property float {}\n", name);
  return header + "end_header\n";
}

// Readers take it through the logistic function.
float logit(float opacity) {
  const float inside = std::clamp(opacity, least_opacity, 1 - least_opacity);
  return std::log(inside / (1 - inside));
}

}  // namespace

std::string as_ply(const std::vector<ViewerSplat>& splats, const std::string& comment) {
  std::string file = header_of(splats.size(), comment);
  for (const ViewerSplat& splat : splats) {
    const float scale = std::log(splat.deviation);
    append(file, splat.place);
    append(file, std::array<float, 3>{});  // normals, which nothing uses
    append(file, harmonic_of(splat.color));
    append(file, std::array<float, 1>{logit(splat.opacity)});
    append(file, std::array<float, 3>{scale, scale, scale});
    append(file, std::array<float, 4>{1, 0, 0, 0});
  }
  return file;
}

bool is_splat_file(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  return ending == ".ply" || ending == ".glb" || ending == ".usda";
}

std::string as_splat_file(const std::filesystem::path& path, const std::vector<ViewerSplat>& splats,
                          const Frame& frame, const std::string& comment) {
  if (path.extension() == ".ply") return as_ply(splats, comment);
  return path.extension() == ".glb" ? as_glb(splats, frame, comment) : as_usda(splats, comment);
}

namespace {

using Json = nlohmann::json;

constexpr std::uint32_t magic = 0x46546C67, version = 2;  // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr int float_numbers = 5126, signed_bytes = 5120, unsigned_bytes = 5121;
constexpr std::size_t bytes_per_splat = 48;
constexpr double most_bytes = 4e9;
constexpr double near_part = 0.01, far_distance = 100;

// Columns of numbers one after the other, and how glTF finds them.
class Columns {
 public:
  explicit Columns(const std::vector<ViewerSplat>& splats) : splats_(splats) {}

  int add(const char* shape, int kind,
          const std::function<void(std::string&, const ViewerSplat&)>& put) {
    const std::size_t begin = bytes_.size();
    for (const ViewerSplat& splat : splats_)
      put(bytes_, splat);
    views_.push_back({{"buffer", 0},
                      {"byteOffset", begin},
                      {"byteLength", bytes_.size() - begin},
                      {"target", 34962}});
    Json accessor = {{"bufferView", views_.size() - 1},
                     {"componentType", kind},
                     {"count", splats_.size()},
                     {"type", shape}};
    if (kind != float_numbers) accessor["normalized"] = true;
    accessors_.push_back(accessor);
    return static_cast<int>(accessors_.size()) - 1;
  }

  Json& accessor(int number) { return accessors_[static_cast<std::size_t>(number)]; }
  const Json& accessors() const { return accessors_; }
  const Json& views() const { return views_; }
  const std::string& bytes() const { return bytes_; }

 private:
  const std::vector<ViewerSplat>& splats_;
  std::string bytes_;
  Json accessors_ = Json::array(), views_ = Json::array();
};

void put_byte(std::string& file, double part) {
  file += static_cast<char>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
}

// Of programs that draw points: linear light.
void put_point_color(std::string& file, const ViewerSplat& splat) {
  constexpr double gamma_of_srgb = 2.2;
  for (const float value : splat.color)
    put_byte(file, std::pow(static_cast<double>(value), gamma_of_srgb));
  put_byte(file, static_cast<double>(splat.opacity));
}

// The box of the places, which glTF asks for.
void set_bounds(Json& accessor, const std::vector<ViewerSplat>& splats) {
  std::array<float, 3> least = upwards(splats.front().place), most = least;
  for (const ViewerSplat& splat : splats) {
    const std::array<float, 3> place = upwards(splat.place);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], place[axis]);
      most[axis] = std::max(most[axis], place[axis]);
    }
  }
  accessor["min"] = least;
  accessor["max"] = most;
}

Json attributes_of(Columns& columns, const std::vector<ViewerSplat>& splats) {
  const auto name = [](const char* what) { return std::string("KHR_gaussian_splatting:") + what; };
  Json attributes;
  const int places = columns.add("VEC3", float_numbers, [](std::string& file, const auto& splat) {
    append(file, upwards(splat.place));
  });
  set_bounds(columns.accessor(places), splats);
  attributes["POSITION"] = places;
  attributes[name("ROTATION")] =
      columns.add("VEC4", signed_bytes, [](std::string& file, const auto&) {
        file += {0, 0, 0, 127};
      });
  attributes[name("SCALE")] =
      columns.add("VEC3", float_numbers, [](std::string& file, const auto& splat) {
        append(file, std::array<float, 3>{splat.deviation, splat.deviation, splat.deviation});
      });
  attributes[name("OPACITY")] =
      columns.add("SCALAR", float_numbers, [](std::string& file, const auto& splat) {
        append(file, std::array<float, 1>{splat.opacity});
      });
  attributes[name("SH_DEGREE_0_COEF_0")] = columns.add(
      "VEC3", float_numbers,
      [](std::string& file, const auto& splat) { append(file, harmonic_of(splat.color)); });
  attributes["COLOR_0"] = columns.add("VEC4", unsigned_bytes, put_point_color);
  return attributes;
}

// The distance from the look-at point, in halves of the picture's width.
double distance_of(const Frame& frame) {
  return 2 * frame.camera.focal_pixels / frame.width;
}

Json gltf_camera(const Frame& frame) {
  const double distance = distance_of(frame), near = near_part * distance;
  const double shape = static_cast<double>(frame.width) / frame.height;
  if (frame.projection == Projection::orthographic) {
    const Json lens = {
        {"xmag", 1}, {"ymag", 1 / shape}, {"znear", near}, {"zfar", far_distance * distance}};
    return {{"type", "orthographic"}, {"orthographic", lens}};
  }
  const Json lens = {
      {"yfov", 2 * std::atan(1 / (shape * distance))}, {"aspectRatio", shape}, {"znear", near}};
  return {{"type", "perspective"}, {"perspective", lens}};
}

Json document_of(const Frame& frame, const Columns& columns, const Json& attributes,
                 const std::string& comment) {
  const Json splatting = {{"kernel", "ellipse"},
                          {"colorSpace", "srgb_rec709_display"},
                          {"sortingMethod", "cameraDistance"},
                          {"projection", "perspective"}};
  const Json primitive = {{"mode", 0},
                          {"attributes", attributes},
                          {"extensions", {{"KHR_gaussian_splatting", splatting}}}};
  const Json camera_node = {{"camera", 0}, {"translation", {0, 0, distance_of(frame)}}};
  return {{"asset",
           {{"version", "2.0"}, {"generator", "splotchcl"}, {"extras", {{"comment", comment}}}}},
          {"extensionsUsed", {"KHR_gaussian_splatting"}},
          {"scene", 0},
          {"scenes", Json::array({{{"nodes", {0, 1}}}})},
          {"nodes", Json::array({{{"mesh", 0}}, camera_node})},
          {"cameras", Json::array({gltf_camera(frame)})},
          {"meshes", Json::array({{{"primitives", Json::array({primitive})}}})},
          {"accessors", columns.accessors()},
          {"bufferViews", columns.views()},
          {"buffers", Json::array({{{"byteLength", columns.bytes().size()}}})}};
}

void append_chunk(std::string& file, std::uint32_t kind, const std::string& bytes) {
  append(file, static_cast<std::uint32_t>(bytes.size()));
  append(file, kind);
  file += bytes;
}

}  // namespace

std::string as_glb(const std::vector<ViewerSplat>& splats, const Frame& frame,
                   const std::string& comment) {
  if (splats.empty() || static_cast<double>(splats.size() * bytes_per_splat) > most_bytes)
    throw DataError(
        "the picture has no light, or more splats than glTF can hold, so that no "
        ".glb can be made; expected some, and fewer than 80 million");
  Columns columns(splats);
  const Json attributes = attributes_of(columns, splats);
  std::string document = document_of(frame, columns, attributes, comment).dump();
  document.append((4 - document.size() % 4) % 4, ' ');
  constexpr std::size_t headers = 28;
  std::string file;
  append(file, magic);
  append(file, version);
  append(file, static_cast<std::uint32_t>(headers + document.size() + columns.bytes().size()));
  append_chunk(file, json_chunk, document);
  append_chunk(file, binary_chunk, columns.bytes());
  return file;
}

}  // namespace splotchcl
