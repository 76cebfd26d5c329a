#include "formats/numpy/numpy_array.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/snapshot_format.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// What Python writes for texts, whole numbers, True and False, and for tuples, lists and
// dictionaries of them: the headers of NumPy's arrays.
struct PythonLiteral {
  enum class Kind { text, integer, boolean, sequence, dictionary };
  Kind kind = Kind::text;
  std::string text;
  std::uint64_t integer = 0;
  bool is_true = false;
  std::vector<PythonLiteral> items;                            // of a tuple or list
  std::vector<std::pair<std::string, PythonLiteral>> entries;  // of a dictionary

  const PythonLiteral* find(std::string_view key) const;  // null where there is none
};

class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  std::optional<PythonLiteral> parse_all() {
    auto literal = parse(0);
    skip_blanks();
    return literal && rest_.empty() ? std::move(literal) : std::nullopt;
  }

 private:
  static constexpr int deepest = 16;

  void skip_blanks() {
    const std::size_t first = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
  }
  bool take(char c) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool take_word(std::string_view word) {
    if (rest_.substr(0, word.size()) != word) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  std::optional<PythonLiteral> parse(int depth) {
    if (depth > deepest) return std::nullopt;
    if (take('{')) return parse_dictionary(depth);
    if (take('(')) return parse_sequence(')', depth);
    if (take('[')) return parse_sequence(']', depth);
    if (take('\'')) return parse_text('\'');
    if (take('"')) return parse_text('"');
    PythonLiteral literal;
    literal.kind = PythonLiteral::Kind::boolean;
    literal.is_true = take_word("True");
    if (literal.is_true || take_word("False")) return literal;
    return parse_integer();
  }

  std::optional<PythonLiteral> parse_text(char quote) {
    const std::size_t end = rest_.find(quote);
    if (end == std::string_view::npos) return std::nullopt;
    PythonLiteral literal;
    literal.text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return literal;
  }

  std::optional<PythonLiteral> parse_integer() {
    PythonLiteral literal;
    literal.kind = PythonLiteral::Kind::integer;
    const auto [end, error] =
        std::from_chars(rest_.data(), rest_.data() + rest_.size(), literal.integer);
    if (error != std::errc()) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    if (!rest_.empty() && rest_.front() == 'L') rest_.remove_prefix(1);  // of Python 2
    return literal;
  }

  std::optional<PythonLiteral> parse_sequence(char close, int depth) {
    PythonLiteral sequence;
    sequence.kind = PythonLiteral::Kind::sequence;
    while (!take(close)) {
      auto item = parse(depth + 1);
      if (!item) return std::nullopt;
      sequence.items.push_back(std::move(*item));
      if (take(',')) continue;
      if (!take(close)) return std::nullopt;
      break;
    }
    return sequence;
  }

  std::optional<PythonLiteral> parse_dictionary(int depth) {
    PythonLiteral dictionary;
    dictionary.kind = PythonLiteral::Kind::dictionary;
    while (!take('}')) {
      auto key = parse(depth + 1);
      if (!key || key->kind != PythonLiteral::Kind::text || !take(':')) return std::nullopt;
      auto value = parse(depth + 1);
      if (!value) return std::nullopt;
      dictionary.entries.emplace_back(std::move(key->text), std::move(*value));
      if (take(',')) continue;
      if (!take('}')) return std::nullopt;
      break;
    }
    return dictionary;
  }

  std::string_view rest_;
};

const PythonLiteral* PythonLiteral::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

// None where the text is nothing of that, or nested deeper than any header is.
std::optional<PythonLiteral> parse_python_literal(std::string_view text) {
  return Parser(text).parse_all();
}

constexpr char magic[] = {'\x93', 'N', 'U', 'M', 'P', 'Y'};

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw DataError(
      fmt::format("{}: {}; the file is truncated or damaged: write it again", name, what));
}

struct KindName {
  std::string_view code;
  ValueKind kind;
};
constexpr KindName kind_names[] = {
    {"f2", ValueKind::float16}, {"f4", ValueKind::float32}, {"f8", ValueKind::float64},
    {"i1", ValueKind::int8},    {"i2", ValueKind::int16},   {"i4", ValueKind::int32},
    {"i8", ValueKind::int64},   {"u1", ValueKind::uint8},   {"u2", ValueKind::uint16},
    {"u4", ValueKind::uint32},  {"u8", ValueKind::uint64},  {"b1", ValueKind::uint8}};

// "<f4": endianness, kind, bytes. Kinds that are not read still have a length.
NumpyMember parse_type(const std::string& text, const std::string& name) {
  NumpyMember member;
  if (text == "|O") {
    member.is_object = true;
    member.bytes = 8;  // in memory
    return member;
  }
  if (text.size() < 3) fail(name, fmt::format("the type '{}' is not one of NumPy's", text));
  const bool is_big = text[0] == '>';
  const std::string_view code = std::string_view(text).substr(1);
  for (const KindName& known : kind_names) {
    if (known.code != code) continue;
    member.kind = known.kind;
    member.is_usable = true;
    member.is_truth = code == "b1";
  }
  const char* const end = code.data() + code.size();
  const auto [stop, error] = std::from_chars(code.data() + 1, end, member.bytes);
  // Dates have a unit after their length: M8[ns].
  const bool is_length = error == std::errc() && (stop == end || *stop == '[');
  constexpr std::uint64_t longest = 1U << 20;
  if (!is_length || member.bytes > longest) {
    fail(name, fmt::format("the type '{}' is not one of NumPy's", text));
  }
  if (code[0] == 'U') member.bytes *= 4;
  if (member.is_usable) member.is_swapped = is_big == is_little_endian_host() && text[0] != '|';
  if (member.bytes == 1) member.is_swapped = false;
  return member;
}

