#include "film/path/view_line.h"

#include <algorithm>
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

}  // namespace splotchcl
