#pragma once

#include <map>
#include <string>
#include <vector>

namespace splotchcl {

// The words of a line of a path file, between blanks or commas and up to a comment.
std::vector<std::string> path_words(std::string line);

// Whether a line names the columns.
bool is_path_header(const std::vector<std::string>& words);

// The columns of files that do not name them; the last may be missing.
const std::vector<std::string>& path_columns_without_header();

// The numbers of the first frame by the names of their columns, as far as the text has any.
std::map<std::string, double> first_path_row(const std::string& text);

}  // namespace splotchcl
