// Renderers may be made and used by several threads at once, one thread each.
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "device/pictures.h"

namespace splotchcl::test {
namespace {

// The first pictures of eight threads, which all find devices and compile at the same time.
TEST(Threads, MakeRenderersAndDrawAtTheSameTime) {
  const Frame frame = frame_of(40, 30, {random_clouds({60, 40, 30})});
  constexpr std::size_t thread_count = 8;
  std::vector<Image> images(thread_count);
  std::vector<std::string> failures(thread_count);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < thread_count; ++i) {
    threads.emplace_back([&, i] {
      try {
        Renderer renderer;
        images[i] = renderer.render(frame);
      } catch (const std::exception& error) {
        failures[i] = error.what();
      }
    });
  }
  for (std::thread& thread : threads)
    thread.join();
  const Image expected = Renderer().render(frame);
  for (std::size_t i = 0; i < thread_count; ++i) {
    EXPECT_EQ(failures[i], "");
    EXPECT_EQ(images[i].pixels, expected.pixels) << "of thread " << i;
  }
}

}  // namespace
}  // namespace splotchcl::test
