#pragma once

#include <sys/wait.h>

#include "testing.h"

namespace splotchcl::test {

struct ProgramResult {
  int exit_code = -1;  // 128 and more: ended by a signal
  std::string out, err;
};

// Runs a shell command in `folder`, in which $splotchcl is the program.
inline ProgramResult run_in(const TemporaryFolder& folder, const std::string& command) {
  const TemporaryFolder captured("output");
  const std::string script = "export splotchcl='" + test::program_path().string() + "' data='" +
                             test::data_folder().string() + "'; cd '" + folder.path().string() +
                             "' || exit 99; (" + command + ") > '" + (captured / "out").string() +
                             "' 2> '" + (captured / "err").string() + "' < /dev/null";
  const int status = std::system(script.c_str());
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_text(captured / "out");
  result.err = read_text(captured / "err");
  return result;
}

// Runs the program with these arguments, which the shell splits.
inline ProgramResult splotchcl_in(const TemporaryFolder& folder, const std::string& arguments) {
  return run_in(folder, "\"$splotchcl\" " + arguments);
}

// A folder in which this was run, once for all tests: to be copied.
inline const TemporaryFolder& folder_after(const std::string& command) {
  static std::map<std::string, TemporaryFolder> folders;
  const auto [place, is_new] =
      folders.try_emplace(command, "made" + std::to_string(folders.size()));
  if (is_new) {
    const ProgramResult made = run_in(place->second, command);
    EXPECT_EQ(made.exit_code, 0) << made.err;
  }
  return place->second;
}
inline void copy_into(const TemporaryFolder& folder, const TemporaryFolder& made) {
  EXPECT_EQ(run_in(folder, "cp -a '" + made.path().string() + "/.' .").exit_code, 0);
}

// What the program makes with these arguments.
inline std::filesystem::path made_once(const std::string& arguments) {
  return folder_after("\"$splotchcl\" " + arguments + " -o made") / "made";
}

inline bool is_one_line(const std::string& text) {
  return !text.empty() && text.find('\n') == text.size() - 1;
}

inline bool has_test_data() {
  return std::filesystem::exists(test::data_folder());
}

inline bool has_device() {
  static const bool found =
      std::system(("'" + test::program_path().string() + "' devices > /dev/null 2>&1").c_str()) ==
      0;
  return found;
}

}  // namespace splotchcl::test

#define SKIP_WITHOUT_TEST_DATA()                                            \
  if (!::splotchcl::test::has_test_data()) {                                \
    GTEST_SKIP() << "no snapshots in " << ::splotchcl::test::data_folder(); \
  }                                                                         \
  static_assert(true)

#define SKIP_WITHOUT_DEVICE()                                                         \
  if (!::splotchcl::test::has_device()) {                                             \
    GTEST_SKIP() << "no OpenCL device here; splotchcl devices tells what to install"; \
  }                                                                                   \
  static_assert(true)
