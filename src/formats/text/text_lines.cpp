#include "formats/text/text_lines.h"

#include <algorithm>
#include <cstring>

namespace splotchcl {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

TextLines::TextLines(const MappedFile& file, std::uint64_t offset, std::uint64_t number)
    : data_(reinterpret_cast<const char*>(file.data())),
      size_(file.size()),
      offset_(offset),
      number_(number) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";  // some spreadsheets begin with it
  const std::string_view start(data_, std::min<std::uint64_t>(size_, byte_order_mark.size()));
  if (offset_ == 0 && start == byte_order_mark) offset_ = byte_order_mark.size();
}

bool TextLines::next_of_all() {
  if (offset_ >= size_) return false;
  start_ = offset_;
  const void* const end = std::memchr(data_ + offset_, '\n', size_ - offset_);
  const std::uint64_t stop =
      end == nullptr ? size_ : static_cast<std::uint64_t>(static_cast<const char*>(end) - data_);
  offset_ = stop + 1;
  ++number_;
  whole_ = std::string_view(data_ + start_, stop - start_);
  line_ = without_blanks(whole_);
  return true;
}

bool TextLines::next() {
  while (next_of_all()) {
    if (!line_.empty()) return true;
  }
  return false;
}

}  // namespace splotchcl
