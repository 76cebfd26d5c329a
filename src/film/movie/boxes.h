#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace splotchcl {

// The boxes that MP4 and QuickTime files are made of: their length, a name of four letters, and
// what they hold.
using Bytes = std::vector<std::uint8_t>;

Bytes big_endian(std::uint32_t number);
Bytes joined(const std::vector<Bytes>& parts);
Bytes box(const std::string& name, const Bytes& content);
// One with a version and flags, all 0.
Bytes full_box(const std::string& name, const Bytes& content);

// Puts boxes to the end of what the film says of its first track of pictures. Throws DataError
// where it is not built as expected, or cannot be written.
void add_to_video(const std::filesystem::path& film, const Bytes& boxes);

}  // namespace splotchcl
