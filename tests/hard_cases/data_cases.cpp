// Numbers of particles that counters and buffers may not hold, and values that are none.
#include "hard_cases/hard_cases.h"
#include "hard_cases/hard_frames.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

Frame everything_in_one_tile(LightPlan plan) {
  Random random(61);
  std::vector<Cloud> clouds;
  for (int i = 0; i < 30000; ++i) {
    // Pixels 34 to 46 of 128: inside one tile of 16, 32 or 64.
    clouds.push_back({random.uniform(-30, -18), random.uniform(-30, -18), random.uniform(1, 100),
                      random.uniform(0.2, 0.5), random.logarithmic(0.001, 0.1)});
  }
  return lit(frame_of(128, 128, {in_random_colors(component_of(clouds, two_colors()))}), plan);
}

Frame nothing_visible(LightPlan plan) {
  const std::vector<Cloud> clouds = {
      {0, 0, -1, 3, 1}, {500, 0, 1, 3, 1}, {-500, 0, 1, 3, 1}, {0, 1e30, 1, 3, 1}};
  return lit(frame_of(40, 30, {component_of(clouds, two_colors())}), plan);
}

Frame no_particles(LightPlan plan) {
  Frame frame = lit(frame_of(40, 30, {component_of({}, two_colors())}), plan);
  frame.background = {0.2, 0.3, 0.4};
  return frame;
}

Frame no_components(LightPlan) {
  Frame frame = frame_of(40, 30, {});
  frame.background = {0.2, 0.3, 0.4};
  return frame;
}

// 2^24 grains on the first pixel and one more, the last, on the second.
constexpr std::size_t many = (1u << 24) + 1;
constexpr double many_sigma = 0.01;

Frame one_more_than_floats_count(LightPlan plan) {
  DrawnComponent grains;
  grains.particles.count = many;
  std::vector<float> positions(3 * many, 0.0f), masses(many, 0x1p-24f);
  for (std::size_t i = 0; i < many; ++i) {
    positions[3 * i] = i + 1 < many ? -0.5f : 0.5f;
    positions[3 * i + 2] = 1;
  }
  masses[many - 1] = 0.5f;
  grains.particles.position = Column::owning(std::move(positions));
  grains.particles.smoothing_length = Column::uniform(static_cast<float>(many_sigma));
  grains.particles.weight = Column::owning(std::move(masses));
  grains.palette = one_color(1, 1, 1);
  if (plan == LightPlan::ordered) {
    grains.palette.absorption = {Rgb{1, 1, 1}};
    return frame_of(2, 1, {grains});
  }
  return lit(frame_of(2, 1, {grains}), plan);
}

// A grain of mass m that lies in one pixel has X = m there.
ReferenceImage one_more_exact(const Frame& frame) {
  const bool absorbs = frame.components.front().absorption.kind != Absorption::Kind::none;
  ReferenceImage image = even_picture(frame, 0, 0, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    image.pixels[c] = absorbs ? -std::expm1(-1.0) : 1.0;
    image.pixels[4 + c] = absorbs ? -std::expm1(-0.5) : 0.5;
  }
  return image;
}

// So many clouds over so many tiles that their lists need several passes. The clouds are
// so wide that every pixel is the same.
Frame lists_of_several_passes(LightPlan plan) {
  Random random(67);
  std::vector<Cloud> clouds;
  // 3300 clouds over 1024 tiles of 32 x 32, or 6600 over 512 of twice the width.
  const int count = plan == LightPlan::ordered ? 3300 : 6600;
  for (int i = 0; i < count; ++i)
    clouds.push_back({0, 0, random.uniform(1, 100), 1e7, 3.0 / count});
  DrawnComponent component = in_random_colors(component_of(clouds, two_colors()));
  component.absorption = {Absorption::Kind::factor, 2};
  Frame frame = frame_of(1024, 1024, {component});
  if (plan == LightPlan::ordered) return ordered_by_two_components(frame);
  // Sums would draw them on a coarse grid of few tiles, were their edges not this sharp.
  frame.kernel.cut = 1;
  return lit(frame, plan);
}

