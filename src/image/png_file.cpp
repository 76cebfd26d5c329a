#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <string>

#include "image/picture_encoders.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Enough that the cores' work is long beside what a strip costs, and that a strip's own codes cost
// next to nothing.
constexpr std::size_t strip_bytes = 256 << 10;

constexpr unsigned char filter_sub = 1;  // differences from the pixel to the left

struct Strip {
  std::vector<unsigned char> compressed;
  uLong checksum = 0;        // Adler-32 of the filtered rows
  std::size_t filtered = 0;  // bytes
};

struct EndDeflate {
  void operator()(z_stream* stream) const { deflateEnd(stream); }
};

std::vector<unsigned char> filter(const PngRows& picture, std::size_t first, std::size_t last) {
  std::vector<unsigned char> filtered((last - first) * (picture.row_bytes + 1));
  auto to = filtered.begin();
  for (std::size_t row = first; row < last; ++row) {
    const unsigned char* from = picture.bytes + row * picture.row_bytes;
    *to++ = filter_sub;
    to = std::copy_n(from, picture.pixel_bytes, to);
    for (std::size_t i = picture.pixel_bytes; i < picture.row_bytes; ++i)
      *to++ = static_cast<unsigned char>(from[i] - from[i - picture.pixel_bytes]);
  }
  return filtered;
}

// Ends at a whole byte, so that another strip may follow.
std::vector<unsigned char> compress(std::vector<unsigned char> bytes, bool is_last) {
  // Of dithered light differences from the pixel beside and runs of the same are all that there is
  // to find: looking for more took up to twice as long, and the files were a fifth larger.
  constexpr int level = 1, raw = -MAX_WBITS, memory_level = 9;
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, raw, memory_level, Z_RLE) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, EndDeflate> end(&stream);
  // deflateBound() counts a whole stream's end, which is no shorter than that of a strip.
  std::vector<unsigned char> compressed(deflateBound(&stream, bytes.size()) + 16);
  stream.next_in = bytes.data();
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = compressed.data();
  stream.avail_out = static_cast<uInt>(compressed.size());
  const int done = deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  if (done != (is_last ? Z_STREAM_END : Z_OK) || stream.avail_in > 0) throw std::bad_alloc();
  compressed.resize(stream.total_out);
  return compressed;
}

Strip make_strip(const PngRows& picture, std::size_t first, std::size_t last) {
  std::vector<unsigned char> filtered = filter(picture, first, last);
  Strip strip;
  strip.filtered = filtered.size();
  strip.checksum =
      adler32(adler32(0, nullptr, 0), filtered.data(), static_cast<uInt>(filtered.size()));
  strip.compressed = compress(std::move(filtered), last == picture.rows);
  return strip;
}

// Around the strips: what begins a zlib stream of level 1, and the checksum of all.
void make_stream(std::vector<Strip>& strips) {
  std::vector<unsigned char>& first = strips.front().compressed;
  first.insert(first.begin(), {0x78, 0x01});
  uLong checksum = strips.front().checksum;
  for (std::size_t s = 1; s < strips.size(); ++s)
    checksum =
        adler32_combine(checksum, strips[s].checksum, static_cast<z_off_t>(strips[s].filtered));
  for (int shift = 24; shift >= 0; shift -= 8)
    strips.back().compressed.push_back(static_cast<unsigned char>(checksum >> shift & 0xFF));
}

}  // namespace

std::vector<std::vector<unsigned char>> png_strips(const PngRows& picture) {
  const std::size_t rows_of_strip = std::max<std::size_t>(1, strip_bytes / (picture.row_bytes + 1));
  std::vector<Strip> strips(ceil_divide(picture.rows, rows_of_strip));
  for_blocks(strips.size(), 1, [&](std::size_t s, std::size_t) {
    strips[s] =
        make_strip(picture, s * rows_of_strip, std::min((s + 1) * rows_of_strip, picture.rows));
  });
  make_stream(strips);
  std::vector<std::vector<unsigned char>> data;
  for (Strip& strip : strips)
    data.push_back(std::move(strip.compressed));
  return data;
}

// Not by libpng's simple interface: it takes 16 bits for linear light. And not its rows, which one
// core alone would compress.

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
