#pragma once

namespace splotchcl {

// Whether two threads may read snapshots at the same time: only where HDF5 was built for it.
bool can_read_concurrently();

}  // namespace splotchcl
