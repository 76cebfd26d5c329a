// Headers of EXR files that claim more than the file holds: the library would take the memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>

#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "temporary_folder.h"

namespace splotchcl {
namespace {

using splotchcl::test::read_text;
using splotchcl::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string bytes_of_number(std::uint32_t number) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(number >> shift & 0xFFU);
  return bytes;
}

std::string picture_bytes(const TemporaryFolder& folder) {
  write_image(folder / "whole.exr", Image(8, 6), {1, false, {{"splotchcl:scene", "a scene"}}});
  return read_text(folder / "whole.exr");
}

// Behind the name and type of an attribute there is its length, and then its value.
std::size_t length_place(const std::string& file, const std::string& name,
                         const std::string& type) {
  const std::string both = name + '\0' + type + '\0';
  const std::size_t place = file.find(both);
  EXPECT_NE(place, std::string::npos);
  return place + both.size();
}

void expect_refused(const TemporaryFolder& folder, const std::string& bytes,
                    const std::string& reason) {
  const auto path = folder / "damaged.exr";
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_THAT([&] { (void)read_image_info(path); },
              ThrowsMessage<DataError>(AllOf(HasSubstr("damaged.exr"), HasSubstr(reason))));
  EXPECT_THAT([&] { (void)read_image(path); }, ThrowsMessage<DataError>(HasSubstr(reason)));
  EXPECT_THAT([&] { (void)read_linear_image(path, {}); },
              ThrowsMessage<DataError>(HasSubstr(reason)));
}

TEST(ExrHeader, OfAWholeFileIsReadByTheLibrary) {
  const TemporaryFolder folder;
  (void)picture_bytes(folder);
  EXPECT_EQ(read_image_info(folder / "whole.exr").metadata.at("splotchcl:scene"), "a scene");
}

TEST(ExrHeader, ThatClaimsALongerTextThanTheFileIsRefused) {
  const TemporaryFolder folder;
  std::string file = picture_bytes(folder);
  const std::size_t place = length_place(file, "splotchcl:scene", "string");
  file.replace(place, 4, bytes_of_number(0x676B2000));
  expect_refused(folder, file, "it claims 1735073792 bytes for \"splotchcl:scene\"");
  file.replace(place, 4, bytes_of_number(0xFFFFFFFF));
  expect_refused(folder, file, "it claims -1 bytes");
}

TEST(ExrHeader, ThatClaimsMoreLinesThanTheFileHasRoomForIsRefused) {
  const TemporaryFolder folder;
  std::string file = picture_bytes(folder);
  const std::size_t window = length_place(file, "dataWindow", "box2i") + 4;
  file.replace(window + 12, 4, bytes_of_number(0x40000000));
  expect_refused(folder, file, "it claims 1073741825 lines");
}

TEST(ExrHeader, WithAPreviewOfAnotherSizeIsRefused) {
  const TemporaryFolder folder;
  std::string file = picture_bytes(folder);
  const std::string preview = std::string("preview") + '\0' + "preview" + '\0' +
                              bytes_of_number(12) + bytes_of_number(30000) +
                              bytes_of_number(30000) + "abcd";
  file.insert(8, preview);
  expect_refused(folder, file, "a preview of 30000x30000 pixels in 12 bytes");
}

TEST(ExrHeader, CutAtAnyByteIsRefused) {
  const TemporaryFolder folder;
  const std::string file = picture_bytes(folder);
  const std::size_t header_end = length_place(file, "splotchcl:scene", "string");
  for (std::size_t bytes = 8; bytes < header_end; ++bytes) {
    const auto path = folder / "cut.exr";
    std::ofstream(path, std::ios::binary | std::ios::trunc) << file.substr(0, bytes);
    EXPECT_THROW((void)read_image_info(path), DataError) << bytes;
  }
}

}  // namespace
}  // namespace splotchcl