ReferenceImage one_pixel_everywhere(const Frame& frame) {
  Frame one_pixel = frame;
  one_pixel.crop = {512, 512, 1, 1};
  const ReferenceImage pixel = reference::render(one_pixel);
  return even_picture(frame, pixel.pixels[0], pixel.pixels[1], pixel.pixels[2]);
}

// Every field of some particle is not a number or infinite, between good particles.
Frame bad_values(LightPlan plan) {
  CloudSetup setup;
  setup.count = 400;
  DrawnComponent clouds = random_clouds(setup);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const auto copy_of = [](const Column& column) {
    return std::vector<float>(column.data(), column.data() + column.size());
  };
  std::vector<float> positions = copy_of(clouds.particles.position);
  std::vector<float> sizes = copy_of(clouds.particles.smoothing_length);
  std::vector<float> masses = copy_of(clouds.particles.weight);
  std::vector<float> colors = copy_of(clouds.particles.color);
  std::vector<float> intensities(clouds.particles.count, 1.0f);
  std::size_t next = 3;
  for (const float bad : {nan, infinite, -infinite}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      positions[3 * next + axis] = bad;
      next += 7;
    }
    for (std::vector<float>* field : {&sizes, &masses, &colors, &intensities}) {
      (*field)[next] = bad;
      next += 7;
    }
  }
  for (const float size : {0.0f, -0.0f, -1.0f}) {
    sizes[next] = size;
    next += 7;
  }
  masses[next] = -1;
  clouds.particles.position = Column::owning(positions);
  clouds.particles.smoothing_length = Column::owning(sizes);
  clouds.particles.weight = Column::owning(masses);
  clouds.particles.color = Column::owning(colors);
  clouds.particles.intensity = Column::owning(intensities);
  return lit(frame_of(setup.width, setup.height, {clouds}), plan);
}

// The same for keys and for colours of the particles' own, which other frames do not read.
Frame bad_keys_and_colors(LightPlan plan) {
  CloudSetup setup;
  setup.count = 400;
  DrawnComponent clouds = random_clouds(setup);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinite = std::numeric_limits<float>::infinity();
  std::vector<float> keys, colors;
  for (int i = 0; i < setup.count; ++i) {
    keys.push_back(static_cast<float>(i % 17));
    for (int c = 0; c < 3; ++c)
      colors.push_back(static_cast<float>((i + c) % 5) / 5);
  }
  std::size_t next = 3;
  for (const float bad : {nan, infinite, -infinite}) {
    keys[next] = bad;
    for (std::size_t c = 0; c < 3; ++c)
      colors[3 * (next + 7 * (c + 1)) + c] = bad;
    next += 28;
  }
  clouds.particles.sort_field = Column::owning(keys);
  clouds.particles.color_vector = Column::owning(colors);
  Frame frame = lit(frame_of(setup.width, setup.height, {clouds}), plan);
  frame.sort = {SortOrder::By::field, "key", false};
  return frame;
}

Frame many_components(LightPlan plan) {
  std::vector<DrawnComponent> components;
  for (int i = 0; i < 100; ++i) {
    CloudSetup setup;
    setup.count = 5;
    setup.seed = static_cast<std::uint64_t>(i);
    components.push_back(random_clouds(setup));
    components.back().brightness = 0.5 + 0.01 * i;
  }
  return lit(frame_of(100, 70, components), plan);
}

// A field of the clouds' particles.
Column random_field(const DrawnComponent& clouds, std::uint64_t seed,
                    const std::function<double(Random&)>& value) {
  Random random(seed);
  std::vector<float> values;
  for (std::size_t i = 0; i < clouds.particles.count; ++i)
    values.push_back(static_cast<float>(value(random)));
  return Column::owning(std::move(values));
}

