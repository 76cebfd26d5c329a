#include "view/jpeg.h"

// jpeglib.h needs these two before it.
// clang-format off
#include <cstddef>
#include <cstdio>
#include <jpeglib.h>
// clang-format on
#include <cstdlib>
#include <memory>
#include <string>

#include "splotchcl/error.h"

namespace splotchcl::view {
namespace {

constexpr int quality = 85;

[[noreturn]] void throw_error(j_common_ptr info) {
  char text[JMSG_LENGTH_MAX];
  (*info->err->format_message)(info, text);
  throw DataError(std::string("a preview cannot be stored as JPEG: ") + text);
}

// Owns libjpeg's state and the memory that it makes.
class Compressor {
 public:
  Compressor() {
    info_.err = ::jpeg_std_error(&errors_);
    errors_.error_exit = throw_error;
    ::jpeg_create_compress(&info_);
    ::jpeg_mem_dest(&info_, &bytes_, &size_);
  }
  ~Compressor() {
    ::jpeg_destroy_compress(&info_);
    std::free(bytes_);
  }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  jpeg_compress_struct& info() { return info_; }
  std::vector<unsigned char> bytes() const { return {bytes_, bytes_ + size_}; }

 private:
  jpeg_error_mgr errors_ = {};
  jpeg_compress_struct info_ = {};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

std::vector<unsigned char> encode_jpeg(int width, int height,
                                       const std::vector<std::uint8_t>& rgb) {
  Compressor compressor;
  jpeg_compress_struct& info = compressor.info();
  info.image_width = static_cast<JDIMENSION>(width);
  info.image_height = static_cast<JDIMENSION>(height);
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  ::jpeg_set_defaults(&info);
  ::jpeg_set_quality(&info, quality, TRUE);
  ::jpeg_start_compress(&info, TRUE);
  const std::size_t stride = 3 * static_cast<std::size_t>(width);
  while (info.next_scanline < info.image_height) {
    // libjpeg asks for pointers to what it only reads.
    auto* row = const_cast<JSAMPLE*>(rgb.data() + info.next_scanline * stride);
    ::jpeg_write_scanlines(&info, &row, 1);
  }
  ::jpeg_finish_compress(&info);
  return compressor.bytes();
}

}  // namespace splotchcl::view
