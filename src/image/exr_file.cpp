#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <stdexcept>
#include <thread>

#include "image/picture_encoders.h"
#include "splotchcl/error.h"

namespace splotchcl {
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

Imf::Header make_header(const Image& image, const std::map<std::string, std::string>& metadata) {
  Imf::Header header(image.width, image.height);
  for (const char* channel : channels)
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
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
