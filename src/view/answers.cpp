#include "view/answers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "scene/projection.h"
#include "scene/scalar_map.h"
#include "scene/statistics.h"
#include "splotchcl/error.h"

namespace splotchcl::view {
namespace {

// A pointer is not put down more exactly, as a part of the picture's width.
constexpr double pointer_radius = 0.01;

struct Candidate {
  double depth = 0, light = 0;
  Vec3 position;
};

// Matter over the area of its cloud, which is what makes it bright.
double light_of(const DrawnComponent& component, std::size_t i, double size) {
  const Column& weight = component.particles.weight;
  const double matter =
      component.weight == WeightModel::mass && !weight.is_absent() ? weight[i] : 1;
  return matter * component.brightness / (component.reference_column * size * size);
}

void add_candidates(const Frame& frame, const DrawnComponent& component, double x, double y,
                    std::vector<Candidate>& candidates) {
  const Particles& particles = component.particles;
  const double pointer = pointer_radius * frame.width;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Vec3 offset = {
        {particles.position[3 * i], particles.position[3 * i + 1], particles.position[3 * i + 2]}};
    const Vec3 position = particles.origin + offset;
    const auto place = project_point(along_axes(position - frame.camera.position, frame.camera),
                                     frame.camera, frame.projection);
    if (!place) continue;
    const double size = component.size_factor * particles.smoothing_length[i];
    const double radius = pointer + frame.kernel.width * size * place->pixels_per_length;
    const double away = std::hypot(place->x - x, place->y - y) / radius;
    if (!(away < 1)) continue;
    candidates.push_back({place->depth, light_of(component, i, size) * (1 - away), position});
  }
}

}  // namespace

std::optional<Vec3> pick_particle(const Frame& frame, double x, double y) {
  std::vector<Candidate> candidates;
  for (const DrawnComponent& component : frame.components)
    add_candidates(frame, component, x, y, candidates);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.depth < b.depth; });
  double half = 0;
  for (const Candidate& candidate : candidates)
    half += 0.5 * candidate.light;
  for (const Candidate& candidate : candidates) {
    half -= candidate.light;
    if (half <= 0) return std::optional<Vec3>(std::in_place, candidate.position);
  }
  return std::nullopt;
}

namespace {

constexpr double pi = 3.14159265358979323846;

Vec3 position_of(const Particles& particles, std::size_t i) {
  const Vec3 offset = {
      {particles.position[3 * i], particles.position[3 * i + 1], particles.position[3 * i + 2]}};
  return particles.origin + offset;
}

double distance_between(const Vec3& a, const Vec3& b) {
  return std::hypot(a.a[0] - b.a[0], a.a[1] - b.a[1], a.a[2] - b.a[2]);
}

// The column through a cloud's middle (docs/scene.md).
double central_column(const DrawnComponent& component, std::size_t i, double size, double sigma) {
  const Column& weight = component.particles.weight;
  const double value = weight.is_absent() ? 1 : weight[i];
  double column = value / size;
  if (component.weight == WeightModel::mass) column = value / (pi * sigma * sigma);
  if (component.weight == WeightModel::density) column = value * sigma * std::sqrt(pi);
  return column * component.particles_per_drawn;
}

ProbedComponent probe_component(const Frame& frame, const DrawnComponent& component, double x,
                                double y) {
  // Beyond that a cloud has nothing.
  constexpr double most_sigmas = 4;
  ProbedComponent probed{component.name, 0, std::nullopt};
  double values = 0, weights = 0;
  const Particles& particles = component.particles;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const auto place =
        project_point(along_axes(position_of(particles, i) - frame.camera.position, frame.camera),
                      frame.camera, frame.projection);
    if (!place) continue;
    const double size = component.size_factor * particles.smoothing_length[i];
    const double sigma = frame.kernel.width * size;
    const double away = std::hypot(place->x - x, place->y - y) / place->pixels_per_length / sigma;
    if (!(away < most_sigmas)) continue;
    const double column = central_column(component, i, size, sigma) * std::exp(-away * away);
    probed.column += column;
    if (particles.color.is_absent() || !std::isfinite(particles.color[i])) continue;
    values += column * particles.color[i];
    weights += column;
  }
  if (weights > 0) probed.mean = values / weights;
  return probed;
}

}  // namespace

Probe probe(const Frame& frame, double x, double y) {
  Probe result;
  result.position = pick_particle(frame, x, y);
  if (result.position) result.distance = distance_between(*result.position, frame.camera.position);
  for (const DrawnComponent& component : frame.components)
    result.components.push_back(probe_component(frame, component, x, y));
  return result;
}

std::vector<double> some_places(const Frame& frame, std::size_t most) {
  std::vector<double> places;
  const std::size_t of_each = most / std::max<std::size_t>(1, frame.components.size());
  for (const DrawnComponent& component : frame.components) {
    const Particles& particles = component.particles;
    const std::size_t count = std::min(of_each, particles.count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 place = position_of(particles, k * particles.count / count);
      places.insert(places.end(), place.a, place.a + 3);
    }
  }
  return places;
}

FieldHistogram field_histogram(const Column& column, Scaling scaling, std::size_t bins) {
  FieldHistogram histogram;
  const std::vector<double> values = sample_scaled(column, scaling);
  if (values.empty()) return histogram;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  histogram.minimum = unscaled(*low, scaling);
  histogram.maximum = unscaled(*high, scaling);
  histogram.counts.resize(bins);
  const double width = *high - *low;
  for (const double value : values) {
    const double place = width > 0 ? (value - *low) / width * static_cast<double>(bins) : 0;
    ++histogram.counts[std::min(bins - 1, static_cast<std::size_t>(place))];
  }
  return histogram;
}

