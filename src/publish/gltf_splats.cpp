#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>

#include "publish/little_endian.h"
#include "publish/splat_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
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
