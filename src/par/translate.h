#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "par/par_file.h"

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

// From the keys of the original to those of a scene, a part each. Formulas:
// docs/original-files.md.

struct Translation {
  Translation(ParFile& from, std::filesystem::path files) : par(from), folder(std::move(files)) {}

  // A file that the parameter file names, as it is found from here.
  std::filesystem::path file(const std::string& name) const;
  void note(const std::string& text) { notes.push_back(text); }

  // A number of the file, or else of its path's first frame.
  std::optional<double> number_at_start(const std::string& key);

  ParFile& par;
  std::filesystem::path folder;            // of the parameter file
  std::map<std::string, double> path_row;  // of the path's first frame, by column
  SceneText scene;
  std::vector<std::string> notes;
};

void translate_snapshot(Translation& t);
void translate_camera(Translation& t);
void translate_picture(Translation& t);
void translate_order(Translation& t);
void translate_components(Translation& t);

}  // namespace splotchcl::par
