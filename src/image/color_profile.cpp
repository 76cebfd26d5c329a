#include "image/color_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

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

}  // namespace splotchcl
