#pragma once

#include <cstdint>
#include <string_view>

#include "common/mapped_file.h"

namespace splotchcl {

// Goes through the lines of a file that are not blank.
class TextLines {
 public:
  // From a place in the file, before which so many lines are.
  explicit TextLines(const MappedFile& file, std::uint64_t offset = 0, std::uint64_t number = 0);

  bool next();
  // The same, blank lines too.
  bool next_of_all();

  std::string_view line() const { return line_; }    // without blanks around it
  std::string_view whole() const { return whole_; }  // with them
  bool begins_with_blank() const { return !whole_.empty() && whole_.data() != line_.data(); }
  std::uint64_t number() const { return number_; }  // from 1
  std::uint64_t start() const { return start_; }
  std::uint64_t end() const { return offset_; }  // where the next one begins

 private:
  const char* data_;
  std::uint64_t size_, offset_, number_;
  std::uint64_t start_ = 0;
  std::string_view line_, whole_;
};

std::string_view without_blanks(std::string_view text);

}  // namespace splotchcl
