#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace splotchcl {

// A hash whose every bit depends on every bit of the key: the finalizer of SplitMix64.
inline std::uint64_t hash_of(std::uint64_t key) {
  key += 0x9e3779b97f4a7c15U;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9U;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebU;
  return key ^ (key >> 31);
}

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

// Of whole words: the last bytes count as a word that ends in zeros. Differs wherever one word
// does.
inline std::uint64_t checksum(const std::byte* bytes, std::size_t size) {
  WordHash hash;
  for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min(sizeof word, size - i));
    hash.add(word);
  }
  return hash.value();
}

}  // namespace splotchcl
