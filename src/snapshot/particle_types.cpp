#include "snapshot/particle_types.h"

#include <charconv>
#include <utility>

#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

constexpr std::array<std::pair<const char*, int>, 12> other_names = {{
    {"dm", 1},
    {"dark", 1},
    {"dark_matter", 1},
    {"darkmatter", 1},
    {"disc", 2},
    {"star", 4},
    {"bndry", 5},
    {"bh", 5},
    {"black_hole", 5},
    {"black_holes", 5},
    {"blackhole", 5},
    {"blackholes", 5},
}};

// PartType12 is 12.
std::optional<int> number_of_group(std::string_view word) {
  constexpr std::string_view stem = "PartType";
  if (!equal_ignoring_case(word.substr(0, stem.size()), stem)) return std::nullopt;
  const std::string_view digits = word.substr(stem.size());
  int number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  if (!is_number || number < 0 || number >= particle_type_limit) return std::nullopt;
  return number;
}

}  // namespace

std::string particle_type_name(int type) {
  const auto index = static_cast<std::size_t>(type);
  return index < particle_type_names.size() ? particle_type_names[index]
                                            : "type_" + std::to_string(type);
}

std::optional<int> find_particle_type(std::string_view word) {
  for (std::size_t type = 0; type < particle_type_names.size(); ++type) {
    if (equal_ignoring_case(word, particle_type_names[type])) return static_cast<int>(type);
  }
  for (const auto& [name, type] : other_names) {
    if (equal_ignoring_case(word, name)) return type;
  }
  return number_of_group(word);
}

}  // namespace splotchcl
