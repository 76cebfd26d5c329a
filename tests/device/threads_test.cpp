// Renderers may be made and used by several threads at once, one thread each.
#include <thread>

#include "device/opencl/device_context.h"
#include "device/pictures.h"
#include "testing.h"

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

// The device draws one frame at a time; what is planned and checked meanwhile is another's.
TEST(Threads, DrawWithOneRenderer) {
  std::vector<Frame> frames;
  for (int width = 40; width < 48; ++width)
    frames.push_back(frame_of(width, 30, {random_clouds({60, 40, 30})}));
  std::vector<Image> images(frames.size());
  std::vector<RenderStats> stats(frames.size());
  Renderer renderer;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < frames.size(); ++i)
    threads.emplace_back([&, i] { images[i] = renderer.render(frames[i], stats[i]); });
  for (std::thread& thread : threads)
    thread.join();
  Renderer alone;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(images[i].pixels, alone.render(frames[i]).pixels) << "of thread " << i;
    EXPECT_EQ(stats[i].check.errors_of_promise, alone.stats().check.errors_of_promise) << i;
    EXPECT_EQ(stats[i].tile_entries, alone.stats().tile_entries) << i;
  }
}

// Work of any length on a queue of a DeviceContext.
class Turning {
 public:
  void run(std::size_t items, std::size_t group_items, std::uint32_t times) {
    kernel_.set_args(turned_, times);
    device_.queue.enqueue_1d_range_kernel(kernel_, 0, items, group_items);
    device_.queue.flush();
  }
  void finish() { device_.queue.finish(); }

  static constexpr std::size_t most_items = 128;

 private:
  static constexpr char source[] = R"(
    kernel void turn(global uint* turned, uint times) {
      uint value = (uint)get_global_id(0);
      for (uint i = 0; i < times; ++i) value = value * 1664525u + (value >> 3);
      turned[get_global_id(0)] = value;
    })";
  DeviceContext device_{choose_device("")};
  compute::kernel kernel_{compute::program::build_with_source(source, device_.context), "turn"};
  compute::buffer turned_{device_.context, most_items * sizeof(std::uint32_t)};
};

// PoCL 3.1 ends the program, in most runs of this, where these are queues of their own
// (device_context.h): while the first one keeps its threads busy, it begins a kernel twice for some
// work-groups and then for one more, and counts all that end as users of the last.
TEST(Threads, RunOneKernelForMoreAndMoreGroupsAtTheSameTime) {
  Turning busy, first, second, larger;
  for (std::size_t groups = 1; groups < Turning::most_items; ++groups) {
    busy.run(Turning::most_items, 2, 10'000);
    first.run(groups, 1, 1);
    second.run(groups, 1, 1);
    larger.run(groups + 1, 1, 1);
    for (Turning* const turning : {&busy, &first, &second, &larger})
      turning->finish();
  }
}

}  // namespace
}  // namespace splotchcl::test
