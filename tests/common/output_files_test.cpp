#include "common/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "splotchcl/error.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using Files = std::set<std::filesystem::path>;

class OutputFiles : public ::testing::Test {
 protected:
  OutputFiles() { std::ofstream(folder_ / "data") << "mine"; }
  void check(const std::string& name, const Files& inputs) const {
    check_outputs({{folder_ / name, "-o"}}, [&] { return inputs; });
  }
  test::TemporaryFolder folder_;
};

TEST_F(OutputFiles, AreNoInputs) {
  EXPECT_THROW(check("data", {folder_ / "data"}), UsageError);
  EXPECT_NO_THROW(check("other", {folder_ / "data"}));
}

TEST_F(OutputFiles, AreNoInputsByOtherNames) {
  std::filesystem::create_symlink("data", folder_ / "soft");
  std::filesystem::create_hard_link(folder_ / "data", folder_ / "hard");
  EXPECT_THROW(check("soft", {folder_ / "data"}), UsageError);
  EXPECT_THROW(check("hard", {folder_ / "soft"}), UsageError);
  EXPECT_THROW(check("data", {folder_ / "." / "data"}), UsageError);
}

TEST_F(OutputFiles, MayBeMissingInputs) {
  EXPECT_NO_THROW(check("missing", {folder_ / "missing"}));
}

TEST_F(OutputFiles, AreDifferentFiles) {
  const auto check_two = [this](const std::string& a, const std::string& b) {
    check_outputs({{folder_ / a, "-o"}, {folder_ / b, "--stats"}}, [] { return Files(); });
  };
  EXPECT_THROW(check_two("new", "./new"), UsageError);
  EXPECT_THROW(check_two("data", "data"), UsageError);
  EXPECT_NO_THROW(check_two("data", "new"));
}

TEST_F(OutputFiles, DoNotAskForInputsWhereNoneExists) {
  EXPECT_NO_THROW(check_outputs({{folder_ / "new", "-o"}}, []() -> Files { throw 1; }));
}

TEST_F(OutputFiles, OfAFolderOfTheProgramsOwnDoNotHoldInputs) {
  std::filesystem::create_directories(folder_ / "own" / "below");
  std::ofstream(folder_ / "own" / "below" / "input") << "mine";
  const auto check_folder = [this](const Files& inputs) {
    check_own_folder(folder_ / "own", "-o", [&] { return inputs; });
  };
  EXPECT_THROW(check_folder({folder_ / "own" / "below" / "input"}), UsageError);
  EXPECT_NO_THROW(check_folder({folder_ / "data"}));
}

}  // namespace
}  // namespace splotchcl
