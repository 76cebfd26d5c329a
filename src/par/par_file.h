#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace splotchcl::par {

// The lines key=value of a parameter file. Every value that is asked for is remembered, so
// that what nobody asked for can be named. Everything throws UsageError with file and line.
class ParFile {
 public:
  ParFile(const std::string& text, std::string name_for_messages);

  bool has(const std::string& key) const { return entries_.count(key) > 0; }
  // Nothing when the key is not there or has no value.
  std::optional<std::string> text(const std::string& key);
  std::optional<double> number(const std::string& key);
  std::optional<int> integer(const std::string& key, int lowest, int highest);
  std::optional<bool> boolean(const std::string& key);

  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;

  std::vector<std::string> unused() const;  // in the order of the file
  const std::vector<std::string>& notes() const { return notes_; }
  const std::string& name() const { return name_; }

 private:
  struct Entry {
    std::string value;
    int line = 0;
  };
  void add(const std::string& line, int number);

  std::string name_;
  std::map<std::string, Entry> entries_;
  std::set<std::string> used_;
  std::vector<std::string> notes_;
};

// A key of the original that is not carried over into a scene. N stands for the component.
struct UntranslatedKey {
  const char* name;
  const char* reason;  // completes "KEY REASON"
  bool is_harmless;    // the picture is the same without it
};

// All that are known; docs/original-files.md has them too.
const std::vector<UntranslatedKey>& untranslated_keys();

// All that are carried over, for the nearest name of a mistyped one.
const std::vector<std::string>& translated_keys();

// "color_min1" -> "color_minN", others as they are.
std::string general_name(const std::string& key);

// What the user should know of keys that no scene key took.
std::vector<std::string> explain_untranslated(const std::vector<std::string>& keys);

}  // namespace splotchcl::par
