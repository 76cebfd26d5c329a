#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formula/formula.h"

namespace splotchcl {

// A condition as a formula; where it is none, as parse_comparisons() has it. `what`
// begins the message of the UsageError for a text that is none.
Formula parse_condition(const std::string& text, const std::string& what);

// The same of comparisons of fields with numbers, joined by "and" and "or": what stands before each
// comparison is the field's name, whatever it is made of. Nothing for other texts.
std::optional<Formula> parse_comparisons(const std::string& text);

// Completes "expected ...".
extern const char* const condition_form;

// The identifiers of a text file, one on a line, in increasing order and each once. Blank
// lines, and what follows a '#', do not count. Throws DataError for a file that cannot be
// read, a line that is not a whole number from 0 to 2^64 - 1, and a file without any. Numbers as
// NumPy's savetxt writes them, 1.2e+01, are taken as far as they are exact.
std::vector<std::uint64_t> read_id_list(const std::filesystem::path& path);

// Throws DataError for what is no list of identifiers but says of each particle whether it is
// wanted: nothing but 0 and 1, several times.
void refuse_mask(const std::vector<std::uint64_t>& ids, const std::filesystem::path& path);

}  // namespace splotchcl
