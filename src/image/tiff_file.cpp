#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

#include "image/picture_encoders.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Bytes = std::vector<unsigned char>;

void put_16(Bytes& bytes, std::uint32_t value) {
  bytes.push_back(static_cast<unsigned char>(value >> 8 & 0xFF));
  bytes.push_back(static_cast<unsigned char>(value & 0xFF));
}

void put_32(Bytes& bytes, std::uint32_t value) {
  put_16(bytes, value >> 16);
  put_16(bytes, value & 0xFFFF);
}

void put_text(Bytes& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

// s15Fixed16Number
void put_number(Bytes& bytes, double value) {
  put_32(bytes, static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * 65536))));
}

// A tag's type and its reserved bytes.
Bytes element(const char* type) {
  Bytes bytes;
  put_text(bytes, type);
  put_32(bytes, 0);
  return bytes;
}

Bytes numbers(const char* type, std::initializer_list<double> values) {
  Bytes bytes = element(type);
  for (const double value : values)
    put_number(bytes, value);
  return bytes;
}

// One text, in English.
Bytes words(const std::string& text) {
  Bytes bytes = element("mluc");
  put_32(bytes, 1);   // names
  put_32(bytes, 12);  // bytes that tell of each
  put_text(bytes, "enUS");
  put_32(bytes, static_cast<std::uint32_t>(2 * text.size()));
  put_32(bytes, 28);  // where it begins
  for (const char letter : text)
    put_16(bytes, static_cast<unsigned char>(letter));
  return bytes;
}

Bytes curve(ColorSpace space) {
  if (space == ColorSpace::linear) {
    Bytes bytes = element("curv");
    put_32(bytes, 0);  // entries: none is the identity
    return bytes;
  }
  Bytes bytes = element("para");
  put_16(bytes, 3);  // (a x + b)^g from d on, c x below
  put_16(bytes, 0);
  for (const double value : {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045})
    put_number(bytes, value);
  return bytes;
}

Bytes header() {
  Bytes bytes;
  put_32(bytes, 0);  // the profile's size, put in last
  put_32(bytes, 0);
  put_32(bytes, 0x04200000);
  put_text(bytes, "mntrRGB XYZ ");
  for (const std::uint32_t part : {2026u, 1u, 1u, 0u, 0u, 0u})
    put_16(bytes, part);  // when it was made
  put_text(bytes, "acsp");
  for (int i = 0; i < 7; ++i)
    put_32(bytes, 0);
  for (const double value : {0.9642, 1.0, 0.8249})  // D50, which all profiles refer to
    put_number(bytes, value);
  bytes.resize(128);
  return bytes;
}

}  // namespace

std::vector<unsigned char> color_profile(ColorSpace space) {
  const std::string name = space == ColorSpace::srgb ? "sRGB" : "Rec. 709, linear";
  // Columns are Rec. 709's primaries under D50, by Bradford's adaptation from D65.
  const std::vector<std::pair<const char*, Bytes>> elements = {
      {"desc", words(name)},
      {"cprt", words("No copyright, use freely")},
      {"wtpt", numbers("XYZ ", {0.9642, 1, 0.8249})},
      {"chad", numbers("sf32", {1.0478112, 0.0228866, -0.0501270, 0.0295424, 0.9904844, -0.0170491,
                                -0.0092345, 0.0150436, 0.7521316})},
      {"rXYZ", numbers("XYZ ", {0.4360747, 0.2225045, 0.0139322})},
      {"gXYZ", numbers("XYZ ", {0.3850649, 0.7168786, 0.0971045})},
      {"bXYZ", numbers("XYZ ", {0.1430804, 0.0606169, 0.7141733})},
      {"rTRC", curve(space)},
      {"gTRC", curve(space)},
      {"bTRC", curve(space)}};
  Bytes profile = header();
  put_32(profile, static_cast<std::uint32_t>(elements.size()));
  std::size_t place = profile.size() + 12 * elements.size();
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  for (const auto& [tag, bytes] : elements) {
    put_text(profile, tag);
    put_32(profile, static_cast<std::uint32_t>(place));
    put_32(profile, static_cast<std::uint32_t>(bytes.size()));
    place += padded(bytes.size());
  }
  for (const auto& [tag, bytes] : elements) {
    profile.insert(profile.end(), bytes.begin(), bytes.end());
    profile.resize(padded(profile.size()));
  }
  Bytes size;
  put_32(size, static_cast<std::uint32_t>(profile.size()));
  std::copy(size.begin(), size.end(), profile.begin());
  return profile;
}

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
  std::string description = {};  // may be empty

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
  if (!samples.description.empty())
    TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, samples.description.c_str());
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

std::vector<unsigned char> encode_tiff(const std::filesystem::path& path, const Image& image,
                                       const std::string& description) {
  return encode(path, {image.width, image.height, 4, 32, bytes_of(image.pixels), description});
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
