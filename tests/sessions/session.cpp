#include "sessions/session.h"

#include <cctype>

#include "testing.h"

namespace splotchcl::test {
namespace {

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

Session named(const std::string& words) {
  std::istringstream stream(words);
  Session session;
  stream >> session.name;
  for (std::string need; stream >> need;)
    session.needs.push_back(need);
  return session;
}

// Blank lines stand between commands.
void end_without_blank_lines(std::string& text) {
  while (text.size() > 1 && text.compare(text.size() - 2, 2, "\n\n") == 0)
    text.pop_back();
  if (text == "\n") text.clear();
}

void add_line(const std::string& line, Session& session) {
  if (begins_with(line, "$ ")) {
    session.exchanges.push_back({line.substr(2), {}});
    return;
  }
  if (session.exchanges.empty()) return;
  Exchange& last = session.exchanges.back();
  if (last.command.back() == '\\') {
    last.command += "\n" + line;
  } else if (begins_with(line, "! ")) {
    last.expected.err += line.substr(2) + "\n";
  } else if (begins_with(line, "= ")) {
    last.expected.exit_code = std::stoi(line.substr(2));
  } else {
    last.expected.out += line + "\n";
  }
}

// Whether the text begins with something for which the placeholder stands, and the rest fits.
bool fits_from(const std::string& found, std::size_t at, const std::string& expected,
               std::size_t from);

bool fits_number(const std::string& found, std::size_t at, const std::string& expected,
                 std::size_t from) {
  const auto is_part = [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || std::string(".e+-").find(c) < 4;
  };
  for (std::size_t end = at; end < found.size() && is_part(found[end]); ++end)
    if (fits_from(found, end + 1, expected, from)) return true;
  return false;
}

bool fits_anything(const std::string& found, std::size_t at, const std::string& expected,
                   std::size_t from, bool of_one_line) {
  for (std::size_t end = at;; ++end) {
    const bool may_end = of_one_line || end == at || found[end - 1] == '\n';
    if (may_end && fits_from(found, end, expected, from)) return true;
    if (end == found.size() || (of_one_line && found[end] == '\n')) return false;
  }
}

bool fits_from(const std::string& found, std::size_t at, const std::string& expected,
               std::size_t from) {
  const std::string any = "<...>", number = "<number>", lines = "...\n";
  for (; from < expected.size(); ++at, ++from) {
    const auto is_next = [&](const std::string& placeholder) {
      return expected.compare(from, placeholder.size(), placeholder) == 0;
    };
    if (is_next(any)) return fits_anything(found, at, expected, from + any.size(), true);
    if (is_next(number)) return fits_number(found, at, expected, from + number.size());
    if (is_next(lines) && (from == 0 || expected[from - 1] == '\n'))
      return fits_anything(found, at, expected, from + lines.size(), false);
    if (at >= found.size() || found[at] != expected[from]) return false;
  }
  return at == found.size();
}

}  // namespace

SessionFile read_sessions(const std::filesystem::path& path) {
  std::ifstream text(path);
  SessionFile file;
  file.name = path.stem();
  std::vector<Session>& sessions = file.sessions;
  for (std::string line; std::getline(text, line);) {
    if (begins_with(line, "== ")) {
      sessions.push_back(named(line.substr(3)));
    } else if (!sessions.empty()) {
      add_line(line, sessions.back());
    }
  }
  for (Session& session : sessions) {
    if (session.exchanges.empty())
      throw std::runtime_error(path.string() + ": " + session.name + " has no commands");
    for (Exchange& exchange : session.exchanges) {
      end_without_blank_lines(exchange.expected.out);
      end_without_blank_lines(exchange.expected.err);
    }
  }
  if (sessions.empty() || sessions.front().name != "setup") return file;
  const Session setup = sessions.front();
  sessions.erase(sessions.begin());
  file.setup = setup.exchanges;
  for (Session& session : sessions)
    session.needs.insert(session.needs.end(), setup.needs.begin(), setup.needs.end());
  return file;
}

bool fits(const std::string& found, const std::string& expected) {
  return fits_from(found, 0, expected, 0);
}

}  // namespace splotchcl::test
