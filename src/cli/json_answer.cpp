#include "cli/json_answer.h"

#include <fmt/format.h>

#include <iostream>

#include "common/words.h"

namespace splotchcl::cli {

std::string json_text(const Json& json) {
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  std::string result;
  for (const Character& character : characters_of(text)) {
    const bool is_escaped = character.bytes != "\n" && is_control(*character.code);
    if (is_escaped) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(*character.code));
    } else {
      result += character.bytes;
    }
  }
  return result + "\n";
}

void print_json(const Json& json) {
  std::cout << json_text(json);
}

}  // namespace splotchcl::cli