std::uint64_t multiply(std::uint64_t a, std::uint64_t b, const std::string& name) {
  std::uint64_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) fail(name, "the array's shape overflows");
  return product;
}

std::vector<std::uint64_t> parse_shape(const PythonLiteral& literal, const std::string& name) {
  std::vector<std::uint64_t> shape;
  if (literal.kind == PythonLiteral::Kind::integer) return {literal.integer};
  if (literal.kind != PythonLiteral::Kind::sequence) fail(name, "the array's shape is no tuple");
  for (const PythonLiteral& side : literal.items) {
    if (side.kind != PythonLiteral::Kind::integer)
      fail(name, "the array's shape is not of numbers");
    shape.push_back(side.integer);
  }
  return shape;
}

[[noreturn]] void refuse_arrays_of_records(const std::string& name, const std::string& member) {
  throw DataError(fmt::format(
      "{}: the member {} of its records is an array of records, expected numbers; save its numbers "
      "as arrays of their own",
      name, member));
}

// ("name", "<f4") or ("name", "<f4", (3,)), or records in the record: ("name", [("x", "<f4")]),
// whose members are name.x. The name may be ("title", "name").
void add_members(const PythonLiteral& literal, const std::string& outer, const std::string& name,
                 std::vector<NumpyMember>& members) {
  using Kind = PythonLiteral::Kind;
  const bool is_member =
      literal.kind == Kind::sequence && literal.items.size() >= 2 && literal.items.size() <= 3;
  if (!is_member) fail(name, "a member of its records has no name and type");
  const PythonLiteral* label = &literal.items[0];
  if (label->kind == Kind::sequence && label->items.size() == 2) label = &label->items[1];
  if (label->kind != Kind::text) fail(name, "a member of its records has no name");
  const std::string path = label->text.empty() ? std::string() : outer + label->text;
  const PythonLiteral& type = literal.items[1];
  const bool has_shape = literal.items.size() > 2;
  if (type.kind == Kind::sequence) {
    if (has_shape) refuse_arrays_of_records(name, path);
    for (const PythonLiteral& inner : type.items)
      add_members(inner, path + ".", name, members);
    return;
  }
  if (type.kind != Kind::text) fail(name, "a member of its records has no type");
  NumpyMember member = parse_type(type.text, name);
  member.name = path;
  if (has_shape) {
    for (const std::uint64_t side : parse_shape(literal.items[2], name))
      member.values = multiply(member.values, side, name);
  }
  members.push_back(std::move(member));
}

void read_types(const PythonLiteral& literal, const std::string& name, NumpyHeader& header) {
  if (literal.kind == PythonLiteral::Kind::text) {
    header.members = {parse_type(literal.text, name)};
  } else if (literal.kind == PythonLiteral::Kind::sequence) {
    header.is_structured = true;
    for (const PythonLiteral& item : literal.items)
      add_members(item, "", name, header.members);
  } else {
    fail(name, "its header has no type of values");
  }
  for (NumpyMember& member : header.members) {
    member.offset = header.record_bytes;
    header.is_pickled = header.is_pickled || member.is_object;
    const std::uint64_t bytes = multiply(member.bytes, member.values, name);
    if (__builtin_add_overflow(header.record_bytes, bytes, &header.record_bytes)) {
      fail(name, "the length of its records overflows");
    }
  }
  if (header.record_bytes == 0) fail(name, "its records have no bytes");
}

const PythonLiteral& require(const PythonLiteral& dictionary, const char* key,
                             const std::string& name) {
  const PythonLiteral* const found = dictionary.find(key);
  if (found == nullptr) fail(name, fmt::format("its header has no '{}'", key));
  return *found;
}

}  // namespace

bool is_numpy_array(const std::byte* data, std::uint64_t size) {
  return size >= sizeof magic && std::memcmp(data, magic, sizeof magic) == 0;
}

