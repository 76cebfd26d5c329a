#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTimeCode.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "image/picture_encoders.h"
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

namespace {

constexpr const char* channels[] = {"R", "G", "B", "A"};

// A file in memory. The table of where lines begin is written last, back at the front.
class MemoryStream : public Imf::OStream {
 public:
  explicit MemoryStream(const std::string& name) : Imf::OStream(name.c_str()) {}

  void write(const char text[], int count) override {
    const std::size_t end = place_ + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::copy(text, text + count, bytes_.begin() + static_cast<std::ptrdiff_t>(place_));
    place_ = end;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = static_cast<std::size_t>(place); }

  std::vector<unsigned char> take() { return std::move(bytes_); }

 private:
  std::vector<unsigned char> bytes_;
  std::size_t place_ = 0;
};

class MemorySource : public Imf::IStream {
 public:
  MemorySource(const std::string& name, const std::vector<unsigned char>& bytes)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (static_cast<std::size_t>(count) > bytes_.size() - place_)
      throw std::out_of_range("it ends too early");
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(place_), count, to);
    place_ += static_cast<std::size_t>(count);
    return place_ < bytes_.size();
  }
  std::uint64_t tellg() override { return place_; }
  void seekg(std::uint64_t place) override {
    place_ = std::min(static_cast<std::size_t>(place), bytes_.size());
  }

 private:
  const std::vector<unsigned char>& bytes_;
  std::size_t place_ = 0;
};

// Where memory runs out while lines are packed, OpenEXR leaves them out and tells nobody.
void require_all_lines(const std::string& name, const std::vector<unsigned char>& bytes) {
  MemorySource source(name, bytes);
  if (!Imf::InputFile(source).isComplete()) throw std::bad_alloc();
}

// "HH:MM:SS:FF", where other programs look for it.
void add_time_code(const std::string& text, Imf::Header& header) {
  int hours = 0, minutes = 0, seconds = 0, frame = 0;
  if (std::sscanf(text.c_str(), "%2d:%2d:%2d:%2d", &hours, &minutes, &seconds, &frame) != 4) return;
  Imf::addTimeCode(header, Imf::TimeCode(hours, minutes, seconds, frame));
}

Imf::Header make_header(const Image& image, const std::map<std::string, std::string>& metadata) {
  Imf::Header header(image.width, image.height);
  for (const char* channel : channels)
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  const auto time_code = metadata.find("splotchcl:timecode");
  if (time_code != metadata.end()) add_time_code(time_code->second, header);
  for (const auto& [name, text] : metadata)
    header.insert(name, Imf::StringAttribute(text));
  Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709's, which are sRGB's
  return header;
}

Imf::FrameBuffer make_frame_buffer(const Image& image) {
  constexpr std::size_t pixel_bytes = 4 * sizeof(float);
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < 4; ++i) {
    // OpenEXR reads from it, though its type says otherwise.
    char* const first = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data() + i));
    buffer.insert(channels[i], Imf::Slice(Imf::FLOAT, first, pixel_bytes,
                                          pixel_bytes * static_cast<std::size_t>(image.width)));
  }
  return buffer;
}

// Compressing a large picture is worth threads, which OpenEXR keeps for the whole process.
void start_threads(const Image& image) {
  constexpr std::size_t large = 4 * 1000 * 1000;  // floats
  if (image.pixels.size() < large || Imf::globalThreadCount() > 0) return;
  Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

std::vector<unsigned char> encode_exr(const std::filesystem::path& path, const Image& image,
                                      const std::map<std::string, std::string>& metadata) {
  try {
    start_threads(image);
    MemoryStream stream(path.string());
    {
      Imf::OutputFile file(stream, make_header(image, metadata), Imf::globalThreadCount());
      file.setFrameBuffer(make_frame_buffer(image));
      file.writePixels(image.height);
    }  // which completes the file
    std::vector<unsigned char> bytes = stream.take();
    require_all_lines(path.string(), bytes);
    return bytes;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw DataError(path.string() + ": " + std::to_string(image.width) + "x" +
                    std::to_string(image.height) +
                    " pixels cannot be stored as .exr: " + error.what());
  }
}

}  // namespace splotchcl
