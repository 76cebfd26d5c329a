#pragma once

namespace splotchcl::py {

class Module;

// The library's errors as exceptions of Python.
void add_errors(const Module& module);

// Tells Python what was thrown; to be called where an exception is handled.
void raise_what_was_thrown() noexcept;

}  // namespace splotchcl::py
