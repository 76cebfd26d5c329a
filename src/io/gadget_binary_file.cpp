#include "io/gadget_binary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

#include "io/stored_values.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::uint32_t header_bytes = 256;
constexpr std::uint32_t label_bytes = 8;  // four letters and the length of what follows
constexpr std::uint64_t mark_bytes = 4;

struct Recognised {
  int format;
  bool is_swapped;
};

std::optional<Recognised> recognise(const MappedFile& file) {
  if (file.size() < mark_bytes) return std::nullopt;
  std::uint32_t mark = 0;
  std::memcpy(&mark, file.data(), sizeof mark);
  for (const bool is_swapped : {false, true}) {
    const std::uint32_t value = is_swapped ? __builtin_bswap32(mark) : mark;
    if (value == header_bytes) return Recognised{1, is_swapped};
    if (value == label_bytes) return Recognised{2, is_swapped};
  }
  return std::nullopt;
}

// Reads numbers of the file's endianness at places inside the file.
class Numbers {
 public:
  Numbers(std::shared_ptr<const MappedFile> file, bool is_swapped)
      : file_(std::move(file)), is_swapped_(is_swapped) {}

  std::uint32_t uint32(std::uint64_t offset) const {
    return static_cast<std::uint32_t>(number_at(file_, offset, ValueKind::uint32, is_swapped_));
  }
  double float64(std::uint64_t offset) const {
    return number_at(file_, offset, ValueKind::float64, is_swapped_);
  }

 private:
  std::shared_ptr<const MappedFile> file_;
  bool is_swapped_;
};

class RecordWalker {
 public:
  RecordWalker(const MappedFile& file, const Numbers& numbers) : file_(file), numbers_(numbers) {}

  bool is_at_end() const { return position_ >= file_.size(); }

  GadgetRecord next() {
    if (file_.size() - position_ < mark_bytes) {
      throw DataError(
          fmt::format("{}: truncated: the file ends inside the record mark at byte {}; copy or "
                      "write the file again",
                      file_.path().string(), position_));
    }
    const std::uint32_t mark = numbers_.uint32(position_);
    const std::uint64_t available = file_.size() - position_;
    // Marks have 32 bits: a record of 4 GiB and more is as long as its mark says, plus a
    // multiple of 2^32. The closing mark tells which.
    constexpr std::uint64_t wrap = std::uint64_t{1} << 32;
    for (std::uint64_t bytes = mark; bytes + 2 * mark_bytes <= available; bytes += wrap) {
      if (numbers_.uint32(position_ + mark_bytes + bytes) != mark) continue;
      const GadgetRecord record = {"", position_ + mark_bytes, bytes};
      position_ += bytes + 2 * mark_bytes;
      return record;
    }
    throw_bad_record(mark, available);
  }

 private:
  [[noreturn]] void throw_bad_record(std::uint32_t mark, std::uint64_t available) const {
    if (mark + 2 * mark_bytes > available) {
      throw DataError(fmt::format(
          "{}: truncated: the record at byte {} should have {} bytes, but the file ends {} bytes "
          "after its start; copy or write the file again",
          file_.path().string(), position_, mark, available));
    }
    throw DataError(fmt::format(
        "{}: the record at byte {} opens with the length {} but closes with {}; the file is "
        "damaged or not in Gadget format",
        file_.path().string(), position_, mark, numbers_.uint32(position_ + mark_bytes + mark)));
  }

  const MappedFile& file_;
  const Numbers& numbers_;
  std::uint64_t position_ = 0;
};

std::string read_label(const MappedFile& file, const GadgetRecord& record) {
  if (record.bytes != label_bytes) {
    throw DataError(fmt::format(
        "{}: the record at byte {} has {} bytes where the 8 bytes of a block's label were "
        "expected; the file is damaged or not in Gadget format 2",
        file.path().string(), record.offset - mark_bytes, record.bytes));
  }
  std::string label(reinterpret_cast<const char*>(file.data()) + record.offset, 4);
  std::replace(label.begin(), label.end(), '\0', ' ');
  if (!std::all_of(label.begin(), label.end(), [](char c) { return c >= ' ' && c <= '~'; })) {
    throw DataError(fmt::format(
        "{}: the label at byte {} is not made of letters; the file is damaged or not in Gadget "
        "format 2",
        file.path().string(), record.offset));
  }
  label.erase(label.find_last_not_of(' ') + 1);
  return label;
}

GadgetHeader read_header(const GadgetRecord& record, const Numbers& numbers) {
  GadgetHeader header;
  const std::uint64_t start = record.offset;
  for (std::uint64_t type = 0; type < 6; ++type) {
    header.counts.push_back(numbers.uint32(start + 4 * type));
    header.table_masses.push_back(numbers.float64(start + 24 + 8 * type));
    const std::uint64_t high = numbers.uint32(start + 168 + 4 * type);
    header.total_counts.push_back((high << 32) + numbers.uint32(start + 96 + 4 * type));
  }
  header.time = numbers.float64(start + 72);
  header.redshift = numbers.float64(start + 80);
  header.has_star_formation = numbers.uint32(start + 88) == 1;
  header.has_cooling = numbers.uint32(start + 120) == 1;
  const std::uint32_t files = numbers.uint32(start + 124);
  header.files =
      static_cast<int>(std::min<std::uint32_t>(files, std::numeric_limits<std::int32_t>::max()));
  header.box_size = numbers.float64(start + 128);
  header.omega_matter = numbers.float64(start + 136);
  header.hubble_parameter = numbers.float64(start + 152);
  header.has_stellar_age = numbers.uint32(start + 160) == 1;
  header.has_metals = numbers.uint32(start + 164) == 1;
  return header;
}

void check_header_record(const MappedFile& file, int format, const GadgetRecord& record) {
  if (record.bytes == header_bytes && (format == 1 || record.label == "HEAD")) return;
  throw DataError(
      fmt::format("{}: the first block is '{}' with {} bytes; expected the header HEAD with {} "
                  "bytes: the file is damaged or not in Gadget format {}",
                  file.path().string(), record.label, record.bytes, header_bytes, format));
}

}  // namespace

bool is_gadget_binary(const MappedFile& file) {
  return recognise(file).has_value();
}

GadgetBinaryFile read_gadget_records(std::shared_ptr<const MappedFile> file) {
  const std::optional<Recognised> recognised = recognise(*file);
  if (!recognised) {
    throw DataError(fmt::format(
        "{}: not in Gadget format 1 or 2, as the other files of its snapshot are; check the name",
        file->path().string()));
  }
  const Numbers numbers(file, recognised->is_swapped);
  RecordWalker walker(*file, numbers);
  const auto next_block = [&] {
    if (recognised->format == 1) return walker.next();
    std::string label = read_label(*file, walker.next());
    GadgetRecord record = walker.next();
    record.label = std::move(label);
    return record;
  };
  GadgetBinaryFile result;
  result.format = recognised->format;
  result.is_swapped = recognised->is_swapped;
  const GadgetRecord header = next_block();
  check_header_record(*file, recognised->format, header);
  result.header = read_header(header, numbers);
  while (!walker.is_at_end())
    result.records.push_back(next_block());
  result.file = std::move(file);
  return result;
}

}  // namespace splotchcl
