#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "splotchcl/image.h"
#include "splotchcl/pixel_places.h"

namespace splotchcl {

// Throws UsageError when the ending names no format that can be written, DataError when
// the folder is missing or not writable. Called before anything is read or drawn.
void check_image_path(const std::filesystem::path& path);
// Throws UsageError when the format cannot hold so large a picture.
void check_image_size(const std::filesystem::path& path, int width, int height);

// How a picture is stored. v = value^(1/gamma), from 0 to 1, is the display value.
struct ImageFileOptions {
  double gamma = 1;        // > 0; files of floats stay linear
  bool truncates = false;  // 8 bits are floor(256 v), at most 255, not round(255 v)
  // Kept by EXR; of what other formats hold, TIFF and HDR files of floats say what light it is
  // (light_metadata).
  std::map<std::string, std::string> metadata = {};
  // 8 or 16, which PNG and TIFF can hold. Unset: 8, and TIFF holds floats.
  std::optional<int> bits = std::nullopt;
  // 8 bits are floor(255 v + t) with t from blue noise between 0 and 1 instead of 1/2 (unless they
  // are truncated). What is a whole number stays one.
  bool dithers = false;
  PixelPlaces places = {};
};

// The names in the metadata of what light a file of floats holds.
const std::vector<std::string>& light_metadata();

// Whether a file of this name keeps linear floats, if so many bits are asked for. Throws UsageError
// when the ending names no format that can be written.
bool holds_floats(const std::filesystem::path& path, std::optional<int> bits);

// Throws UsageError when a format of 8 bits alone shall hold more.
void check_image_bits(const std::filesystem::path& path, std::optional<int> bits);

// EXR, and TIFF unless bits are given, keep linear 32-bit floats and premultiplied alpha, HDR
// linear colour; the others clamp to [0, 1] and store whole numbers without alpha. PNG and TIFF
// files say which it is, sRGB or linear, EXR files that their primaries are those of sRGB, JPEG
// files sRGB. Written under a temporary name in the same folder and renamed when complete. Throws
// as check_image_path, check_image_size and check_image_bits do, and DataError for a value that is
// not a number or a file that cannot be written.
void write_image(const std::filesystem::path& path, const Image& image,
                 const ImageFileOptions& options = {});

// Red, green and blue of each pixel, rows from the top, as formats of 8 bits store them. `path` is
// for messages. Throws DataError for a value that is not a number.
std::vector<std::uint8_t> display_bytes(const std::filesystem::path& path, const Image& image,
                                        const ImageFileOptions& options = {});
// The same in 16 bits: round(65535 v).
std::vector<std::uint16_t> display_words(const std::filesystem::path& path, const Image& image,
                                         const ImageFileOptions& options = {});

// Values as stored: 8 bits become value / 255, 16 bits value / 65535, without a gamma. Gray becomes
// equal red, green and blue; missing alpha becomes 1. Throws DataError.
Image read_image(const std::filesystem::path& path);

// A picture as light, however large its file is.
struct LinearImageOptions {
  // Light = value^gamma. Unset: 2.2 for values stored as whole numbers, 1 for floats.
  std::optional<double> gamma;
  // A picture with a longer side is averaged over squares of the fewest whole pixels that
  // make it fit; only a band of rows is in memory at a time. 0: never.
  int longest_side = 0;
};
// Light premultiplied by alpha. Throws DataError, also where a value is not finite, or below 0
// where gamma is not 1.
Image read_linear_image(const std::filesystem::path& path, const LinearImageOptions& options = {});

// What a file says of its picture.
struct ImageFileInfo {
  int width = 0, height = 0;
  bool has_alpha = false;
  bool is_float = false;  // linear light; otherwise whole numbers, display values
  std::map<std::string, std::string> metadata;  // text only
};
// Reads no more than the file's header. Throws DataError.
ImageFileInfo read_image_info(const std::filesystem::path& path);

}  // namespace splotchcl
