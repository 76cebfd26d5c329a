#pragma once

#include <map>
#include <string>
#include <vector>

namespace splotchcl::par {

// A scene file that is being put together.
class SceneText {
 public:
  void set(const std::string& key, const std::string& value);  // "camera.near", TOML
  void set_text(const std::string& key, const std::string& value);
  void set_number(const std::string& key, double value);
  void set_vector(const std::string& key, double x, double y, double z);

  // Of the last component; keys without "component.".
  void begin_component();
  void set_of_component(const std::string& key, const std::string& value);

  std::string text() const;

 private:
  std::vector<std::string> lines_;
  std::vector<std::vector<std::string>> components_;
};

}  // namespace splotchcl::par
