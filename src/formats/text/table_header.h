#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace splotchcl {

// Names of columns as other programs write them, in our words: without the column's number, as in
// AHF's Xc(6); Points:0 of ParaView becomes "Points x"; Xc, Yc and Zc are x, y and z.
std::vector<std::string> in_our_words(std::vector<std::string> names);

// Adds the units that a header of astropy (ECSV) states for each column, from its comments:
// - {name: x, unit: kpc, datatype: float64}. Names that have a unit keep it.
void add_ecsv_units(const std::vector<std::string_view>& comments, std::vector<std::string>& names);

// As SKIRT writes names, a comment for each column: "column 1: position x (kpc)". Empty unless
// there is one for each of so many columns.
std::vector<std::string> names_by_number(const std::vector<std::string_view>& comments,
                                         std::size_t columns);

// As SPLASH writes names, in columns of 16 letters of which the first is blank; units that it cuts
// short are left out.
std::vector<std::string> names_in_columns(std::string_view line);

// Words apart by two or more blanks, which may have single blanks in them.
std::vector<std::string> words_far_apart(std::string_view line);

}  // namespace splotchcl
