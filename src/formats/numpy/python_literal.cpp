#include "formats/numpy/python_literal.h"

#include <charconv>

namespace splotchcl {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  std::optional<PythonLiteral> parse_all() {
    auto literal = parse(0);
    skip_blanks();
    return literal && rest_.empty() ? std::move(literal) : std::nullopt;
  }

 private:
  static constexpr int deepest = 16;

  void skip_blanks() {
    const std::size_t first = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
  }
  bool take(char c) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool take_word(std::string_view word) {
    if (rest_.substr(0, word.size()) != word) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  std::optional<PythonLiteral> parse(int depth) {
    if (depth > deepest) return std::nullopt;
    if (take('{')) return parse_dictionary(depth);
    if (take('(')) return parse_sequence(')', depth);
    if (take('[')) return parse_sequence(']', depth);
    if (take('\'')) return parse_text('\'');
    if (take('"')) return parse_text('"');
    PythonLiteral literal;
    literal.kind = PythonLiteral::Kind::boolean;
    literal.is_true = take_word("True");
    if (literal.is_true || take_word("False")) return literal;
    return parse_integer();
  }

  std::optional<PythonLiteral> parse_text(char quote) {
    const std::size_t end = rest_.find(quote);
    if (end == std::string_view::npos) return std::nullopt;
    PythonLiteral literal;
    literal.text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return literal;
  }

  std::optional<PythonLiteral> parse_integer() {
    PythonLiteral literal;
    literal.kind = PythonLiteral::Kind::integer;
    const auto [end, error] =
        std::from_chars(rest_.data(), rest_.data() + rest_.size(), literal.integer);
    if (error != std::errc()) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    if (!rest_.empty() && rest_.front() == 'L') rest_.remove_prefix(1);  // of Python 2
    return literal;
  }

  std::optional<PythonLiteral> parse_sequence(char close, int depth) {
    PythonLiteral sequence;
    sequence.kind = PythonLiteral::Kind::sequence;
    while (!take(close)) {
      auto item = parse(depth + 1);
      if (!item) return std::nullopt;
      sequence.items.push_back(std::move(*item));
      if (take(',')) continue;
      if (!take(close)) return std::nullopt;
      break;
    }
    return sequence;
  }

  std::optional<PythonLiteral> parse_dictionary(int depth) {
    PythonLiteral dictionary;
    dictionary.kind = PythonLiteral::Kind::dictionary;
    while (!take('}')) {
      auto key = parse(depth + 1);
      if (!key || key->kind != PythonLiteral::Kind::text || !take(':')) return std::nullopt;
      auto value = parse(depth + 1);
      if (!value) return std::nullopt;
      dictionary.entries.emplace_back(std::move(key->text), std::move(*value));
      if (take(',')) continue;
      if (!take('}')) return std::nullopt;
      break;
    }
    return dictionary;
  }

  std::string_view rest_;
};

}  // namespace

const PythonLiteral* PythonLiteral::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

std::optional<PythonLiteral> parse_python_literal(std::string_view text) {
  return Parser(text).parse_all();
}

}  // namespace splotchcl
