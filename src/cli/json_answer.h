#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Answers of commands for programs rather than people (--json).
namespace splotchcl::cli {

using Json = nlohmann::ordered_json;

// Names in files need not be UTF-8, which JSON is: bytes that are none are replaced. Characters
// that a terminal would obey are escaped.
std::string json_text(const Json& json);

void print_json(const Json& json);

// A list of what `to_json` makes of each item.
template <typename Item, typename ToJson>
void print_json_list(const std::vector<Item>& items, ToJson to_json) {
  Json list = Json::array();
  for (const Item& item : items)
    list.push_back(to_json(item));
  print_json(list);
}

}  // namespace splotchcl::cli
