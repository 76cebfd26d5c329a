#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace splotchcl {

// Items 0 to `count` are done one by one, in this order: each by whoever is free first of the
// calling thread, which calls `here`, and of the `elsewhere`, each called in a thread of its own.
// One of these that returns false has not done its item, and gets no other. Returns when all items
// have been given out and ended. An exception of `here` is thrown when the others have ended the
// item that they are at; they throw none.
void share_work(std::size_t count, const std::function<void(std::size_t item)>& here,
                const std::vector<std::function<bool(std::size_t item)>>& elsewhere);

}  // namespace splotchcl
