#pragma once

#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace splotchcl::cli {

// The options that a command was given. They stand for keys of a scene, which its errors name; who
// typed an option looks for its name.
class TypedOptions {
 public:
  TypedOptions() = default;
  explicit TypedOptions(const CLI::App& command);
  explicit TypedOptions(std::map<std::string, std::vector<std::string>> values)
      : values_(std::move(values)) {}

  // An error's message with options in place of keys.
  std::string named_in(const std::string& message) const;

 private:
  bool has(const std::string& option) const { return values_.count(option) > 0; }
  // Whether the option was given this, alone or within more.
  bool has_value(const std::string& option, const std::string& value) const;
  bool is_quoted_in(const std::string& option, const std::string& message) const;
  bool sets(const std::string& key) const;
  std::string option_of(const std::string& key) const;
  std::string without_setting(const std::string& message) const;
  std::string with_option_first(const std::string& message) const;
  std::string with_option_within(const std::string& message) const;
  std::string with_named_place(const std::string& message) const;

  std::map<std::string, std::vector<std::string>> values_;  // by option: --width
};

}  // namespace splotchcl::cli
