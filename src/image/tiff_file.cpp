#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>

#include "image/color_profile.h"
#include "image/picture_encoders.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr int rows_in_strip = 64;
// Offsets have 32 bits unless a file says otherwise. Deflating may make noise a little longer.
constexpr std::size_t most_bytes_of_plain_tiff = std::size_t{4000} * 1000 * 1000;

// What libtiff writes to, and what it says of its failures.
struct TiffInMemory {
  std::vector<unsigned char> bytes;
  std::size_t place = 0;
  std::string problem;  // the first that was found

  void fail(const char* why) {
    if (problem.empty()) problem = why;
  }
};

TiffInMemory& memory_file(thandle_t handle) {
  return *static_cast<TiffInMemory*>(handle);
}

// libtiff reads back what it has begun to write.
tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t count) {
  TiffInMemory& file = memory_file(handle);
  const std::size_t left = file.bytes.size() - std::min(file.place, file.bytes.size());
  const std::size_t taken = std::min(left, static_cast<std::size_t>(count));
  std::copy_n(file.bytes.begin() + static_cast<std::ptrdiff_t>(file.place), taken,
              static_cast<unsigned char*>(to));
  file.place += taken;
  return static_cast<tmsize_t>(taken);
}

// libtiff is written in C, which exceptions do not pass.
tmsize_t write_bytes(thandle_t handle, void* from, tmsize_t count) {
  TiffInMemory& file = memory_file(handle);
  const std::size_t end = file.place + static_cast<std::size_t>(count);
  try {
    if (file.bytes.size() < end) file.bytes.resize(end);
  } catch (const std::exception&) {
    file.fail("out of memory");
    return 0;
  }
  std::copy_n(static_cast<const unsigned char*>(from), count,
              file.bytes.begin() + static_cast<std::ptrdiff_t>(file.place));
  file.place = end;
  return count;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  TiffInMemory& file = memory_file(handle);
  const std::size_t from = whence == SEEK_SET   ? 0
                           : whence == SEEK_CUR ? file.place
                                                : file.bytes.size();
  file.place = from + static_cast<std::size_t>(offset);
  return file.place;
}

int close_nothing(thandle_t) {
  return 0;
}

toff_t size_of(thandle_t handle) {
  return memory_file(handle).bytes.size();
}

int keep_problem(TIFF*, void* handle, const char*, const char* format, std::va_list values) {
  char text[256];
  std::vsnprintf(text, sizeof text, format, values);
  memory_file(handle).fail(text);
  return 1;  // libtiff need not print it
}

int ignore_warning(TIFF*, void*, const char*, const char*, std::va_list) {
  return 1;
}

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, CloseTiff>;

// Rows from the top of what a file shall hold.
struct Samples {
  int width = 0, height = 0;
  int channels = 3;  // four: premultiplied alpha is the last
  int bits = 8;      // 32: floats of linear light
  const unsigned char* bytes = nullptr;

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels * bits / 8);
  }
  bool is_linear() const { return bits == 32; }
};

Tiff open(TiffInMemory& file, const Samples& samples) {
  const bool is_big =
      samples.row_bytes() * static_cast<std::size_t>(samples.height) > most_bytes_of_plain_tiff;
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_problem, &file);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, nullptr);
  return Tiff(TIFFClientOpenExt("picture", is_big ? "w8" : "w", &file, read_bytes, write_bytes,
                                seek, close_nothing, size_of, nullptr, nullptr, options.get()));
}

void describe(TIFF* tiff, const Samples& samples) {
  const std::uint16_t alpha_is_multiplied[] = {EXTRASAMPLE_ASSOCALPHA};
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, samples.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, samples.height);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples.channels);
  if (samples.channels == 4) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, alpha_is_multiplied);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, samples.bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT,
               samples.is_linear() ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  const std::vector<unsigned char> profile =
      color_profile(samples.is_linear() ? ColorSpace::linear : ColorSpace::srgb);
  TIFFSetField(tiff, TIFFTAG_ICCPROFILE, static_cast<std::uint32_t>(profile.size()),
               profile.data());
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_NONE);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, std::min(rows_in_strip, samples.height));
}

bool write_strips(TIFF* tiff, const Samples& samples) {
  // libtiff may work in what it is given.
  std::vector<unsigned char> strip;
  for (int first = 0; first < samples.height; first += rows_in_strip) {
    const int rows = std::min(rows_in_strip, samples.height - first);
    const unsigned char* const from =
        samples.bytes + samples.row_bytes() * static_cast<std::size_t>(first);
    strip.assign(from, from + samples.row_bytes() * static_cast<std::size_t>(rows));
    const auto bytes = static_cast<tmsize_t>(strip.size());
    const auto number = static_cast<std::uint32_t>(first / rows_in_strip);
    if (TIFFWriteEncodedStrip(tiff, number, strip.data(), bytes) != bytes) return false;
  }
  return TIFFWriteDirectory(tiff) == 1;
}

std::vector<unsigned char> encode(const std::filesystem::path& path, const Samples& samples) {
  TiffInMemory file;
  bool is_written = false;
  if (const Tiff tiff = open(file, samples)) {
    describe(tiff.get(), samples);
    is_written = write_strips(tiff.get(), samples);
  }  // which completes the file
  if (!is_written || !file.problem.empty()) {
    throw DataError(path.string() + ": " + std::to_string(samples.width) + "x" +
                    std::to_string(samples.height) + " pixels cannot be stored as .tif: " +
                    (file.problem.empty() ? "libtiff does not say why" : file.problem));
  }
  return std::move(file.bytes);
}

template <class Value>
const unsigned char* bytes_of(const std::vector<Value>& values) {
  return reinterpret_cast<const unsigned char*>(values.data());
}

}  // namespace

std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, const Image& image) {
  return encode(path, {image.width, image.height, 4, 32, bytes_of(image.pixels)});
}

std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, int width, int height,
                                       const std::vector<std::uint8_t>& rgb) {
  return encode(path, {width, height, 3, 8, bytes_of(rgb)});
}

std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, int width, int height,
                                       const std::vector<std::uint16_t>& rgb) {
  return encode(path, {width, height, 3, 16, bytes_of(rgb)});
}

}  // namespace splotchcl
