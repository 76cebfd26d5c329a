#include "paths.h"

namespace splotchcl::test {

std::filesystem::path source_folder() {
  return SPLOTCHCL_SOURCE_DIR;
}

std::filesystem::path data_folder() {
  return SPLOTCHCL_TEST_DATA;
}

std::filesystem::path program_path() {
  return SPLOTCHCL_PROGRAM;
}

}  // namespace splotchcl::test
