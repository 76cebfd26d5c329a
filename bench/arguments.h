#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace splotchcl::bench {

// The few options of a benchmark: --name and --name VALUE. (CLI11 is not at hand where only
// the renderer is built.)
class Arguments {
 public:
  // Throws UsageError for anything that is not one of these. Each is "name: what it does",
  // or "name=VALUE: what it does" where a value follows.
  Arguments(int count, const char* const* words, const std::vector<std::string>& options);

  bool wants_help() const { return has("help"); }
  std::string help() const;
  bool has(const std::string& name) const { return values_.count(name) != 0; }
  std::string text(const std::string& name, const std::string& otherwise) const;
  int number(const std::string& name, int otherwise) const;

 private:
  std::vector<std::string> options_;
  std::map<std::string, std::string> values_;
};

// Runs a benchmark's main function with the exit codes of the command line: 0 done, 1 the
// data or the device failed, 2 the call is wrong.
int run_main(int count, char** words, const std::vector<std::string>& options,
             void (*benchmark)(const Arguments&));

}  // namespace splotchcl::bench
