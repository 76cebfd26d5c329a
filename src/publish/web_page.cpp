#include "publish/web_page.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "finish/tone.h"
#include "scene/plan/light_structure.h"
#include "splotchcl/error.h"
#include "splotchcl_embedded/published_page.h"

namespace splotchcl {
namespace {

constexpr float most_code = 65535;
constexpr float octaves_of_light = 30;
constexpr std::size_t sigma_column = 3, first_light_column = 4, first_depth_column = 7;

std::uint16_t code_of(float value, float least, float most, float first_code) {
  if (!(most > least)) return static_cast<std::uint16_t>(first_code);
  const float part = std::clamp((value - least) / (most - least), 0.0F, 1.0F);
  return static_cast<std::uint16_t>(std::lround(first_code + part * (most_code - first_code)));
}

float value_of(std::uint16_t code, float least, float most, float first_code) {
  return least +
         (most - least) * (static_cast<float>(code) - first_code) / (most_code - first_code);
}

// 0: none. `value` is light or a depth, and what bounds it logarithms.
std::uint16_t code_or_none(float value, float least, float most) {
  const float logarithm = std::log2(value);
  return logarithm < least ? std::uint16_t{0} : code_of(logarithm, least, most, 1);
}

float value_or_none(std::uint16_t code, float least, float most) {
  return code == 0 ? 0.0F : std::exp2(value_of(code, least, most, 1));
}

// How many depths each splat needs.
std::size_t depths_of(const std::vector<LightSplat>& splats) {
  std::size_t depths = 0;
  for (const LightSplat& splat : splats) {
    const auto& [red, green, blue] = splat.depth;
    if (red != green || red != blue) return 3;
    if (red > 0) depths = 1;
  }
  return depths;
}

// Where the numbers lie that the codes are of.
PackedSplats ranges_of(const std::vector<LightSplat>& splats) {
  PackedSplats packed;
  if (splats.empty()) return packed;
  packed.lower = packed.upper = splats.front().place;
  float least_sigma = splats.front().sigma, most_sigma = least_sigma, most_light = 0,
        most_depth = 0;
  for (const LightSplat& splat : splats) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      packed.lower[axis] = std::min(packed.lower[axis], splat.place[axis]);
      packed.upper[axis] = std::max(packed.upper[axis], splat.place[axis]);
      most_light = std::max(most_light, splat.light[axis]);
      most_depth = std::max(most_depth, splat.depth[axis]);
    }
    least_sigma = std::min(least_sigma, splat.sigma);
    most_sigma = std::max(most_sigma, splat.sigma);
  }
  packed.least_sigma = std::log2(least_sigma);
  packed.most_sigma = std::log2(most_sigma);
  // Of what absorbs alone there is no light.
  packed.most_light = most_light > 0 ? std::log2(most_light) : 0.0F;
  packed.least_light = packed.most_light - octaves_of_light;
  packed.most_depth = most_depth > 0 ? std::log2(most_depth) : 0.0F;
  packed.least_depth = packed.most_depth - octaves_of_light;
  packed.columns.resize(first_depth_column + depths_of(splats));
  return packed;
}

std::string base64(const std::vector<Bytef>& bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(bytes[i + k]) : 0U;
    };
    const unsigned bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace

PackedSplats pack(const std::vector<LightSplat>& splats) {
  PackedSplats packed = ranges_of(splats);
  for (const LightSplat& splat : splats) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      packed.columns[axis].push_back(
          code_of(splat.place[axis], packed.lower[axis], packed.upper[axis], 0));
      packed.columns[first_light_column + axis].push_back(
          code_or_none(splat.light[axis], packed.least_light, packed.most_light));
      if (axis < packed.depths())
        packed.columns[first_depth_column + axis].push_back(
            code_or_none(splat.depth[axis], packed.least_depth, packed.most_depth));
    }
    packed.columns[sigma_column].push_back(
        code_of(std::log2(splat.sigma), packed.least_sigma, packed.most_sigma, 0));
  }
  return packed;
}

