#include "view/jpeg.h"

// jpeglib.h needs these two before it.
// clang-format off
#include <cstddef>
#include <cstdio>
#include <jpeglib.h>
// clang-format on
#include <csetjmp>
#include <cstdlib>
#include <string>

#include "splotchcl/error.h"

namespace splotchcl::view {
namespace {

constexpr int quality = 85;

// The manager first: libjpeg hands out a pointer to it.
struct Errors {
  jpeg_error_mgr manager = {};
  jmp_buf failed = {};
  char text[JMSG_LENGTH_MAX] = {};
};

// libjpeg is written in C: no exception passes it, and it goes on after a failure by a jump.
[[noreturn]] void leave(j_common_ptr info) {
  auto* const errors = reinterpret_cast<Errors*>(info->err);
  (*info->err->format_message)(info, errors->text);
  longjmp(errors->failed, 1);
}

// Owns libjpeg's state and the memory that it makes.
class Compressor {
 public:
  Compressor() {
    info_.err = ::jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = leave;
  }
  ~Compressor() {
    ::jpeg_destroy_compress(&info_);
    std::free(bytes_);
  }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  // Nothing with a destructor is made here: a jump would pass it by. False: it failed.
  bool compress(int width, int height, const std::uint8_t* rgb) {
    if (setjmp(errors_.failed) != 0) return false;
    ::jpeg_create_compress(&info_);
    ::jpeg_mem_dest(&info_, &bytes_, &size_);
    info_.image_width = static_cast<JDIMENSION>(width);
    info_.image_height = static_cast<JDIMENSION>(height);
    info_.input_components = 3;
    info_.in_color_space = JCS_RGB;
    ::jpeg_set_defaults(&info_);
    ::jpeg_set_quality(&info_, quality, TRUE);
    ::jpeg_start_compress(&info_, TRUE);
    while (info_.next_scanline < info_.image_height) {
      // libjpeg asks for pointers to what it only reads.
      auto* row = const_cast<JSAMPLE*>(rgb + std::size_t{3} * info_.next_scanline *
                                                 static_cast<std::size_t>(width));
      ::jpeg_write_scanlines(&info_, &row, 1);
    }
    ::jpeg_finish_compress(&info_);
    return true;
  }

  std::string problem() const { return errors_.text; }
  std::vector<unsigned char> bytes() const { return {bytes_, bytes_ + size_}; }

 private:
  Errors errors_;
  jpeg_compress_struct info_ = {};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

std::vector<unsigned char> encode_jpeg(int width, int height,
                                       const std::vector<std::uint8_t>& rgb) {
  Compressor compressor;
  if (!compressor.compress(width, height, rgb.data()))
    throw DataError("a preview cannot be stored as JPEG: " + compressor.problem());
  return compressor.bytes();
}

}  // namespace splotchcl::view
