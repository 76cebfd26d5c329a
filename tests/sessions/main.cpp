// Each session of the folder as a test.
#include <deque>

#include "cli/program.h"
#include "sessions/session.h"
#include "testing.h"

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

// In a folder; what is not answered as it is expected, if anything is.
std::string run_all(const std::vector<Exchange>& exchanges, const TemporaryFolder& folder) {
  for (const auto& [command, expected] : exchanges) {
    ProgramResult found = run_in(folder, "PATH=\"${splotchcl%/*}:$PATH\"; " + command);
    for (std::string* const text : {&found.out, &found.err})
      if (!text->empty() && text->back() != '\n') *text += '\n';
    if (found.exit_code != expected.exit_code || !fits(found.out, expected.out) ||
        !fits(found.err, expected.err))
      return "$ " + command + "\n-- found\n" + told({found.out, found.err, found.exit_code}) +
             "-- expected\n" + told(expected);
  }
  return "";
}

// What a file's sessions begin with is made once, and each gets a copy.
struct Beginning {
  explicit Beginning(const SessionFile& file) : failure(run_all(file.setup, folder)) {}
  const TemporaryFolder folder{"setup"};
  const std::string failure;
};

const Beginning& beginning_of(const SessionFile& file) {
  static std::map<std::string, Beginning> made;
  return made.try_emplace(file.name, file).first->second;
}

class SessionTest : public ::testing::Test {
 public:
  SessionTest(const SessionFile& file, const Session& session) : file_(file), session_(session) {}

  void TestBody() override {
    for (const std::string& need : session_.needs)
      if (!is_there(need)) GTEST_SKIP() << "no " << need << " here";
    const Beginning& beginning = beginning_of(file_);
    ASSERT_TRUE(beginning.failure.empty()) << beginning.failure;
    const TemporaryFolder folder;
    ASSERT_EQ(run_in(folder, "cp -a '" + beginning.folder.path().string() + "/.' .").exit_code, 0);
    const std::string failure = run_all(session_.exchanges, folder);
    EXPECT_TRUE(failure.empty()) << failure;
  }

 private:
  const SessionFile& file_;
  const Session& session_;
};

void register_sessions(const std::filesystem::path& folder) {
  static std::deque<SessionFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".session") continue;
    const SessionFile& file = files.emplace_back(read_sessions(entry.path()));
    for (const Session& session : file.sessions) {
      const auto make = [&]() -> ::testing::Test* { return new SessionTest(file, session); };
      ::testing::RegisterTest(file.name.c_str(), session.name.c_str(), nullptr, nullptr,
                              entry.path().c_str(), 1, make);
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
