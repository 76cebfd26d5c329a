#include "view/answers.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "scene/scalar_map.h"
#include "scene/statistics.h"
#include "splotchcl/error.h"

namespace splotchcl::view {

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
