#pragma once

#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/words.h"

// Answers of commands for programs rather than people (--json).
namespace splotchcl::cli {

using Json = nlohmann::ordered_json;

// Names in files need not be UTF-8, which JSON is: bytes that are none are replaced. Characters
// that a terminal would obey are escaped.
inline std::string json_text(const Json& json) {
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

inline void print_json(const Json& json) {
  std::cout << json_text(json);
}

// A list of what `to_json` makes of each item.
template <typename Item, typename ToJson>
void print_json_list(const std::vector<Item>& items, ToJson to_json) {
  Json list = Json::array();
  for (const Item& item : items)
    list.push_back(to_json(item));
  print_json(list);
}

}  // namespace splotchcl::cli