namespace {

using Json = nlohmann::json;

// Paths and messages need not be UTF-8.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json answer(std::uint64_t id) {
  return {{"type", "answer"}, {"id", id}};
}

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

// Where the quotation that begins at `quote` ends, behind its last quote; the text's end where it
// does not. An apostrophe is no quote: letters stand on both sides of it.
std::size_t end_of_quotation(const std::string& text, std::size_t quote) {
  for (std::size_t i = quote + 1; i < text.size(); ++i) {
    if (text[i] == text[quote] && (i + 1 == text.size() || !is_letter(text[i + 1]))) return i + 1;
  }
  return text.size();
}

std::string without_quotations(const std::string& text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size();) {
    const bool is_quote =
        (text[i] == '"' || text[i] == '\'') && (i == 0 || !is_letter(text[i - 1]));
    kept += is_quote ? "(not shown)" : std::string(1, text[i]);
    i = is_quote ? end_of_quotation(text, i) : i + 1;
  }
  return kept;
}

Json given_way_json(const GivenWay& given_way) {
  Json json = Json::object();
  if (given_way.field_of_view_degrees)
    json["camera.field_of_view"] = *given_way.field_of_view_degrees;
  if (given_way.size) json["image.size"] = *given_way.size;
  return json;
}

}  // namespace

std::string frame_message(const FrameHeader& header, const ViewPicture& picture) {
  const bool is_exact = header.stage == FrameScheduler::Stage::exact;
  const std::string json = text_of({{"frame", header.frame},
                                    {"state", header.state},
                                    {"stage", is_exact ? "exact" : "preview"},
                                    {"format", picture.is_jpeg ? "image/jpeg" : "image/png"},
                                    {"seconds", picture.seconds},
                                    {"decided", header.decided},
                                    {"given_way", given_way_json(header.given_way)},
                                    {"film", Json::parse(header.film_values)},
                                    {"notes", picture.notes}});
  std::string message;
  message.reserve(4 + json.size() + picture.file.size());
  for (int shift = 0; shift < 32; shift += 8)
    message += static_cast<char>(json.size() >> shift & 0xff);
  message += json;
  message.append(picture.file.begin(), picture.file.end());
  return message;
}

std::string text_for_page(const std::exception& error) {
  const bool is_of_a_file = dynamic_cast<const DataError*>(&error) != nullptr;
  return is_of_a_file ? without_quotations(error.what()) : error.what();
}

std::string state_error(std::uint64_t state, const std::string& text) {
  return text_of({{"type", "error"}, {"state", state}, {"text", text}});
}

std::string message_error(const std::string& text) {
  return text_of({{"type", "error"}, {"text", text}});
}

std::string histogram_answer(std::uint64_t id, const FieldHistogram& histogram) {
  Json json = answer(id);
  json["minimum"] = histogram.minimum;
  json["maximum"] = histogram.maximum;
  json["counts"] = histogram.counts;
  return text_of(json);
}

namespace {

Json probed_json(const ProbedComponent& component) {
  Json json = {{"name", component.name}, {"column", component.column}};
  if (component.mean) json["mean"] = *component.mean;
  return json;
}

const char* name_of(FilmProgress::State state) {
  switch (state) {
    case FilmProgress::State::drawing:
      return "drawing";
    case FilmProgress::State::joining:
      return "joining";
    case FilmProgress::State::complete:
      return "complete";
    case FilmProgress::State::cancelled:
      return "cancelled";
    case FilmProgress::State::failed:
      return "failed";
    case FilmProgress::State::reading:
      break;
  }
  return "reading";
}

}  // namespace

std::string pick_answer(std::uint64_t id, const Probe& probe) {
  Json json = answer(id);
  if (probe.position)
    json["position"] = {probe.position->a[0], probe.position->a[1], probe.position->a[2]};
  if (probe.distance) json["distance"] = *probe.distance;
  json["components"] = Json::array();
  for (const ProbedComponent& component : probe.components)
    json["components"].push_back(probed_json(component));
  return text_of(json);
}

std::string places_answer(std::uint64_t id, const std::vector<double>& places) {
  Json json = answer(id);
  json["places"] = places;
  return text_of(json);
}

std::string component_answer(std::uint64_t id, const std::string& description) {
  Json json = answer(id);
  json["component"] = Json::parse(description);
  return text_of(json);
}

std::string film_message(const FilmProgress& progress) {
  Json json = {
      {"type", "film"},        {"state", name_of(progress.state)}, {"path", progress.path.string()},
      {"done", progress.done}, {"frames", progress.frames},        {"number", progress.number},
      {"text", progress.text}};
  if (progress.seconds_left) json["seconds_left"] = *progress.seconds_left;
  return text_of(json);
}

std::string settings_answer(std::uint64_t id, const std::string& settings) {
  Json json = answer(id);
  json["settings"] = Json::parse(settings);
  return text_of(json);
}

std::string scene_text_answer(std::uint64_t id, const std::string& opened, const std::string& now) {
  Json json = answer(id);
  json["opened"] = opened;
  json["now"] = now;
  return text_of(json);
}

std::string save_answer(std::uint64_t id, SaveResult result, const std::string& path) {
  Json json = answer(id);
  json["saved"] = result == SaveResult::saved;
  json["path"] = path;
  return text_of(json);
}

std::string question_error(std::uint64_t id, const std::string& text) {
  Json json = answer(id);
  json["error"] = text;
  return text_of(json);
}

}  // namespace splotchcl::view
