#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "scene_file/check.h"
#include "scene_file/keys.h"
#include "scene_file/setting.h"
#include "splotchcl/scene.h"

namespace splotchcl::scene_file {

// A scene that takes values from a file and then from settings, and remembers where each
// came from. Everything throws UsageError.
class SceneBuilder {
 public:
  SceneBuilder(Scene scene, const std::string& name_for_messages);

  Scene& scene() { return scene_; }
  // What is as in the suggested scene was given by nobody (suggested.h).
  void read_text(const std::string& text, const Scene* suggested = nullptr);
  void apply_settings(const std::vector<std::string>& settings, const Scene* suggested = nullptr);
  Scene finish() const;  // checks the scene as a whole

 private:
  // A value that is being read. The text stands for it where it is of the wrong type.
  struct Value {
    const toml::node& node;
    std::string where;
    const std::string* bare_text = nullptr;
  };
  struct Assignment {
    const Key* key;
    KeyAddress address;
  };

  void apply_setting(const std::string& setting);
  void assign(const KeyAddress& address, const Value& value);
  void assign_key(const Key& key, const KeyAddress& address, const Value& value);
  bool is_assigned(const std::string& label) const;
  void assign_table(const KeyAddress& address, const Value& value);
  void assign_components(const Value& value);
  void need_camera(const KeyAddress& address, const std::string& where);
  void need_stereo(const KeyAddress& address);
  void refuse_exclusions() const;
  void make_way(const Scene& before, const Scene* suggested);
  void center_camera();
  std::string where_in_file(const toml::source_region& region) const;

  Scene scene_;
  Origins origins_;
  bool camera_is_new_ = false;
  bool is_reading_file_ = false;
  std::vector<Assignment> assigned_;  // by the file, or by the settings
};

}  // namespace splotchcl::scene_file
