#include "film/movie/film_layout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// The boxes that MP4 and QuickTime files are made of: their length, a name of four letters, and
// what they hold.
using Bytes = std::vector<std::uint8_t>;

Bytes big_endian(std::uint32_t number) {
  Bytes bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  return bytes;
}

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

Bytes box(const std::string& name, const Bytes& content) {
  constexpr std::uint32_t header = 8;
  return joined({big_endian(static_cast<std::uint32_t>(content.size()) + header),
                 Bytes(name.begin(), name.end()), content});
}

// One with a version and flags, all 0.
Bytes full_box(const std::string& name, const Bytes& content) {
  return box(name, joined({big_endian(0), content}));
}

constexpr std::size_t header = 8;

std::uint64_t number_at(const Bytes& bytes, std::size_t place, std::size_t width) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < width; ++i)
    number = number << 8 | bytes.at(place + i);
  return number;
}

void put_number(Bytes& bytes, std::size_t place, std::size_t width, std::uint64_t number) {
  for (std::size_t i = width; i-- > 0; number >>= 8)
    bytes.at(place + i) = static_cast<std::uint8_t>(number);
}

// A box within bytes, from its header to its end.
struct Place {
  std::size_t begin = 0, end = 0;
};

std::string name_at(const Bytes& bytes, std::size_t begin) {
  const auto letters = bytes.begin() + static_cast<std::ptrdiff_t>(begin) + 4;
  return std::string(letters, letters + 4);
}

// Boxes one after the other, as far as they are whole.
std::vector<Place> boxes_in(const Bytes& bytes, std::size_t begin, std::size_t end) {
  std::vector<Place> places;
  while (begin + header <= end) {
    const std::uint64_t size = number_at(bytes, begin, 4);
    if (size < header || size > end - begin) break;
    places.push_back({begin, begin + static_cast<std::size_t>(size)});
    begin = places.back().end;
  }
  return places;
}

std::optional<Place> find(const Bytes& bytes, const Place& in, const std::string& name,
                          std::size_t skipped = header) {
  for (const Place& place : boxes_in(bytes, in.begin + skipped, in.end)) {
    if (name_at(bytes, place.begin) == name) return place;
  }
  return std::nullopt;
}

// The boxes from the one of the film's index down to that of the pictures' first description.
std::optional<std::vector<Place>> way_to_description(const Bytes& index) {
  constexpr std::size_t before_handler = header + 8, before_entries = header + 8;
  const Place movie = {0, index.size()};
  for (const Place& track : boxes_in(index, header, index.size())) {
    if (name_at(index, track.begin) != "trak") continue;
    const auto media = find(index, track, "mdia");
    const auto handler = media ? find(index, *media, "hdlr") : std::nullopt;
    if (!handler || name_at(index, handler->begin + before_handler - 4) != "vide") continue;
    const auto information = find(index, *media, "minf");
    const auto tables = information ? find(index, *information, "stbl") : std::nullopt;
    const auto descriptions = tables ? find(index, *tables, "stsd") : std::nullopt;
    if (!descriptions) continue;
    const auto entries = boxes_in(index, descriptions->begin + before_entries, descriptions->end);
    if (entries.empty()) continue;
    return std::vector<Place>{movie,   track,         *media,         *information,
                              *tables, *descriptions, entries.front()};
  }
  return std::nullopt;
}

// Frames lie farther back by so many bytes.
void move_chunks(Bytes& index, const Place& in, std::uint64_t by) {
  constexpr std::size_t before_numbers = header + 8;
  for (const Place& place : boxes_in(index, in.begin + header, in.end)) {
    const std::string name = name_at(index, place.begin);
    if (name == "trak" || name == "mdia" || name == "minf" || name == "stbl") {
      move_chunks(index, place, by);
    } else if (name == "stco" || name == "co64") {
      const std::size_t width = name == "stco" ? 4 : 8;
      for (std::size_t i = place.begin + before_numbers; i + width <= place.end; i += width)
        put_number(index, i, width, number_at(index, i, width) + by);
    }
  }
}

// The boxes of a file itself, with lengths of 64 bits.
struct FilePlace {
  std::string name;
  std::uint64_t begin = 0, end = 0;
};

std::vector<FilePlace> boxes_of(std::fstream& file, std::uint64_t size) {
  std::vector<FilePlace> places;
  std::uint64_t begin = 0;
  while (begin + header <= size) {
    Bytes start(2 * header);
    file.clear();
    file.seekg(static_cast<std::streamoff>(begin));
    file.read(reinterpret_cast<char*>(start.data()), static_cast<std::streamsize>(start.size()));
    std::uint64_t length = number_at(start, 0, 4);
    if (length == 1) length = number_at(start, header, 8);
    if (length == 0) length = size - begin;
    if (length < header || length > size - begin) break;
    places.push_back({name_at(start, 0), begin, begin + length});
    begin += length;
  }
  file.clear();
  return places;
}

