#include "formats/concurrent_reading.h"

#include <hdf5.h>

namespace splotchcl {

bool can_read_concurrently() {
  hbool_t is_safe = 0;
  return H5is_library_threadsafe(&is_safe) >= 0 && is_safe > 0;
}

}  // namespace splotchcl
