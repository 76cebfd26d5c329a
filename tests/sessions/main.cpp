// Each session of the folder as a test.
#include <gtest/gtest.h>

#include "cli/program.h"
#include "sessions/session.h"

namespace splotchcl::test {
namespace {

// As a session tells it.
std::string told(const Answer& answer) {
  std::string text = answer.out, line;
  std::istringstream lines(answer.err);
  while (std::getline(lines, line))
    text += "! " + line + "\n";
  if (answer.exit_code != 0) text += "= " + std::to_string(answer.exit_code) + "\n";
  return text;
}

bool is_there(const std::string& need) {
  if (need == "device") return has_device();
  if (need == "data") return has_test_data();
  return std::system(("command -v " + need + " > /dev/null").c_str()) == 0;
}

class SessionTest : public ::testing::Test {
 public:
  explicit SessionTest(Session session) : session_(std::move(session)) {}

  void TestBody() override {
    for (const std::string& need : session_.needs)
      if (!is_there(need)) GTEST_SKIP() << "no " << need << " here";
    const TemporaryFolder folder;
    for (const Exchange& exchange : session_.exchanges) {
      ProgramResult found = run_in(folder, "PATH=\"${splotchcl%/*}:$PATH\"; " + exchange.command);
      for (std::string* const text : {&found.out, &found.err})
        if (!text->empty() && text->back() != '\n') *text += '\n';
      const Answer& expected = exchange.expected;
      ASSERT_TRUE(found.exit_code == expected.exit_code && fits(found.out, expected.out) &&
                  fits(found.err, expected.err))
          << "$ " << exchange.command << "\n-- found\n"
          << told({found.out, found.err, found.exit_code}) << "-- expected\n"
          << told(expected);
    }
  }

 private:
  Session session_;
};

void register_sessions(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".session") continue;
    for (const Session& session : read_sessions(entry.path())) {
      ::testing::RegisterTest(entry.path().stem().c_str(), session.name.c_str(), nullptr, nullptr,
                              entry.path().c_str(), 1,
                              [session]() -> ::testing::Test* { return new SessionTest(session); });
    }
  }
}

TEST(Sessions, ExpectEveryLineAsItIs) {
  EXPECT_TRUE(fits("a\nb\n", "a\nb\n"));
  for (const char* const other : {"", "a\n", "a\nb", "a\nc\n", "a\nb\nc\n", "a\nb \n"})
    EXPECT_FALSE(fits(other, "a\nb\n")) << other;
}

TEST(Sessions, LeaveWhatPlaceholdersStandFor) {
  EXPECT_TRUE(fits("took 1.5e-3 s\n", "took <number> s\n"));
  EXPECT_FALSE(fits("took long s\n", "took <number> s\n"));
  EXPECT_TRUE(fits("a: b, c\n", "a<...>c\n"));
  EXPECT_FALSE(fits("a\nc\n", "a<...>c\n"));
  EXPECT_TRUE(fits("a\nb\nc\nd\n", "a\n...\nd\n"));
  EXPECT_TRUE(fits("", "...\n"));
  EXPECT_FALSE(fits("a\nb\nc\nad\n", "a\n...\nd\n"));
}

}  // namespace
}  // namespace splotchcl::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  splotchcl::test::register_sessions(splotchcl::test::source_folder() / "tests/sessions");
  return RUN_ALL_TESTS();
}
