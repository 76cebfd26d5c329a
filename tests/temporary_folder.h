#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace splotchcl::test {

// A folder of its own for one test, removed at its end. Those of one test that live at the
// same time differ by `label`.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& label = "files") {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("splotchcl-") + test->test_suite_name() + "-" + test->name() +
                       "-" + label + "-" + std::to_string(::getpid());
    for (char& c : name) {
      if (c == '/') c = '-';
    }
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, error);
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  // Everything in it, hidden files too.
  std::size_t count_files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

// Tests that each have one.
class FolderTest : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
};

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace splotchcl::test
