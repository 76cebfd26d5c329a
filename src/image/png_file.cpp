#include "image/png_file.h"

#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <exception>
#include <string>

#include "image/png_strips.h"
#include "splotchcl/error.h"

// Not by libpng's simple interface: it takes 16 bits for linear light. And not its rows, which one
// core alone would compress.
namespace splotchcl {
namespace {

// What libpng writes to, and what it says of its failures.
struct PngInMemory {
  std::vector<unsigned char> bytes;
  std::string problem;
};

// libpng is written in C: no exception passes it, and it goes on after a failure by a jump.
[[noreturn]] void fail(png_structp png, png_const_charp message) {
  auto& file = *static_cast<PngInMemory*>(png_get_error_ptr(png));
  if (file.problem.empty()) file.problem = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void write_bytes(png_structp png, png_bytep from, png_size_t count) {
  auto& file = *static_cast<PngInMemory*>(png_get_io_ptr(png));
  bool is_full = false;
  try {
    file.bytes.insert(file.bytes.end(), from, from + count);
  } catch (const std::exception&) {
    is_full = true;
  }
  if (is_full) png_error(png, "out of memory");
}

void flush_nothing(png_structp) {}

using Strips = std::vector<std::vector<unsigned char>>;

// Nothing with a destructor is made here: a jump would pass it by. False: it failed.
bool write(png_structp png, png_infop info, int width, int height, int bits, const Strips& strips) {
  constexpr png_byte data[] = "IDAT", end[] = "IEND";
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  for (std::size_t s = 0; s < strips.size(); ++s)
    png_write_chunk(png, data, strips[s].data(), strips[s].size());
  // png_write_end() knows of no data but its own.
  png_write_chunk(png, end, nullptr, 0);
  return true;
}

std::vector<unsigned char> encode(const std::filesystem::path& path, int width, int height,
                                  int bits, const std::vector<unsigned char>& bytes) {
  const std::size_t pixel_bytes = 3 * static_cast<std::size_t>(bits / 8);
  const Strips strips = png_strips({bytes.data(), pixel_bytes * static_cast<std::size_t>(width),
                                    static_cast<std::size_t>(height), pixel_bytes});
  PngInMemory file;
  bool is_written = false;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &file, fail, ignore_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info != nullptr) {
    png_set_write_fn(png, &file, write_bytes, flush_nothing);
    is_written = write(png, info, width, height, bits, strips);
  }
  png_destroy_write_struct(&png, &info);
  if (!is_written) {
    throw DataError(path.string() + ": " + std::to_string(width) + "x" + std::to_string(height) +
                    " pixels of " + std::to_string(bits) + " bits cannot be stored as .png: " +
                    (file.problem.empty() ? "out of memory" : file.problem));
  }
  return std::move(file.bytes);
}

// The upper byte first.
std::vector<unsigned char> as_bytes(const std::vector<std::uint16_t>& words) {
  std::vector<unsigned char> bytes;
  bytes.reserve(2 * words.size());
  for (const std::uint16_t word : words) {
    bytes.push_back(static_cast<unsigned char>(word >> 8));
    bytes.push_back(static_cast<unsigned char>(word & 0xFF));
  }
  return bytes;
}

}  // namespace

std::vector<unsigned char> encode_png(const std::filesystem::path& path, int width, int height,
                                      const std::vector<std::uint8_t>& rgb) {
  return encode(path, width, height, 8, rgb);
}

std::vector<unsigned char> encode_png(const std::filesystem::path& path, int width, int height,
                                      const std::vector<std::uint16_t>& rgb) {
  return encode(path, width, height, 16, as_bytes(rgb));
}

}  // namespace splotchcl
