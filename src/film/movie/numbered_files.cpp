#include "film/movie/numbered_files.h"

#include <fmt/format.h>
#include <fmt/printf.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::optional<int> read_whole_number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || next != end || value < 0) return std::nullopt;
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

[[noreturn]] void refuse_range(const std::string& text) {
  throw UsageError(fmt::format(
      "--frames: '{}' is not FIRST:END:STEP, whole numbers such as 100:200:2 for 100, 102, ... 198",
      text));
}

int part_of_range(const std::string& text, const std::string& part, int absent) {
  if (part.empty()) return absent;
  const std::optional<int> number = read_whole_number(part);
  if (!number) refuse_range(text);
  return *number;
}

}  // namespace

std::vector<int> select_frames(const std::string& text, int frame_count) {
  const std::vector<std::string> parts = split(text.empty() ? ":" : text, ':');
  if (parts.size() > 3 || (parts.size() == 1 && parts[0].empty())) refuse_range(text);
  const int first = part_of_range(text, parts[0], 0);
  const int end = parts.size() == 1 ? first + 1 : part_of_range(text, parts[1], frame_count);
  const int step = parts.size() < 3 ? 1 : part_of_range(text, parts[2], 1);
  if (step == 0) refuse_range(text);
  if (first >= end || end > frame_count) {
    throw UsageError(
        fmt::format("--frames: found {}, expected frames from 0 to {}, of which the "
                    "film has {}, and the first before the end",
                    text, frame_count - 1, frame_count));
  }
  std::vector<int> frames;
  for (std::int64_t frame = first; frame < end; frame += step)
    frames.push_back(static_cast<int>(frame));
  return frames;
}

std::vector<int> select_part(const std::string& text, const std::vector<int>& frames) {
  if (text.empty()) return frames;
  const std::vector<std::string> parts = split(text, '/');
  const auto part = read_whole_number(parts[0]);
  const auto count = parts.size() == 2 ? read_whole_number(parts[1]) : std::nullopt;
  if (!part || !count || *part < 1 || *part > *count) {
    throw UsageError(
        fmt::format("--part: found '{}', expected K/N with K from 1 to N, such as 3/8", text));
  }
  const auto boundary = [&](int parts_before) {
    return static_cast<std::ptrdiff_t>(static_cast<std::uint64_t>(frames.size()) *
                                       static_cast<std::uint64_t>(parts_before) /
                                       static_cast<std::uint64_t>(*count));
  };
  return {frames.begin() + boundary(*part - 1), frames.begin() + boundary(*part)};
}

namespace {

// Whether a number stands at the place of the '%'.
bool is_number(const std::string& name, std::size_t percent) {
  constexpr std::size_t most_digits = 3;
  std::size_t end = percent + 1;
  while (end < name.size() && end - percent <= most_digits &&
         std::isdigit(static_cast<unsigned char>(name[end])) != 0) {
    ++end;
  }
  return end < name.size() && name[end] == 'd';
}

}  // namespace

std::optional<NumberedFiles> NumberedFiles::find(const std::filesystem::path& pattern) {
  const std::string name = pattern.filename().string();
  const bool has_one = std::count(name.begin(), name.end(), '%') == 1;
  if (!has_one || !is_number(name, name.find('%'))) return std::nullopt;
  return NumberedFiles(pattern);
}

NumberedFiles NumberedFiles::require(const std::filesystem::path& pattern,
                                     const std::string& option) {
  if (std::optional<NumberedFiles> files = find(pattern)) return *files;
  throw UsageError(option + ": found '" + pattern.string() +
                   "', expected a name with one place for a number, such as turn_%04d" +
                   pattern.extension().string());
}

std::filesystem::path NumberedFiles::at(int number) const {
  return pattern_.parent_path() / fmt::sprintf(pattern_.filename().string(), number);
}

}  // namespace splotchcl