NumpyHeader read_numpy_header(const std::byte* data, std::uint64_t size, std::uint64_t file_size,
                              const std::string& name) {
  const auto byte = [&](std::uint64_t at) { return std::to_integer<std::uint32_t>(data[at]); };
  constexpr std::uint64_t shortest = 12;
  if (!is_numpy_array(data, size) || size < shortest) fail(name, "no header of a NumPy array");
  const std::uint32_t version = byte(6);
  if (version < 1 || version > 3) {
    fail(name, fmt::format("version {} of NumPy's format, expected 1, 2 or 3", version));
  }
  const std::uint64_t start = version == 1 ? 10 : 12;
  std::uint64_t length = byte(8) + (byte(9) << 8);
  if (version > 1) length += (byte(10) << 16) + (std::uint64_t{byte(11)} << 24);
  if (length > size - start) {
    fail(name, fmt::format("a header of {} bytes, but only {} are there", length, size - start));
  }
  const std::string text(reinterpret_cast<const char*>(data) + start, length);
  const std::optional<PythonLiteral> literal = parse_python_literal(text);
  if (!literal) fail(name, "its header cannot be understood");
  NumpyHeader header;
  header.data_offset = start + length;
  read_types(require(*literal, "descr", name), name, header);
  header.shape = parse_shape(require(*literal, "shape", name), name);
  header.is_fortran_order = require(*literal, "fortran_order", name).is_true;
  std::uint64_t bytes = header.record_bytes;
  for (const std::uint64_t side : header.shape)
    bytes = multiply(bytes, side, name);
  if (!header.is_pickled && file_size - header.data_offset != bytes) {
    fail(name, fmt::format("{} bytes of values, expected {} for an array of shape ({})",
                           file_size - header.data_offset, bytes, fmt::join(header.shape, ", ")));
  }
  return header;
}

bool is_numpy_file(const std::filesystem::path& path) {
  const auto file = MappedFile::open(path);
  return is_numpy_array(file->data(), file->size());
}

std::vector<std::uint64_t> read_numpy_integers(const std::filesystem::path& path) {
  const auto file = MappedFile::open(path);
  const NumpyHeader header =
      read_numpy_header(file->data(), file->size(), file->size(), path.string());
  const NumpyMember& values = header.members.front();
  if (values.is_truth) {
    throw DataError(path.string() +
                    ": found a mask of true and false, expected the identifiers of the particles "
                    "that are wanted; save ids[mask] instead");
  }
  const bool is_list = !header.is_structured && values.is_usable && header.shape.size() == 1;
  if (is_list) {
    StoredValues stored;
    stored.file = file;
    stored.offset = header.data_offset;
    stored.particles = header.rows();
    stored.kind = values.kind;
    stored.is_swapped = values.is_swapped;
    if (auto numbers = make_integers({stored})) return std::move(*numbers);
  }
  throw DataError(fmt::format(
      "{}: not an array of whole numbers in one dimension, as was expected; save it as such, for "
      "example with numpy.save(name, ids.astype(\"u8\").ravel())",
      path.string()));
}

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what,
                       const std::string& reason) {
  throw DataError(
      fmt::format("{}: {}: {}; the archive is truncated or damaged: copy or write it again",
                  path.string(), what, reason));
}

zip_t* handle(void* archive) {
  return static_cast<zip_t*>(archive);
}

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

}  // namespace

void ZipArchive::Close::operator()(void* archive) const {
  zip_discard(handle(archive));
}

ZipArchive::ZipArchive(const std::filesystem::path& path) : path_(path) {
  int code = 0;
  archive_.reset(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive_) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    fail(path, "the zip archive cannot be opened", reason);
  }
  const zip_int64_t count = zip_get_num_entries(handle(archive_.get()), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t status;
    zip_stat_init(&status);
    const auto index = static_cast<zip_uint64_t>(i);
    constexpr zip_uint64_t needed = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
    const bool is_known = zip_stat_index(handle(archive_.get()), index, 0, &status) == 0 &&
                          (status.valid & needed) == needed;
    if (!is_known) fail(path_, fmt::format("entry {}", i), "it has no name or length");
    if (status.size / best_packing_of_deflate > status.comp_size) {
      fail(path_, status.name,
           fmt::format("{} bytes cannot come out of {}", status.size, status.comp_size));
    }
    entries_.push_back({status.name, index, status.size});
  }
}

std::vector<std::byte> ZipArchive::read(const Entry& entry, std::uint64_t bytes) const {
  const std::unique_ptr<zip_file_t, CloseEntry> file(
      zip_fopen_index(handle(archive_.get()), entry.index, 0));
  if (!file) fail(path_, entry.name, zip_strerror(handle(archive_.get())));
  // Grown piece by piece: what the archive says of the length need not be true.
  constexpr std::uint64_t piece = 1U << 24;
  std::vector<std::byte> content;
  const std::uint64_t wanted = std::min(bytes, entry.bytes);
  while (content.size() < wanted) {
    const std::size_t have = content.size();
    const std::uint64_t more = std::min(piece, wanted - have);
    content.resize(have + more);
    const zip_int64_t got = zip_fread(file.get(), content.data() + have, more);
    if (got <= 0) {
      fail(path_, entry.name,
           got < 0 ? zip_file_strerror(file.get())
                   : fmt::format("it ends after {} of {} bytes", have, entry.bytes));
    }
    content.resize(have + static_cast<std::size_t>(got));
  }
  // At the end, and only there, libzip compares the checksum.
  std::byte beyond{};
  if (wanted == entry.bytes && zip_fread(file.get(), &beyond, 1) < 0) {
    fail(path_, entry.name, zip_file_strerror(file.get()));
  }
  return content;
}

}  // namespace splotchcl
