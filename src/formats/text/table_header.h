#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace splotchcl {

// The words of a line as names of columns; none where they are not as many as wanted. The first
// may be empty: tables of data frames begin with a column of row numbers that has no name.
std::vector<std::string> names_of_columns(std::string_view line, std::size_t wanted);

// As above, where a tab or blank before the first name stands for an empty one.
std::vector<std::string> names_in_line(std::string_view line, bool begins_with_blank,
                                       std::size_t wanted);

// Names of columns as other programs write them, in our words: without the column's number, as in
// AHF's Xc(6); Points:0 of ParaView becomes "Points x"; Xc, Yc and Zc are x, y and z.
std::vector<std::string> in_our_words(std::vector<std::string> names);

// The units that Rockstar states in comments for its positions, radii, masses and velocities.
void add_rockstar_units(const std::vector<std::string_view>& comments,
                        std::vector<std::string>& names);

// The units in a line below that of the names, where all of its words are such: "kpc kpc kpc Msun",
// "[kpc], [kpc], [kpc], -". False where it is another line.
bool add_units_below(std::string_view line, std::vector<std::string>& names);

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

// As Phantom writes them, with their numbers: "[01  time] [02  ekin]". Empty where they are not.
std::vector<std::string> names_in_brackets(std::string_view line);

// Words apart by two or more blanks, which may have single blanks in them.
std::vector<std::string> words_far_apart(std::string_view line);

}  // namespace splotchcl
