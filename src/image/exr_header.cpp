#include "image/exr_header.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::uint32_t magic_number = 20000630;
constexpr std::uint32_t several_parts = 0x1000;  // among the flags behind the version

// Little-endian numbers and texts of a file, never beyond its end.
class HeaderReader {
 public:
  explicit HeaderReader(const std::filesystem::path& path)
      : name_(path.string()), file_(path, std::ios::binary | std::ios::ate) {
    size_ = file_ ? static_cast<std::int64_t>(file_.tellg()) : 0;
    file_.seekg(0);
  }

  std::int64_t rest() { return size_ - static_cast<std::int64_t>(file_.tellg()); }

  std::uint32_t number() {
    std::array<unsigned char, 4> bytes = {};
    if (rest() < 4) refuse("it ends inside its header");
    file_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    return bytes[0] | std::uint32_t{bytes[1]} << 8U | std::uint32_t{bytes[2]} << 16U |
           std::uint32_t{bytes[3]} << 24U;
  }

  // Up to a byte of 0. The format's longest name has 255 bytes.
  std::string text() {
    constexpr std::size_t longest = 255;
    std::string result;
    while (result.size() <= longest) {
      const int byte = rest() > 0 ? file_.get() : -1;
      if (byte < 0) refuse("it ends inside its header");
      if (byte == 0) return result;
      result += static_cast<char>(byte);
    }
    refuse("a name in its header has more than 255 bytes");
  }

  void skip(std::int64_t bytes) { file_.seekg(bytes, std::ios::cur); }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw DataError(name_ + ": is damaged: " + reason + "; make or copy it again");
  }

 private:
  std::string name_;
  std::ifstream file_;
  std::int64_t size_ = 0;
};

// Each line of pixels, or block of up to 256 of them, has 8 bytes in a table behind the header.
void check_window(HeaderReader& file) {
  constexpr std::int64_t most_lines_of_block = 256;
  const std::int64_t file_rest = file.rest();
  std::array<std::int32_t, 4> window = {};  // left, top, right, bottom
  for (std::int32_t& edge : window)
    edge = static_cast<std::int32_t>(file.number());
  const std::int64_t lines = std::int64_t{window[3]} - window[1] + 1;
  if (lines < 1 || 8 * (lines / most_lines_of_block) > file_rest) {
    file.refuse(fmt::format("it claims {} lines in {} bytes", lines, file_rest));
  }
}

// A small picture of the picture: its sides, then 4 bytes for each pixel.
void check_preview(HeaderReader& file, std::int64_t size) {
  const std::uint64_t width = file.number();
  const std::uint64_t height = file.number();
  if (width > std::numeric_limits<std::int32_t>::max() ||
      height > std::numeric_limits<std::int32_t>::max() ||
      4 * width * height + 8 != static_cast<std::uint64_t>(size)) {
    file.refuse(fmt::format("a preview of {}x{} pixels in {} bytes", width, height, size));
  }
}

void check_attribute(HeaderReader& file, const std::string& name, const std::string& type,
                     std::int64_t size) {
  const std::int64_t rest = file.rest();
  if (size < 0 || size > rest) {
    file.refuse(
        fmt::format("it claims {} bytes for \"{}\", and has {}", size, name.substr(0, 80), rest));
  }
  std::int64_t read = 0;
  if (name == "dataWindow" && size == 16) {
    check_window(file);
    read = 16;
  } else if (type == "preview" && size >= 8) {
    check_preview(file, size);
    read = 8;
  }
  file.skip(size - read);
}

}  // namespace

void check_exr_header(const std::filesystem::path& path) {
  HeaderReader file(path);
  if (file.rest() < 8 || file.number() != magic_number) return;
  const bool is_list =
      (file.number() & several_parts) != 0;  // of headers, and ends with an empty one
  bool header_is_empty = true;
  while (true) {
    const std::string name = file.text();
    if (name.empty()) {
      if (!is_list || header_is_empty) return;
      header_is_empty = true;
      continue;
    }
    header_is_empty = false;
    const std::string type = file.text();
    check_attribute(file, name, type, static_cast<std::int32_t>(file.number()));
  }
}

}  // namespace splotchcl
