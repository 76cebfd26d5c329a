#include "film/path/view_line.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>

#include "scene_file/setting.h"
#include "scene_file/values.h"

namespace splotchcl {
namespace {

const std::string start = "camera.";

bool is_of(const std::string& setting, const std::string& key) {
  return setting.rfind(start + key + "=", 0) == 0;
}

}  // namespace

std::string camera_setting(const std::string& key, const Vec3& value) {
  return start + key + "=" + scene_file::vector().write(value);
}

std::optional<Vec3> camera_value(const std::vector<std::string>& settings, const std::string& key) {
  const auto found = std::find_if(settings.rbegin(), settings.rend(),
                                  [&key](const std::string& s) { return is_of(s, key); });
  if (found == settings.rend()) return std::nullopt;
  const std::string value = found->substr(found->find('=') + 1);
  return scene_file::vector().read(*scene_file::parse_value(value).get("value"));
}

ViewLine::ViewLine(const Camera& camera, const std::vector<std::string>& settings)
    : ViewLine(camera) {
  position = camera_value(settings, "position").value_or(position);
  look_at = camera_value(settings, "look_at").value_or(look_at);
  sky = camera_value(settings, "sky").value_or(sky);
}

void ViewLine::put_into(std::vector<std::string>& settings) const {
  for (const char* const key : {"position", "look_at", "sky"}) {
    settings.erase(std::remove_if(settings.begin(), settings.end(),
                                  [key](const std::string& s) { return is_of(s, key); }),
                   settings.end());
  }
  settings.push_back(camera_setting("position", position));
  settings.push_back(camera_setting("look_at", look_at));
  settings.push_back(camera_setting("sky", sky));
}

using namespace boost::qvm;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(mag(cross(a, b)), dot(a, b));
}

double largest_turn(const std::vector<Vec3>& directions) {
  double largest = 0;
  for (std::size_t i = 1; i < directions.size(); ++i)
    largest = std::max(largest, angle_between(directions[i - 1], directions[i]));
  return largest;
}

namespace {

// Of so many on both sides; beyond the ends it stays what it is there. Empty where opposite
// directions leave nothing.
std::vector<Vec3> averaged(const std::vector<Vec3>& directions, int around) {
  const int last = static_cast<int>(directions.size()) - 1;
  constexpr double hardly = 0.01;
  std::vector<Vec3> means;
  for (int i = 0; i <= last; ++i) {
    Vec3 sum = {{0, 0, 0}};
    for (int j = i - around; j <= i + around; ++j)
      sum += directions[static_cast<std::size_t>(std::clamp(j, 0, last))];
    const double length = mag(sum) / (2 * around + 1);
    if (length < hardly) return {};
    means.push_back(normalized(sum));
  }
  return means;
}

}  // namespace

std::vector<Vec3> with_slow_turns(const std::vector<Vec3>& directions, double most_radians) {
  constexpr double rounding = 1e-9;
  const int most_around = static_cast<int>(directions.size()) / 4;
  for (int around = 0; around <= most_around; around = around + 1 + around / 8) {
    std::vector<Vec3> slow = averaged(directions, around);
    if (!slow.empty() && largest_turn(slow) <= most_radians * (1 + rounding)) return slow;
  }
  return {};
}

}  // namespace splotchcl
