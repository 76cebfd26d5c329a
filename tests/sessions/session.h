#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Texts of commands and of what the program answers, each a test. In a folder of its own each line
// that begins with "$ " is run by a shell (a "\" at its end goes on in the next line). Below it
// stand the lines that it writes, those of standard error behind "! ", and, unless it is 0, its
// exit code behind "= ". "<...>" stands for anything in a line, "<number>" for a number, and a line
// "..." for any lines. "== Name" begins a test, "== setup" what comes before each of the file's;
// words behind it say what it needs. What stands before the first command is a remark.
namespace splotchcl::test {

struct Answer {
  std::string out, err;
  int exit_code = 0;
};

struct Exchange {
  std::string command;
  Answer expected;
};

struct Session {
  std::string name;
  std::vector<std::string> needs;  // "device", "data", or a program
  std::vector<Exchange> exchanges;
};

// The sessions of a file and what comes before each, of which they need the same.
struct SessionFile {
  std::string name;
  std::vector<Exchange> setup;
  std::vector<Session> sessions;
};
SessionFile read_sessions(const std::filesystem::path& file);

bool fits(const std::string& found, const std::string& expected);

}  // namespace splotchcl::test