std::vector<LightSplat> unpack(const PackedSplats& packed) {
  std::vector<LightSplat> splats(packed.count());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    LightSplat& splat = splats[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      splat.place[axis] =
          value_of(packed.columns[axis][i], packed.lower[axis], packed.upper[axis], 0);
      splat.light[axis] = value_or_none(packed.columns[first_light_column + axis][i],
                                        packed.least_light, packed.most_light);
      if (packed.depths() == 0) continue;
      const std::size_t depth = first_depth_column + (packed.depths() == 3 ? axis : 0);
      splat.depth[axis] =
          value_or_none(packed.columns[depth][i], packed.least_depth, packed.most_depth);
    }
    splat.sigma = std::exp2(
        value_of(packed.columns[sigma_column][i], packed.least_sigma, packed.most_sigma, 0));
  }
  return splats;
}

std::string as_text(const PackedSplats& packed) {
  std::vector<Bytef> bytes;
  bytes.reserve(packed.count() * 2 * packed.columns.size());
  for (const std::vector<std::uint16_t>& column : packed.columns) {
    for (const std::uint16_t code : column)
      bytes.push_back(static_cast<Bytef>(code & 255));
    for (const std::uint16_t code : column)
      bytes.push_back(static_cast<Bytef>(code >> 8));
  }
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<Bytef> deflated(size);
  const int status = compress2(deflated.data(), &size, bytes.data(),
                               static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw DataError("there is not enough memory to pack the splats of a page");
  deflated.resize(size);
  return base64(deflated);
}

namespace {

using Json = nlohmann::json;

Json json_of(const Vec3& v) {
  return {v.a[0], v.a[1], v.a[2]};
}

// Light over what absorbs it; 0: nothing absorbs.
double source_of(const Frame& frame) {
  const LightStructure structure = find_light_structure(frame);
  return structure.light == LightPlan::proportional ? structure.source[0] : 0.0;
}

Json camera_of(const Frame& frame) {
  const CameraFrame& camera = frame.camera;
  return {{"right", json_of(camera.right)},
          {"down", json_of(camera.down)},
          {"forward", json_of(camera.forward)},
          {"distance", camera.look_at_distance},
          {"focal", camera.focal_pixels},
          {"width", frame.width},
          {"height", frame.height},
          {"flat", frame.projection == Projection::orthographic}};
}

// What light becomes when white is balanced, column by column. What it does with (1, 1, 1) is
// added, so that nothing is below 0.
Json balance_of(const FinishSettings& finish) {
  Image image(4, 1);
  for (int x = 0; x < 4; ++x) {
    for (int c = 0; c < 3; ++c)
      image.at(x, 0)[c] = x == c ? 2.0F : 1.0F;
  }
  if (finish.white_balance) balance_white(image, *finish.white_balance);
  Json columns = Json::array();
  for (int x = 0; x < 3; ++x) {
    for (int c = 0; c < 3; ++c)
      columns.push_back(image.at(x, 0)[c] - image.at(3, 0)[c]);
  }
  return columns;
}

// Where a splat ends, in units of white: what it still shows there, beside dark, is half a step of
// 255, so that no edge is seen; never less exact than 2e-5, as many lie over a pixel.
double least_light(const FinishSettings& finish, double gamma) {
  constexpr double half_a_step = 0.5 / 255, most = 2e-5, least = 1e-7, dark = 1e-6;
  const double pivot = finish.contrast_pivot, contrast = std::max(finish.contrast, 0.1);
  const double value = pivot * std::pow(half_a_step / pivot, 1 / contrast);
  const double white = finish.white.value_or(1);
  const double slope = tone(finish.tone, dark * white, white) / dark;
  return std::clamp(std::pow(value, gamma) / slope, least, most);
}

Json finish_of(const WebPage& page) {
  const FinishSettings& finish = page.finish;
  return {{"gain", std::exp2(finish.exposure.value_or(0))},
          {"white", finish.white.value_or(1)},
          {"tone", static_cast<int>(finish.tone)},
          {"balance", balance_of(finish)},
          {"highlights", finish.highlights},
          {"saturation", finish.saturation},
          {"contrast", finish.contrast},
          {"pivot", finish.contrast_pivot},
          {"bloom", finish.bloom},
          {"gamma", page.gamma},
          {"least", least_light(finish, page.gamma)}};
}

Json splats_of(const PackedSplats& splats) {
  return {{"count", splats.count()},
          {"depths", splats.depths()},
          {"depth", {splats.least_depth, splats.most_depth}},
          {"lower", splats.lower},
          {"upper", splats.upper},
          {"sigma", {splats.least_sigma, splats.most_sigma}},
          {"light", {splats.least_light, splats.most_light}}};
}

std::vector<std::string> about(const WebPage& page, const PackedSplats& splats) {
  std::vector<std::string> facts = {
      fmt::format("{} splats of light stand for {} particles.", splats.count(), page.particles),
      fmt::format(
          "Seen from where the page begins, merging and packing them changes the light by "
          "{:.2g} of white (root mean square), {:.2g} at most, as splotchcl draws both with "
          "this page's pixels.",
          page.rms_difference, page.largest_difference),
      "Each pixel sees a Gaussian half a pixel wide. Clouds around the camera fade."};
  if (splats.depths() > 0) {
    facts.emplace_back(
        "Clouds absorb: they are drawn from the farthest to the nearest, sorted anew when one "
        "turns.");
  }
  return facts;
}

std::string_view text_of(std::string_view name) {
  const auto& files = embedded::published_page();
  return std::find_if(files.begin(), files.end(),
                      [&](const auto& file) { return file.name == name; })
      ->text;
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '<':
        safe += "&lt;";
        break;
      case '&':
        safe += "&amp;";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

// Inside a script no text may end it.
std::string inside_script(const Json& json) {
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

// Splats as particles of a component, whose column is a factor over h.
class SplatComponent {
 public:
  explicit SplatComponent(const Frame& frame)
      : origin_(look_at_point(frame.camera)), width_(static_cast<float>(frame.kernel.width)) {}

  // `column` goes through its center.
  void add(const LightSplat& splat, float column, const std::array<float, 3>& color) {
    position_.insert(position_.end(), splat.place.begin(), splat.place.end());
    color_.insert(color_.end(), color.begin(), color.end());
    h_.push_back(splat.sigma / width_);
    weight_.push_back(column * h_.back());
  }
  DrawnComponent component() {
    DrawnComponent component;
    component.name = "splats";
    component.particles.count = h_.size();
    component.particles.origin = origin_;
    component.particles.position = Column::owning(std::move(position_));
    component.particles.smoothing_length = Column::owning(std::move(h_));
    component.particles.color_vector = Column::owning(std::move(color_));
    component.weight = WeightModel::constant;
    component.particles.weight = Column::owning(std::move(weight_));
    component.palette = {"white", {{1, 1, 1}}, {}};
    return component;
  }

 private:
  Vec3 origin_;
  float width_;
  std::vector<float> position_, h_, color_, weight_;
};

// In the places of the page's own text: what is put there may hold anything.
std::string put(std::string_view page,
                const std::vector<std::pair<std::string_view, std::string>>& texts) {
  std::string made;
  for (std::size_t at = 0; at < page.size();) {
    const auto found = std::find_if(texts.begin(), texts.end(), [&](const auto& text) {
      return page.substr(at, text.first.size()) == text.first;
    });
    made += found == texts.end() ? std::string(1, page[at]) : found->second;
    at += found == texts.end() ? 1 : found->first.size();
  }
  return made;
}

}  // namespace

void check_page(const Frame& frame) {
  if (frame.projection != Projection::perspective && frame.projection != Projection::orthographic) {
    throw UsageError(
        "publish: found a projection of wide angles, expected camera.projection perspective or "
        "orthographic");
  }
  if (frame.lens.aperture > 0 || frame.fade.is_set()) {
    throw UsageError(
        "publish: found a lens, or light that fades with depth, expected neither: pages have none "
        "(camera.aperture, camera.near_fade and camera.far_fade)");
  }
  const bool is_by_depth = frame.sort.by == SortOrder::By::depth && !frame.sort.descending;
  if (is_ordered(frame) && !is_by_depth) {
    throw UsageError(
        "publish: found matter that is sorted by a field, expected by its depth (leave sort.by "
        "out)");
  }
}

void check_splat_file(const Frame& frame) {
  check_page(frame);
  if (is_ordered(frame)) {
    throw UsageError(
        "publish: found matter whose order along the view counts, expected for files of splats "
        "light that adds up: no absorption, or the same in all components as what they emit "
        "(component.NAME.absorption = \"none\"); pages show such matter (--output NAME.html)");
  }
}

Frame as_on_page(const Frame& frame) {
  Frame shown = frame;
  // A pixel's own area has a variance of a twelfth.
  shown.kernel.footprint_pixels =
      std::max(frame.kernel.footprint_pixels,
               std::sqrt(page_footprint_pixels * page_footprint_pixels - 1.0 / 12));
  shown.kernel.min_radius_pixels = 0;
  shown.kernel.cut.reset();
  shown.kernel.sampling = Sampling::mean;
  shown.crop = {0, 0, frame.width, frame.height};
  return shown;
}

Frame as_on_page(const Frame& frame, const std::vector<LightSplat>& splats) {
  Frame shown = as_on_page(frame);
  SplatComponent made(frame);
  for (const LightSplat& splat : splats)
    made.add(splat, 1, splat.light);
  DrawnComponent component = made.component();
  const double source = source_of(frame);
  component.absorption = source > 0 ? Absorption{Absorption::Kind::factor, 1 / source}
                                    : Absorption{Absorption::Kind::none, 0};
  shown.components = {component};
  return shown;
}

Frame as_on_page(const Frame& frame, const std::vector<LightSplat>& splats, std::size_t channel) {
  // Less is nothing, and light over it would be more than a float holds.
  constexpr float least_depth = 1e-20F;
  Frame shown = as_on_page(frame);
  SplatComponent clear(frame), absorbing(frame);
  for (const LightSplat& splat : splats) {
    const float light = splat.light[channel], depth = splat.depth[channel];
    const float source = light / depth;
    if (depth > least_depth) {
      absorbing.add(splat, depth, {source, source, source});
    } else {
      clear.add(splat, 1, {light, light, light});
    }
  }
  shown.components = {clear.component(), absorbing.component()};
  shown.components[0].absorption = {Absorption::Kind::none, 0};
  // As much for all as there is of it.
  shown.components[1].absorption = {Absorption::Kind::factor, 1};
  shown.components[1].palette.absorption = {{1, 1, 1}};
  return shown;
}

namespace {

// Of words and what they lie on, as style sheets have them: the scene's color of texts, and what
// that is read on.
struct PageColors {
  std::string ink, ground, scheme;
};

// On black or white, whichever has more contrast to it (WCAG 2).
PageColors colors_of(const DisplayColor& text) {
  const auto& [red, green, blue] = text;
  const auto light = [](double display) { return std::pow(display, 2.2); };
  const double luminance = 0.2126 * light(red) + 0.7152 * light(green) + 0.0722 * light(blue);
  const bool is_light = luminance > 0.179;
  const std::string ink = fmt::format("{:.0f} {:.0f} {:.0f}", 255 * red, 255 * green, 255 * blue);
  return {ink, is_light ? "0 0 0" : "255 255 255", is_light ? "dark" : "light"};
}

}  // namespace

std::string make_web_page(const WebPage& page, const Frame& frame, const PackedSplats& splats) {
  const Json settings = {{"title", page.title},         {"unit", page.unit},
                         {"camera", camera_of(frame)},  {"background", frame.background},
                         {"source", source_of(frame)},  {"footprint", page_footprint_pixels},
                         {"finish", finish_of(page)},   {"splats", splats_of(splats)},
                         {"about", about(page, splats)}};
  const auto file = [](std::string_view name) { return std::string(text_of(name)); };
  const PageColors colors = colors_of(page.finish.text_color);
  return put(text_of("index.html"), {{"{{title}}", escaped(page.title)},
                                     {"{{ink}}", colors.ink},
                                     {"{{ground}}", colors.ground},
                                     {"{{scheme}}", colors.scheme},
                                     {"{{style}}", file("style.css")},
                                     {"{{settings}}", inside_script(settings)},
                                     {"{{camera}}", file("camera.js")},
                                     {"{{order}}", file("order.js")},
                                     {"{{picture}}", file("picture.js")},
                                     {"{{page}}", file("page.js")},
                                     {"{{splats}}", as_text(splats)}});
}

}  // namespace splotchcl