// The palette's range is `range` wide around values of 1e6.
Frame narrow_color_range(Scaling scaling, double range, LightPlan plan) {
  CloudSetup setup;
  setup.count = 300;
  DrawnComponent clouds = random_clouds(setup);
  clouds.particles.color = random_field(
      clouds, 71, [range](Random& random) { return random.uniform(1e6, 1e6 + range); });
  clouds.color.scaling = scaling;
  clouds.color.minimum = 1e6 + 0.03 * range;
  clouds.color.maximum = 1e6 + 0.97 * range;
  if (scaling == Scaling::log) {
    clouds.color.minimum = std::log10(clouds.color.minimum);
    clouds.color.maximum = std::log10(clouds.color.maximum);
  }
  if (scaling == Scaling::asinh) {
    clouds.color.minimum = std::asinh(clouds.color.minimum);
    clouds.color.maximum = std::asinh(clouds.color.maximum);
  }
  return lit(frame_of(setup.width, setup.height, {clouds}), plan);
}

// So bright that what a logarithm is rounded by shows where the intensity is next to 0.
Frame bright_least_intensities(LightPlan plan) {
  CloudSetup setup;
  setup.count = 300;
  DrawnComponent clouds = random_clouds(setup);
  clouds.particles.intensity = random_field(
      clouds, 79, [](Random& random) { return 1e-3 * (1 + random.logarithmic(1e-7, 1e-3)); });
  clouds.intensity = {Scaling::log, -3, 3};
  clouds.brightness = 1e4;
  return lit(frame_of(setup.width, setup.height, {clouds}), plan);
}

// A palette whose colours jump from knot to knot, over 12 decades of values.
Frame steep_palette(LightPlan plan) {
  CloudSetup setup;
  setup.count = 300;
  DrawnComponent clouds = random_clouds(setup);
  clouds.particles.color =
      random_field(clouds, 73, [](Random& random) { return random.logarithmic(1e-6, 1e6); });
  clouds.color = {Scaling::log, -6, 6};
  clouds.palette.emission.clear();
  for (int k = 0; k < 256; ++k) {
    clouds.palette.emission.push_back(k % 2 == 0 ? Rgb{1, 0, 0.5f} : Rgb{0, 1, 0.5f});
  }
  return lit(frame_of(setup.width, setup.height, {clouds}), plan);
}

}  // namespace

std::vector<HardCase> data_cases() {
  return {
      {"EverythingInOneTile", "one core would walk the list; it must be cut in segments",
       everything_in_one_tile},
      {"NothingVisible", "every list is empty", nothing_visible, all_plans,
       [](const Frame& frame) { return reference::render(frame); }, true},
      {"NoParticles", "every buffer is empty", no_particles},
      {"NoComponents",
       "there is no palette and no plan to choose",
       no_components,
       {LightPlan::emission}},
      {"OneMoreThan2To24Particles", "counters in single precision end at 2^24",
       one_more_than_floats_count, all_plans, one_more_exact, false, Drawn::never,
       Drawn::in_long_tests, true, Drawn::in_long_tests},
      {"ListsOfSeveralPasses",
       "more list entries than fit at once, in order",
       lists_of_several_passes,
       {LightPlan::emission, LightPlan::ordered},
       one_pixel_everywhere,
       false,
       Drawn::never,
       Drawn::never},
      {"BadValuesInEveryField", "one not-a-number that is drawn spoils every pixel", bad_values},
      {"BadKeysAndColors", "the same of fields that few frames read", bad_keys_and_colors},
      {"ManyComponents", "colours and offsets of each must be its own", many_components},
      {"NarrowLinearColorRange", "the palette's ends need more digits than the values have",
       [](LightPlan plan) { return narrow_color_range(Scaling::linear, 10, plan); }},
      {"NarrowLogColorRange", "logarithms of the values differ by less than their roundings",
       [](LightPlan plan) { return narrow_color_range(Scaling::log, 10, plan); }},
      {"NarrowAsinhColorRange", "the same for asinh",
       [](LightPlan plan) { return narrow_color_range(Scaling::asinh, 10, plan); }},
      {"BrightLeastIntensities", "logarithms near the least, times 1e4", bright_least_intensities},
      {"SteepPalette", "256 knots that alternate turn 1e-6 of the range into 3e-4 of a colour",
       steep_palette},
  };
}

}  // namespace splotchcl::test
