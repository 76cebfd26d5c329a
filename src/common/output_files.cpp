#include "common/output_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

// What tells a file from all others, whatever its names.
using Identity = std::pair<::dev_t, ::ino_t>;

struct Found {
  bool exists = false;
  std::optional<Identity> file;  // none where it is no regular file
};

Found look_at(const fs::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return {};
  if (!S_ISREG(status.st_mode)) return {true, std::nullopt};
  return {true, Identity(status.st_dev, status.st_ino)};
}

// Of a file that does not exist yet.
fs::path place_of(const fs::path& path) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : place;
}

// The outputs that exist, by identity.
class Outputs {
 public:
  void add(const OutputFile& output) {
    const Found found = look_at(output.path);
    if (found.exists && !found.file) return;
    const OutputFile*& known =
        found.file ? existing_[*found.file] : new_[place_of(output.path).string()];
    if (known != nullptr) {
      throw UsageError(
          fmt::format("{}: found {}, which is the same file as {} of {}; write to different files",
                      output.option, output.path.string(), known->path.string(), known->option));
    }
    known = &output;
  }
  bool has_existing() const { return !existing_.empty(); }
  const OutputFile* find(const fs::path& input) const {
    const Found found = look_at(input);
    if (!found.file) return nullptr;
    const auto output = existing_.find(*found.file);
    return output == existing_.end() ? nullptr : output->second;
  }

 private:
  std::map<Identity, const OutputFile*> existing_;
  std::map<std::string, const OutputFile*> new_;
};

bool lies_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

}  // namespace

void check_outputs(const std::vector<OutputFile>& outputs,
                   const std::function<std::set<fs::path>()>& inputs) {
  Outputs written;
  for (const OutputFile& output : outputs)
    written.add(output);
  if (!written.has_existing()) return;
  for (const fs::path& input : inputs()) {
    const OutputFile* const output = written.find(input);
    if (output == nullptr) continue;
    const bool has_same_name = output->path == input;
    throw UsageError(fmt::format(
        "{}: found {}, which is {}a file that is read and would be lost; choose another "
        "name",
        output->option, output->path.string(),
        has_same_name ? "" : fmt::format("the same as {}, ", input.string())));
  }
}

void check_own_folder(const fs::path& folder, const std::string& option,
                      const std::function<std::set<fs::path>()>& inputs) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  const fs::path place = place_of(folder);
  for (const fs::path& input : inputs()) {
    if (!look_at(input).file || !lies_below(place_of(input), place)) continue;
    throw UsageError(
        fmt::format("{}: the frames lie in {} until all are there, but {} in it is read; choose "
                    "another name",
                    option, folder.string(), input.string()));
  }
}

}  // namespace splotchcl
