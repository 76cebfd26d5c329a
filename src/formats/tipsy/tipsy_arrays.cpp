#include "formats/tipsy/tipsy_arrays.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "formats/stored_values.h"
#include "snapshot/field_names.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

std::string_view content(const MappedFile& file) {
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

// Takes the next word off a text; empty at its end.
std::string_view take_word(std::string_view& text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  const std::size_t end = std::min(text.find_first_of(blanks, first), text.size());
  const std::string_view word = text.substr(first, end - first);
  text.remove_prefix(end);
  return word;
}

bool begins_with_number(std::string_view text, std::uint64_t wanted) {
  const std::string_view word = take_word(text);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() && number == wanted;
}

// Whether the text goes on after its first number and a word for each particle.
bool has_more_words(std::string_view text, std::uint64_t particles) {
  for (std::uint64_t i = 0; i < particles + 1; ++i) {
    if (take_word(text).empty()) return false;
  }
  return !take_word(text).empty();
}

// Codes write identifiers as integers and all else as floats, and do not say which.
ValueKind kind_of(const TipsyArray& array) {
  return canonical_field_name(array.name) == "id" ? ValueKind::uint32 : ValueKind::float32;
}

StoredValues stored_values(const TipsyArray& array, std::uint64_t first, std::uint64_t count) {
  StoredValues values;
  values.file = array.file;
  values.offset = 4 + 4 * first;
  values.particles = count;
  values.kind = kind_of(array);
  values.is_swapped = array.is_swapped;
  return values;
}

// Calls use(word) for the values of the particles.
template <typename Use>
void for_words(const TipsyArray& array, std::uint64_t first, std::uint64_t count, Use&& use) {
  std::string_view text = content(*array.file);
  take_word(text);
  for (std::uint64_t i = 0; i < first + count; ++i) {
    const std::string_view word = take_word(text);
    if (i < first && !word.empty()) continue;
    if (!word.empty() && use(word)) continue;
    throw DataError(fmt::format(
        "{}: found {} as value {}, expected a number; the array is truncated or damaged: write it "
        "again",
        array.file->path().string(),
        word.empty() ? "the end of the file" : fmt::format("'{}'", word.substr(0, 40)), i + 1));
  }
}

}  // namespace

std::vector<TipsyArray> find_tipsy_arrays(const fs::path& path, std::uint64_t particles,
                                          bool is_swapped, std::vector<std::string>& notes) {
  const std::string prefix = path.filename().string() + ".";
  const fs::path folder = path.parent_path().empty() ? "." : path.parent_path();
  std::vector<TipsyArray> arrays;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    const bool is_beside = name.size() > prefix.size() &&
                           name.compare(0, prefix.size(), prefix) == 0 &&
                           entry->is_regular_file(ignored);
    if (!is_beside) continue;
    TipsyArray array;
    array.name = name.substr(prefix.size());
    try {
      array.file = MappedFile::open(entry->path());
    } catch (const DataError& failure) {
      notes.push_back(fmt::format("array {} left out: {}", name, failure.what()));
      continue;
    }
    array.is_swapped = is_swapped;
    const std::uint64_t size = array.file->size();
    array.is_text = begins_with_number(content(*array.file), particles);
    const bool is_binary =
        !array.is_text && size >= 4 &&
        number_at(array.file, 0, ValueKind::uint32, is_swapped) == static_cast<double>(particles);
    if (is_binary && size != 4 + 4 * particles) {
      notes.push_back(
          fmt::format("array {} left out: it has {} bytes, expected {} of one number per particle",
                      name, size, 4 + 4 * particles));
      continue;
    }
    if (array.is_text && has_more_words(content(*array.file), particles)) {
      notes.push_back(
          fmt::format("array {} left out: it has more than {} numbers, expected one per particle",
                      name, particles));
      continue;
    }
    if (array.is_text || is_binary) {
      arrays.push_back(std::move(array));
    } else if (!canonical_field_name(array.name).empty()) {
      notes.push_back(
          fmt::format("array {} left out: it does not begin with the number of particles, {}", name,
                      particles));
    }
  }
  std::sort(arrays.begin(), arrays.end(),
            [](const TipsyArray& a, const TipsyArray& b) { return a.name < b.name; });
  return arrays;
}

Column read_tipsy_array(const TipsyArray& array, std::uint64_t first, std::uint64_t count,
                        double factor) {
  std::vector<float> values;
  if (!array.is_text) {
    const Column column = make_column({stored_values(array, first, count)});
    if (factor == 1) return column;
    values.assign(column.data(), column.data() + column.size());
    for (float& value : values)
      value = static_cast<float>(static_cast<double>(value) * factor);
    return Column::owning(std::move(values));
  }
  for_words(array, first, count, [&](std::string_view word) {
    double value = 0;
    const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return false;
    values.push_back(static_cast<float>(value * factor));
    return true;
  });
  return Column::owning(std::move(values));
}

std::optional<std::vector<std::uint64_t>> read_tipsy_integers(const TipsyArray& array,
                                                              std::uint64_t first,
                                                              std::uint64_t count) {
  if (!array.is_text) return make_integers({stored_values(array, first, count)});
  std::vector<std::uint64_t> values;
  bool are_integers = true;
  for_words(array, first, count, [&](std::string_view word) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    are_integers = are_integers && error == std::errc() && end == word.data() + word.size();
    values.push_back(value);
    return true;
  });
  if (!are_integers) return std::nullopt;
  return values;
}

}  // namespace splotchcl
