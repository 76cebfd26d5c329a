#pragma once

#include <filesystem>

namespace splotchcl::test {

// Where this build lies, which only paths.cpp is compiled with: so a compiler's cache knows all
// other tests again in a clone that lies elsewhere.
std::filesystem::path source_folder();
std::filesystem::path data_folder();  // of real snapshots; may not exist
std::filesystem::path program_path();

}  // namespace splotchcl::test
