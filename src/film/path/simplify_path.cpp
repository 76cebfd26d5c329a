#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>

#include "film/path/film_path.h"
#include "film/path/keyframe_tracks.h"
#include "film/path/view_line.h"
#include "scene_file/setting.h"

namespace splotchcl {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

using Values = std::map<std::string, std::string>;

// What tracks say at a frame, by key.
Values values_at(const KeyframeTracks& tracks, double frame) {
  Values values;
  for (const std::string& setting : tracks.settings(frame)) {
    const std::size_t mark = setting.find('=');
    values[setting.substr(0, mark)] = setting.substr(mark + 1);
  }
  return values;
}

// A number, or the numbers of an array; none of words.
std::vector<double> numbers_in(const std::string& text) {
  const toml::table table = scene_file::parse_value(text);
  const toml::node& node = *table.get("value");
  std::vector<double> numbers;
  const auto add = [&numbers](const toml::node& element) {
    const std::optional<double> number = element.value<double>();
    if (number && !element.is_boolean()) numbers.push_back(*number);
  };
  add(node);
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array)
      add(element);
  }
  return numbers;
}

// How far apart the numbers of a key are, all along the path.
double reach_of(const std::string& key, const std::vector<Keyframe>& keyframes) {
  std::vector<double> least, most;
  for (const Keyframe& keyframe : keyframes) {
    const auto value = keyframe.values.find(key);
    if (value == keyframe.values.end()) continue;
    const std::vector<double> numbers = numbers_in(value->second);
    if (least.empty()) least = most = numbers;
    for (std::size_t i = 0; i < std::min(numbers.size(), least.size()); ++i) {
      least[i] = std::min(least[i], numbers[i]);
      most[i] = std::max(most[i], numbers[i]);
    }
  }
  double reach = 0;
  for (std::size_t i = 0; i < least.size(); ++i)
    reach = std::max(reach, most[i] - least[i]);
  return reach;
}

class Simplifier {
 public:
  explicit Simplifier(const Scene& scene)
      : scene_(scene), all_(scene.path.keyframes), kept_(all_.size(), false) {
    for (std::size_t i = 0; i < all_.size(); ++i)
      kept_[i] = i == 0 || i + 1 == all_.size() || all_[i].is_eased || all_[i].dwell > 0;
    for (const Keyframe& keyframe : all_) {
      for (const auto& [key, value] : keyframe.values) {
        if (reaches_.count(key) == 0) reaches_[key] = reach_of(key, all_);
      }
    }
  }

  // Adds, between each two that are kept, the keyframe that is missed most, until none is missed.
  std::vector<Keyframe> simplified() {
    while (add_worst()) {
    }
    return kept();
  }

 private:
  std::vector<Keyframe> kept() const {
    std::vector<Keyframe> keyframes;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (kept_[i]) keyframes.push_back(all_[i]);
    }
    return keyframes;
  }

  bool add_worst() {
    scene_.path.keyframes = kept();
    const KeyframeTracks tracks(scene_);
    std::vector<std::size_t> added;
    double worst = *scene_.path.simplified_within;
    std::optional<std::size_t> worst_one;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (kept_[i]) {
        if (worst_one) added.push_back(*worst_one);
        worst_one.reset();
        worst = *scene_.path.simplified_within;
        continue;
      }
      const double error = error_of(all_[i], values_at(tracks, all_[i].frame));
      if (!(error > worst)) continue;
      worst = error;
      worst_one = i;
    }
    for (const std::size_t i : added)
      kept_[i] = true;
    return !added.empty();
  }

  double error_of(const Keyframe& keyframe, const Values& found) const {
    double error = 0;
    for (const auto& [key, value] : keyframe.values) {
      const auto at = found.find(key);
      if (at == found.end()) return infinite;
      error = std::max(error, error_of_key(key, keyframe, at->second));
    }
    return error;
  }

  double error_of_key(const std::string& key, const Keyframe& keyframe,
                      const std::string& found) const {
    const std::string& wanted = keyframe.values.at(key);
    const std::vector<double> a = numbers_in(wanted), b = numbers_in(found);
    if (a.empty() || a.size() != b.size()) return wanted == found ? 0 : infinite;
    if (key == "camera.sky") return angle_between(direction_of(a), direction_of(b));
    double distance2 = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      distance2 += (a[i] - b[i]) * (a[i] - b[i]);
    if (distance2 == 0) return 0;
    const bool is_of_view = key == "camera.position" || key == "camera.look_at";
    return std::sqrt(distance2) / (is_of_view ? distance_of(keyframe) : reaches_.at(key));
  }

  static Vec3 direction_of(const std::vector<double>& numbers) {
    return boost::qvm::normalized(Vec3{{numbers.at(0), numbers.at(1), numbers.at(2)}});
  }

  // From the camera to its look-at point; infinite where another keyframe would have to say one.
  double distance_of(const Keyframe& keyframe) const {
    std::vector<std::string> settings;
    for (const auto& [key, value] : keyframe.values)
      settings.push_back(key + "=" + value);
    const ViewLine line(scene_.camera.value_or(Camera()), settings);
    return boost::qvm::mag(line.look_at - line.position);
  }

  Scene scene_;
  const std::vector<Keyframe> all_;
  std::vector<bool> kept_;
  std::map<std::string, double> reaches_;
};

}  // namespace

Scene with_simple_path(Scene scene, std::vector<std::string>& notes) {
  if (!scene.path.simplified_within) return scene;
  const std::size_t all = scene.path.keyframes.size();
  if (all > 2) scene.path.keyframes = Simplifier(scene).simplified();
  scene.path.simplified_within.reset();
  notes.push_back(
      fmt::format("path.simplify: {} of {} keyframes stay", scene.path.keyframes.size(), all));
  return scene;
}

}  // namespace splotchcl
