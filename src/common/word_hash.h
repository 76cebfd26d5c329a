#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace splotchcl {

// Mixes numbers and texts into one key (FNV-1a, word by word).
class WordHash {
 public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3U; }
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char letter : text)
      add(std::uint64_t{static_cast<unsigned char>(letter)});
  }
  std::uint64_t value() const { return value_ ^ value_ >> 29; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace splotchcl
