#include "par/scene_text.h"

#include <fmt/format.h>

#include "scene_file/values.h"

namespace splotchcl::par {

using scene_file::write_number;
using scene_file::write_text;

void SceneText::set(const std::string& key, const std::string& value) {
  lines_.push_back(fmt::format("{} = {}", key, value));
}

void SceneText::set_text(const std::string& key, const std::string& value) {
  set(key, write_text(value));
}

void SceneText::set_number(const std::string& key, double value) {
  set(key, write_number(value));
}

void SceneText::set_vector(const std::string& key, double x, double y, double z) {
  set(key, fmt::format("[{}, {}, {}]", write_number(x), write_number(y), write_number(z)));
}

void SceneText::begin_component() {
  components_.emplace_back();
}

void SceneText::set_of_component(const std::string& key, const std::string& value) {
  components_.back().push_back(fmt::format("{} = {}", key, value));
}

std::string SceneText::text() const {
  std::string text = fmt::format("{}\n", fmt::join(lines_, "\n"));
  for (const auto& lines : components_)
    text += fmt::format("[[component]]\n{}\n", fmt::join(lines, "\n"));
  return text;
}

}  // namespace splotchcl::par
