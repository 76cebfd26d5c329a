#include "publish/web_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "finish/tone.h"
#include "scene/plan/light_structure.h"
#include "splotchcl/error.h"
#include "splotchcl_embedded/published_page.h"

namespace splotchcl {
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
          {"gamma", page.gamma}};
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

std::string make_web_page(const WebPage& page, const Frame& frame, const PackedSplats& splats) {
  const Json settings = {{"title", page.title},         {"unit", page.unit},
                         {"camera", camera_of(frame)},  {"background", frame.background},
                         {"source", source_of(frame)},  {"footprint", page_footprint_pixels},
                         {"finish", finish_of(page)},   {"splats", splats_of(splats)},
                         {"about", about(page, splats)}};
  const auto file = [](std::string_view name) { return std::string(text_of(name)); };
  return put(text_of("index.html"), {{"{{title}}", escaped(page.title)},
                                     {"{{style}}", file("style.css")},
                                     {"{{settings}}", inside_script(settings)},
                                     {"{{camera}}", file("camera.js")},
                                     {"{{order}}", file("order.js")},
                                     {"{{picture}}", file("picture.js")},
                                     {"{{page}}", file("page.js")},
                                     {"{{splats}}", as_text(splats)}});
}

}  // namespace splotchcl
