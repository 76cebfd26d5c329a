#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace splotchcl {

// Compiled programs kept from run to run, one file each. Drivers that cache by source still
// read all of it every time: PoCL takes 35 ms a program, and 2 ms for a stored binary.
// Nothing here can fail a frame: a file that cannot be used is as good as none, one with a
// single changed byte included. What others could have put there is not run.
class BinaryCache {
 public:
  // Without a folder nothing is found and nothing kept; nor in one that belongs to another user
  // or that others may write to.
  explicit BinaryCache(std::optional<std::filesystem::path> folder);
  bool is_used() const { return folder_.has_value(); }
  // Why the folder is not used; empty: it is, or there is none.
  const std::string& note() const { return note_; }

  // $SPLOTCHCL_CACHE, nothing where it is empty; else $XDG_CACHE_HOME/splotchcl or
  // ~/.cache/splotchcl, where one of these variables is set.
  static std::optional<std::filesystem::path> user_folder();

  // `key` is all that the binary depends on. It is kept with the binary and compared in full,
  // so that two keys of the same hash do no harm.
  std::optional<std::string> find(const std::string& key) const;
  // Readers of the same folder see the whole file or none.
  void keep(const std::string& key, const std::string& binary) const;

 private:
  static std::string distrust(const std::filesystem::path& folder);
  std::filesystem::path file_for(const std::string& key) const;

  std::optional<std::filesystem::path> folder_;
  std::string note_;
};

}  // namespace splotchcl
