#pragma once

#include <memory>
#include <string>

namespace splotchcl::bench {

// What is done to a pixel, of three channels each: sums add to three planes. Ordered ones put
// opacity of one source before the light of three planes, as in the hour in which the original was
// measured. Layers have light and opacity, six planes, as the renderer has them.
enum class YardstickPlan { sums, ordered, layers };

// How fast this machine can add splats into image tiles right now, done by hand with the
// compiler's vectors of eight floats. Not a renderer: its splats lie in the lists of their
// tiles before the clock starts, and its exponential has a relative error of 2e-6. What a
// frame takes is judged by the ratio to this, measured in the same minute.
class YardstickScene {
 public:
  // Random splats of half to one and a half times this radius, sigma = radius / 1.8.
  YardstickScene(float mean_radius_pixels, int splat_count);
  ~YardstickScene();
  YardstickScene(YardstickScene&&) noexcept;

  double updates() const;  // pixels inside the splats' discs, three channels each
  void draw(YardstickPlan plan, int threads);

 private:
  struct Lists;
  std::unique_ptr<Lists> lists_;
};

struct YardstickCost {
  double additive_ns = 0;  // per pixel update, the best of several runs
  double ordered_ns = 0;
  double layers_ns = 0;
};

// One number for the machine of the moment: the costs of the two sizes that matter most in
// large snapshots, and their geometric mean in sums and in order.
struct Yardstick {
  YardstickCost small, large;  // 5 and 20 pixels
  int threads = 1;
  double additive_ns() const;
  double ordered_ns() const;
};
Yardstick measure_yardstick(int threads);
Yardstick mean_of(const Yardstick& first, const Yardstick& second);
std::string describe(const Yardstick& yardstick);

}  // namespace splotchcl::bench
