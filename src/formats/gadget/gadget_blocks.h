#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/mapped_file.h"
#include "formats/gadget/gadget_header.h"
#include "formats/stored_values.h"

namespace splotchcl {

// Particle types as bits: bit t stands for type t.
using TypeSet = unsigned;

// What a block of format 1 or 2 holds. The file says only its label and length.
struct BlockLayout {
  TypeSet types = 0;
  int values_per_particle = 1;
  ValueKind kind = ValueKind::float32;
};

// What an INFO block says about another block.
struct BlockDescription {
  std::string label;
  BlockLayout layout;
};

struct StandardBlock;

// Finds out, from lengths and the header's counts, which types a block is for, whether it
// holds scalars or 3-vectors, and in which precision.
class BlockLayouts {
 public:
  // `vector_bytes` is the length of the block of velocities or positions, which decides which
  // precision is tried first.
  BlockLayouts(const GadgetHeader& header, std::uint64_t vector_bytes,
               std::vector<BlockDescription> descriptions = {});

  // Whether `bytes` is right for a block of this standard label: of the types that have it in
  // most codes or, `or_all`, of all types; rather in the precision of these vectors.
  std::optional<BlockLayout> fit_standard(std::string_view label, std::uint64_t bytes,
                                          bool or_all = false) const;

  // Whether it is as long as one for fewer particles in the other precision, as most codes write.
  bool may_be_of_fewer(std::string_view label, const BlockLayout& layout) const;

  // As the INFO block says, where its words agree with the length.
  std::optional<BlockLayout> fit_description(std::string_view label, std::uint64_t bytes) const;

  // Any set of types and shape that fits. `is_ambiguous` tells that others fit as well.
  std::optional<BlockLayout> fit_any(std::uint64_t bytes, bool& is_ambiguous) const;

  // Whether some type has no mass in the header's table.
  bool needs_masses() const { return without_table_mass_ != 0; }

  std::uint64_t particles_in(TypeSet types) const;

 private:
  std::optional<BlockLayout> fit(std::uint64_t bytes, TypeSet types, int values,
                                 bool is_wide) const;
  TypeSet types_of(const StandardBlock& block) const;
  std::optional<BlockLayout> fit_ids(std::uint64_t bytes) const;
  std::optional<BlockLayout> fit_carriers(std::string_view label, std::uint64_t bytes, bool is_wide,
                                          bool or_all) const;
  std::vector<TypeSet> candidate_sets() const;

  std::vector<std::uint64_t> counts_;
  TypeSet present_ = 0;
  TypeSet without_table_mass_ = 0;
  bool is_double_ = false;
  std::vector<BlockDescription> descriptions_;
};

// Whether the label is one of those whose length must agree with the header.
bool is_standard_block(std::string_view label);

// A record between two marks: the label is empty in format 1.
struct GadgetRecord {
  std::string label;  // without trailing blanks
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

// One file of Gadget format 1 or 2, taken apart but not yet understood.
struct GadgetBinaryFile {
  std::shared_ptr<const MappedFile> file;
  int format = 1;
  bool is_swapped = false;
  GadgetHeader header;
  std::vector<GadgetRecord> records;  // without the header
};

bool is_gadget_binary(const MappedFile& file);

// Throws DataError when the file is truncated or its record marks disagree.
GadgetBinaryFile read_gadget_records(std::shared_ptr<const MappedFile> file);

// A record that has been understood as a field of some particle types.
struct GadgetBlock {
  std::string label;
  std::uint64_t offset = 0;
  BlockLayout layout;
};

// Where the header counts no particles at all, takes their number from the block of positions,
// with a note.
void count_by_blocks(GadgetBinaryFile& file, std::vector<std::string>& notes);

// What the records of a file hold. Records that fit no particle types are left out and
// named in `notes`. Throws DataError when there are no positions, or when the length of a
// standard block contradicts the header.
std::vector<GadgetBlock> understand_records(const GadgetBinaryFile& file,
                                            std::vector<std::string>& notes);

}  // namespace splotchcl
