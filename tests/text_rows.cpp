#include "text_rows.h"

#include <fstream>
#include <map>
#include <stdexcept>

namespace splotchcl::test {
namespace {

bool begins(const std::string& line, const std::string& with) {
  return line.compare(0, with.size(), with) == 0;
}

char escaped(const std::string& text, std::size_t& at) {
  switch (text[at]) {
    case 'n':
      return '\n';
    case 't':
      return '\t';
    case 'r':
      return '\r';
    case '0':
      return '\0';
    case '\\':
      return '\\';
    case 'x':
      at += 2;
      return static_cast<char>(std::stoi(text.substr(at - 1, 2), nullptr, 16));
    default:
      throw std::runtime_error("an unknown escape in " + text);
  }
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file) {
    if (!file_) throw std::runtime_error("no " + file.string());
    for (std::string line; std::getline(file_, line);)
      take(line);
    end_row();
    if (rows_.empty()) throw std::runtime_error("no row in " + file.string());
  }
  std::vector<TextRow> rows() { return std::move(rows_); }

 private:
  void take(const std::string& line) {
    const bool is_between = row_.texts.empty() || !row_.expected.empty();
    if (begins(line, "== ")) {
      end_row();
      name_ = line.substr(3);
      count_ = 0;
    } else if (begins(line, "-> ")) {
      if (text_.empty() && row_.texts.empty()) throw std::runtime_error("no text above " + line);
      end_text();
      row_.expected.push_back(meant(line.substr(3)));
    } else if (line == "-or-") {
      end_text();
    } else if (is_between && text_.empty() && begins(line, "let ")) {
      const std::size_t equals = line.find(" = ");
      words_[line.substr(4, equals - 4)] = meant(line.substr(equals + 3));
    } else if (is_between && text_.empty() &&
               (line.empty() || begins(line, "## ") || name_.empty())) {
      return;
    } else {
      if (!row_.expected.empty()) end_row();
      text_ += line + "\n";
    }
  }

  void end_text() {
    if (text_.empty()) return;
    std::string text = std::move(text_);
    text_.clear();
    const bool is_open = text.size() > 1 && text[text.size() - 2] == '\\' &&
                         (text.size() < 3 || text[text.size() - 3] != '\\');
    if (is_open) text.resize(text.size() - 2);
    row_.texts.push_back(meant(text));
  }

  void end_row() {
    if (row_.expected.empty()) {
      if (!text_.empty() || !row_.texts.empty())
        throw std::runtime_error("nothing is expected of a text of " + name_);
      return;
    }
    row_.name = name_ + (++count_ > 1 ? "_" + std::to_string(count_) : "");
    rows_.push_back(std::move(row_));
    row_ = {};
  }

  std::string meant(const std::string& text) const {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\\') {
        result += escaped(text, ++i);
      } else if (text.compare(i, 2, "${") == 0) {
        const std::size_t end = text.find('}', i);
        result += words_.at(text.substr(i + 2, end - i - 2));
        i = end;
      } else {
        result += text[i];
      }
    }
    return result;
  }

  std::ifstream file_;
  std::string name_, text_;
  int count_ = 0;
  TextRow row_;
  std::vector<TextRow> rows_;
  std::map<std::string, std::string> words_;
};

}  // namespace

std::vector<TextRow> read_text_rows(const std::filesystem::path& file) {
  return Reader(file).rows();
}

}  // namespace splotchcl::test