// From `begin` to the end of the file, from the end on, so that nothing is overwritten unread.
void move_back(std::fstream& file, std::uint64_t begin, std::uint64_t end, std::uint64_t by) {
  constexpr std::uint64_t block = 1 << 20;
  std::vector<char> buffer(block);
  while (end > begin) {
    const std::uint64_t count = std::min(block, end - begin);
    end -= count;
    file.seekg(static_cast<std::streamoff>(end));
    file.read(buffer.data(), static_cast<std::streamsize>(count));
    file.seekp(static_cast<std::streamoff>(end + by));
    file.write(buffer.data(), static_cast<std::streamsize>(count));
  }
}

[[noreturn]] void refuse(const std::filesystem::path& film) {
  throw DataError(film.string() +
                  ": ffmpeg made a film that is not built as MP4 and QuickTime are, in which it "
                  "cannot be said that it is a panorama or of two eyes; choose .mkv");
}

// Puts boxes to the end of what the film says of its first track of pictures. Throws DataError
// where it is not built as expected, or cannot be written.
void add_to_video(const std::filesystem::path& film, const Bytes& boxes) {
  std::fstream file(film, std::ios::in | std::ios::out | std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(film);
  const std::vector<FilePlace> parts = boxes_of(file, size);
  const auto part = std::find_if(parts.begin(), parts.end(),
                                 [](const FilePlace& place) { return place.name == "moov"; });
  if (part == parts.end()) refuse(film);
  Bytes index(static_cast<std::size_t>(part->end - part->begin));
  file.seekg(static_cast<std::streamoff>(part->begin));
  file.read(reinterpret_cast<char*>(index.data()), static_cast<std::streamsize>(index.size()));
  const auto way = way_to_description(index);
  if (!way) refuse(film);
  const std::uint64_t added = boxes.size();
  if (part->end < size) move_chunks(index, {0, index.size()}, added);
  for (const Place& place : *way)
    put_number(index, place.begin, 4, place.end - place.begin + added);
  index.insert(index.begin() + static_cast<std::ptrdiff_t>(way->back().end), boxes.begin(),
               boxes.end());
  move_back(file, part->end, size, added);
  file.seekp(static_cast<std::streamoff>(part->begin));
  file.write(reinterpret_cast<const char*>(index.data()),
             static_cast<std::streamsize>(index.size()));
  file.flush();
  if (!file) throw DataError(film.string() + ": what players must know could not be written");
}

// Boxes do not tell squeezed pictures from others: players know them by their shape.
FilmLayout::Eyes eyes_of(StereoLayout layout) {
  switch (layout) {
    case StereoLayout::side_by_side:
    case StereoLayout::side_by_side_half:
      return FilmLayout::Eyes::side_by_side;
    case StereoLayout::top_bottom:
    case StereoLayout::top_bottom_half:
      return FilmLayout::Eyes::top_bottom;
    default:
      return FilmLayout::Eyes::one;
  }
}

}  // namespace

FilmLayout layout_of(const Scene& scene) {
  FilmLayout layout;
  if (scene.stereo) layout.eyes = eyes_of(scene.stereo->layout);
  if (!scene.camera || scene.camera->projection != Projection::equirectangular) return layout;
  const double width = field_of_view_degrees(*scene.camera);
  layout.panorama = {width, width * scene.image.height / scene.image.width};
  return layout;
}

bool can_tell(const std::filesystem::path& path, const FilmLayout& layout) {
  const std::string ending = lower_ending(path);
  return ending == ".mp4" || ending == ".mov" || !layout.panorama;
}

namespace {

// The part of a whole that is left out on each of two sides, as a fraction of 2^32.
std::uint32_t left_out(double shown, double whole) {
  constexpr double scale = 4294967296.0;
  const double part = std::clamp(0.5 * (1 - shown / whole), 0.0, 0.5);
  return static_cast<std::uint32_t>(std::lround(std::min(part * scale, scale - 1)));
}

Bytes stereo_box(FilmLayout::Eyes eyes) {
  Bytes mode = {0};
  if (eyes == FilmLayout::Eyes::top_bottom) mode = {1};
  if (eyes == FilmLayout::Eyes::side_by_side) mode = {2};
  return full_box("st3d", mode);
}

Bytes panorama_box(const FilmLayout::Panorama& panorama) {
  constexpr double around = 360, from_pole_to_pole = 180;
  const std::uint32_t beside = left_out(panorama.width, around);
  const std::uint32_t above = left_out(panorama.height, from_pole_to_pole);
  const std::string source = "splotchcl";
  Bytes name(source.begin(), source.end());
  name.push_back(0);
  const Bytes straight_ahead = joined({big_endian(0), big_endian(0), big_endian(0)});
  const Bytes bounds =
      joined({big_endian(above), big_endian(above), big_endian(beside), big_endian(beside)});
  const Bytes projection = joined({full_box("prhd", straight_ahead), full_box("equi", bounds)});
  return box("sv3d", joined({full_box("svhd", name), box("proj", projection)}));
}

}  // namespace

void write_layout(const std::filesystem::path& film, const FilmLayout& layout) {
  Bytes boxes = stereo_box(layout.eyes);
  if (layout.panorama) boxes = joined({boxes, panorama_box(*layout.panorama)});
  add_to_video(film, boxes);
}

}  // namespace splotchcl
