#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl {

// The words of a line of a path file, between blanks or commas and up to a comment.
std::vector<std::string> path_words(std::string line);

// Whether a line names the columns.
bool is_path_header(const std::vector<std::string>& words);

// The columns of files that do not name them; the last may be missing.
const std::vector<std::string>& path_columns_without_header();

// The numbers of the first frame by the names of their columns, as far as the text has any.
std::map<std::string, double> first_path_row(const std::string& text);

// A column of a path file, and the key of the scene that it sets in each frame.
struct PathColumn {
  std::string name;                 // as the file has it: "camera_x", "camera.position.x"
  std::string key;                  // "camera.position", "component.gas.brightness"
  std::string path;                 // the same as the list of keys has it, of any component
  std::string label;                // the same with the component's number, as messages have it
  std::optional<std::size_t> axis;  // of a key with three values
  // The original program's ranges are after scaling, a scene's before.
  std::optional<Scaling> undo;
  double factor = 1;  // from the original program's value to the scene's
};

// Whether a key, by its path in the list of keys, may have another value in each frame.
bool may_change_in_film(const std::string& path);
// Throws UsageError, beginning with `where`, for one that may not. `name` is the key as it was
// found.
void check_may_change(const std::string& path, const std::string& name, const std::string& where);

// Finds a column by the name of a key ("camera.field_of_view"), of a value of a vector
// ("camera.position.x" or ".0") or by the original program's name ("camera_x", "fov",
// "brightness0"). Throws UsageError beginning with `where`.
PathColumn find_path_column(const std::string& name, const Scene& scene, const std::string& where);

// A text file with a row of values for each frame of a film.
class PathTable {
 public:
  // Without a line that names them, 9 or 10 columns are camera, look-at, sky, and the index in
  // the sequence of snapshots. Throws UsageError, DataError when the file cannot be read.
  PathTable(const std::filesystem::path& path, const Scene& scene);

  const std::vector<PathColumn>& columns() const { return columns_; }
  int row_count() const { return static_cast<int>(rows_.size()); }
  // "key=value" for each key.
  std::vector<std::string> settings(int row) const;
  // "path.txt:14", and with the key's columns where it has some: "path.txt:14: columns 4 to 6
  // (lookat_x, lookat_y, lookat_z)".
  std::string where(int row, const std::string& label = "") const;

  bool sets(const std::string& key) const;
  // Leaves out the columns of a key.
  void drop(const std::string& key);
  // Whether a key has the same value in all rows. It has one, at least.
  bool is_constant(const std::string& key) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> values;  // as TOML, for whole keys
  };

  void read_text(const std::string& text, const Scene& scene);
  void read_header(const std::vector<std::string>& words, int line, const Scene& scene);
  void check_columns(int line) const;
  Row read_row(const std::vector<std::string>& words, int line) const;
  std::string at_line(int line) const;

  std::filesystem::path path_;
  std::vector<PathColumn> columns_;
  std::vector<Row> rows_;
};

}  // namespace splotchcl
