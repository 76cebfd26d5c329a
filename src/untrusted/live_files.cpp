#include <string>

#include "common/shrink_guard.h"
#include "splotchcl/error.h"
#include "splotchcl/untrusted_file.h"

namespace splotchcl {

LiveFiles::LiveFiles() {
  survive_cut_files();
  cut_before_ = cut_file_count();
}

void LiveFiles::require_whole() const {
  if (cut_file_count() == cut_before_) return;
  throw DataError(std::string(last_cut_file()) +
                  ": became shorter while it was read; wait until it is completely written and try "
                  "again");
}

}  // namespace splotchcl
