#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splotchcl {

// Where to load a module from, as an absolute path: beside the program or library that this is part
// of, or where an installation has it. Never by its name alone, which the loader would look for in
// folders that the environment names. Where it is in neither place, where it is expected. Throws
// DataError where the system does not say where the program lies.
std::string module_file(const std::string& module_name);

// What a module exports by this name. It is never unloaded: many of the libraries that come along
// cannot be. `needed_by` begins the message of the DataError where it cannot be loaded, `advice`
// ends it.
enum class ModuleSymbols { own, global };  // global: for plugins of the module's libraries
void* module_entry(const std::string& module_name, const char* entry_name,
                   const std::string& needed_by, const std::string& advice,
                   ModuleSymbols symbols = ModuleSymbols::own);

// The file, as an absolute path, whose code or data lies at this address. Throws as above.
std::filesystem::path file_mapped_at(const void* address);
// Folders to look for modules in, for a program or a library in `own_folder`.
std::vector<std::filesystem::path> module_places(const std::filesystem::path& own_folder);

}  // namespace splotchcl
