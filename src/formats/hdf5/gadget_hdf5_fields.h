#pragma once

#include <string>
#include <vector>

#include "formats/gadget/gadget_header.h"
#include "formats/hdf5/hdf5_file.h"

namespace splotchcl {

// A dataset of a particle type that can be a field.
struct Hdf5Field {
  std::string label;  // the dataset's name in its group
  int values_per_particle = 1;
  Hdf5Dataset dataset;
};

// The fields of group PartType<type>. Datasets that are neither numbers nor have one or
// three values per particle, and those that have not a row for each, are left out and named in
// `notes`.
std::vector<Hdf5Field> find_hdf5_fields(const Hdf5File& file, const GadgetHeader& header, int type,
                                        std::vector<std::string>& notes);

// Where the header counts no particles at all, takes the numbers of rows of the positions, with
// a note.
void count_rows_without_header(const Hdf5File& file, GadgetHeader& header,
                               std::vector<std::string>& notes);

// AREPO's tracers are marks on cells, without positions of their own: they do not count.
void leave_out_tracers(const Hdf5File& file, GadgetHeader& header, std::vector<std::string>& notes);

// The rows of the positions count where the header counts others, and a type without positions, or
// without its group, is left out: both with a note. Throws DataError when no type has positions.
void count_rows_of_positions(const Hdf5File& file, GadgetHeader& header,
                             std::vector<std::string>& notes);

}  // namespace splotchcl
