#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/gadget/gadget_header.h"
#include "formats/hdf5/hdf5_file.h"
#include "formats/hdf5/hdf5_units.h"

namespace splotchcl {

// Reads the group Header of Gadget 2 to 4, SWIFT and their relatives: attributes may be
// scalars or arrays of any length, and cosmology may be in other groups. Throws DataError.
GadgetHeader read_hdf5_header(const Hdf5File& file, std::vector<std::string>& notes);

// Also a part of one that was written without what SWIFT says of itself: its datasets have SWIFT's
// attributes.
bool is_swift_file(const Hdf5File& file);
// Whether it holds initial conditions for SWIFT, which name no code but have its units.
bool is_swift_start_file(const Hdf5File& file);
// "SWIFT HDF5", "SWIFT initial conditions", "GIZMO HDF5", "AREPO HDF5", or "Gadget HDF5" for Gadget
// and all others.
std::string hdf5_dialect(const Hdf5File& file);

// Whether the file says that the run does not follow the expansion.
bool is_without_cosmology(const Hdf5File& file);

// The cosmology and what the velocities are, where the run follows the expansion: from the
// header and the attributes of the datasets of positions and velocities (paths). Units that
// the file does not state are kpc/h and km/s.
std::optional<Cosmology> read_cosmology(const Hdf5File& file, const GadgetHeader& header,
                                        const std::string& positions,
                                        const std::string& velocities);

// The units the file states; zeros where it states none.
BaseUnits read_base_units(const Hdf5File& file);

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
