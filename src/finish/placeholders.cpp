#include "finish/placeholders.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Values = fmt::dynamic_format_arg_store<fmt::format_context>;

std::string file_name(const SnapshotInfo& snapshot) {
  return snapshot.files.empty() ? "" : snapshot.files.front().filename().string();
}

// What stands for a redshift that is not known, to try the format itself.
constexpr double any_redshift = 1;

Values values_of(const SnapshotInfo& snapshot, int frame, bool with_unknown) {
  Values values;
  values.push_back(fmt::arg("time", snapshot.time));
  values.push_back(fmt::arg("frame", frame));
  values.push_back(fmt::arg("snapshot", file_name(snapshot)));
  if (snapshot.redshift || with_unknown) {
    const double redshift = snapshot.redshift.value_or(any_redshift);
    values.push_back(fmt::arg("redshift", redshift));
    values.push_back(fmt::arg("scale_factor", 1 / (1 + redshift)));
  }
  return values;
}

// Whether a placeholder asks for more letters than any number needs: {time:.999999999f}. A width
// that is a placeholder itself could be anything.
bool is_too_wide(const std::string& text) {
  constexpr int most_digits = 2;
  int depth = 0, digits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_twice = i + 1 < text.size() && text[i + 1] == c;
    if (depth == 0 && (c == '{' || c == '}') && is_twice) {
      ++i;  // the brace itself
      continue;
    }
    if (c == '{') ++depth;
    if (c == '}') depth = std::max(0, depth - 1);
    const bool is_digit = depth > 0 && std::isdigit(static_cast<unsigned char>(c)) != 0;
    digits = is_digit ? digits + 1 : 0;
    if (depth > 1 || digits > most_digits) return true;
  }
  return false;
}

}  // namespace

std::string replace_placeholders(const std::string& text, const SnapshotInfo& snapshot, int frame,
                                 const std::string& key) {
  if (is_too_wide(text)) {
    throw UsageError(fmt::format(
        "key {}: found \"{}\", expected placeholders with a width and a precision of at "
        "most 99, as in {{time:8.3f}}",
        key, text));
  }
  try {
    (void)fmt::vformat(text, values_of(snapshot, frame, true));
  } catch (const fmt::format_error& error) {
    throw UsageError(fmt::format(
        "key {}: found \"{}\" ({}), expected placeholders among {{time}}, {{redshift}}, "
        "{{scale_factor}}, {{frame}}, {{snapshot}}, with a format as in {{redshift:.2f}}; "
        "write braces as {{{{ and }}}}",
        key, text, error.what()));
  }
  try {
    return fmt::vformat(text, values_of(snapshot, frame, false));
  } catch (const fmt::format_error&) {
    throw UsageError(
        fmt::format("key {}: found \"{}\", but the snapshot {} has no redshift; use {{time}}", key,
                    text, file_name(snapshot)));
  }
}

}  // namespace splotchcl
