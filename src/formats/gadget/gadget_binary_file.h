#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/mapped_file.h"
#include "formats/gadget/gadget_header.h"

namespace splotchcl {

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

}  // namespace splotchcl
