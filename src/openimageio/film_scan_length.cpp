#include "openimageio/film_scan_length.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The numbers at the start of a file, most significant byte first or last.
class Header {
 public:
  explicit Header(const std::filesystem::path& path) {
    std::ifstream(path, std::ios::binary)
        .read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  }

  bool begins_with(std::string_view mark) const {
    return std::string_view(bytes_.data(), mark.size()) == mark;
  }
  void set_least_first(bool is_least_first) { is_least_first_ = is_least_first; }
  std::uint64_t number(std::size_t place, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t next = place + (is_least_first_ ? size - 1 - i : i);
      value = value << 8 | static_cast<unsigned char>(bytes_[next]);
    }
    return value;
  }

 private:
  std::array<char, 2048> bytes_ = {};
  bool is_least_first_ = false;
};

// Of values one after the other, or with as many of them as fit into each word of 32 bits.
std::uint64_t line_bytes(std::uint64_t values, std::uint64_t bits, bool fills_words) {
  constexpr std::uint64_t word_bits = 32, word_bytes = 4;
  if (!fills_words || bits == 0 || bits > word_bits) return values * bits / 8;
  const std::uint64_t in_word = word_bits / bits;
  return (values + in_word - 1) / in_word * word_bytes;
}

// How many values a pixel of an element of DPX has, by its descriptor.
std::uint64_t values_of(std::uint64_t descriptor) {
  switch (descriptor) {
    case 50:
    case 102:
      return 3;
    case 51:
    case 52:
    case 103:
      return 4;
    case 100:
      return 2;
    default:
      return 1;
  }
}

std::optional<std::uint64_t> dpx_bytes(Header header) {
  const bool is_least_first = header.begins_with("XPDS");
  if (!is_least_first && !header.begins_with("SDPX")) return std::nullopt;
  header.set_least_first(is_least_first);
  constexpr std::size_t element = 780;
  const bool is_packed_in_runs = header.number(element + 26, 2) != 0;
  if (is_packed_in_runs) return std::nullopt;
  const std::uint64_t width = header.number(772, 4), height = header.number(776, 4);
  const std::uint64_t bits = header.number(element + 23, 1);
  const bool fills_words = bits == 10 && header.number(element + 24, 2) != 0;
  const std::uint64_t values = width * values_of(header.number(element + 20, 1));
  // Of 12 bits two bytes are filled.
  const bool fills_bytes = bits == 12 && header.number(element + 24, 2) != 0;
  return header.number(4, 4) + height * line_bytes(values, fills_bytes ? 16 : bits, fills_words);
}

std::optional<std::uint64_t> cineon_bytes(Header header) {
  const bool is_least_first = header.begins_with("\xd7\x5f\x2a\x80");
  if (!is_least_first && !header.begins_with("\x80\x2a\x5f\xd7")) return std::nullopt;
  header.set_least_first(is_least_first);
  const std::uint64_t channels = header.number(193, 1), bits = header.number(198, 1);
  const std::uint64_t packing = header.number(681, 1);
  const bool fills_words = packing == 5 || packing == 6;
  const std::uint64_t values = header.number(200, 4) * channels;
  return header.number(4, 4) + header.number(204, 4) * line_bytes(values, bits, fills_words);
}

}  // namespace

void check_length_of_film_scan(const std::filesystem::path& path) {
  const Header header(path);
  const std::optional<std::uint64_t> dpx = dpx_bytes(header);
  const std::optional<std::uint64_t> expected = dpx ? dpx : cineon_bytes(header);
  std::error_code error;
  const std::uint64_t found = std::filesystem::file_size(path, error);
  if (error || !expected || found >= *expected) return;
  throw DataError(path.string() + ": ends after " + std::to_string(found) + " bytes, expected " +
                  std::to_string(*expected) + "; the file is cut: copy or write it again");
}

}  // namespace splotchcl
