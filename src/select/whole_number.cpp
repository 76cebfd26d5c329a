#include "select/whole_number.h"

#include <charconv>
#include <cmath>

#include "common/words.h"

namespace splotchcl {

std::optional<std::uint64_t> whole_number(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && rest == end) return number;
  if (text.find_first_of(".eE") == std::string::npos) return std::nullopt;
  constexpr double largest = 9007199254740992.0;
  const auto real = parse_number(text);
  const bool is_whole = real && *real >= 0 && *real < largest && *real == std::floor(*real);
  return is_whole ? std::optional(static_cast<std::uint64_t>(*real)) : std::nullopt;
}

}  // namespace splotchcl
