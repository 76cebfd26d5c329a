#include "map/gas.h"
#include "map/geometry.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Which pixel holds most.
std::pair<int, int> brightest(const Map& map) {
  const auto most = std::max_element(map.values.begin(), map.values.end());
  const int i = static_cast<int>(most - map.values.begin());
  return {i % map.width, i / map.width};
}

TEST(MapGeometry, ShowsXToTheRightAndYUpwards) {
  const auto pixel = brightest(map_of(map_scene(), one_particle({{10.5, 5.5, 3.5}}).snapshot()));
  EXPECT_EQ(pixel, std::make_pair(32 + 10, 24 - 6));
}

TEST(MapGeometry, ShowsZUpwardsInXzAndYz) {
  Scene scene = map_scene();
  scene.map.view = MapView::xz;
  const auto snapshot = one_particle({{10.5, 5.5, 3.5}}).snapshot();
  EXPECT_EQ(brightest(map_of(scene, snapshot)), std::make_pair(32 + 10, 24 - 4));
  scene.map.view = MapView::yz;
  EXPECT_EQ(brightest(map_of(scene, snapshot)), std::make_pair(32 + 5, 24 - 4));
}

TEST(MapGeometry, SeesWhatTheCameraSees) {
  Scene scene = map_scene();
  scene.map.view = MapView::camera;
  scene.camera.emplace();
  scene.camera->position = {{0, 0, 50}};
  scene.camera->look_at = {{0, 0, 0}};
  scene.camera->sky = {{0, 1, 0}};
  scene.camera->projection = Projection::orthographic;
  scene.map.width.reset();
  scene.camera->width = 32;
  const Map map = map_of(scene, one_particle({{10.25, 5.25, 3}}).snapshot());
  EXPECT_NEAR(map.pixel, 0.5, 1e-12);
  EXPECT_EQ(brightest(map), std::make_pair(32 + 20, 24 - 11));
}

TEST(MapGeometry, LeavesOutWhatLiesBeyondTheDepth) {
  Scene scene = map_scene();
  scene.map.depth = 6;
  Gas gas = one_particle({{0.5, 0.5, 2.9}});
  gas.add({{0.5, 0.5, 3.1}}, 0.5F, 1, 100);
  EXPECT_NEAR(sum(map_of(scene, gas.snapshot())), 1, 1e-5);
}

TEST(MapGeometry, DrawsAKernelAcrossTheFaceOfAPeriodicBoxOnBothSides) {
  Scene scene = map_scene();
  scene.image.height = 64;
  scene.map.center.reset();
  auto snapshot = one_particle({{0, 32, 0}}, 4).snapshot();
  snapshot.set_box_size(64);
  const Map map = map_of(scene, snapshot);
  EXPECT_NEAR(sum(map), 1, 1e-6);
  EXPECT_NEAR(at(map, 0, 32), at(map, 63, 32), 1e-7);
  EXPECT_GT(at(map, 0, 32), 0.01F);
}

TEST(MapGeometry, RepeatsTheBoxWhereTheMapIsWider) {
  Scene scene = map_scene();
  scene.image.height = 64;
  auto snapshot = one_particle({{8, 8, 8}}).snapshot();
  snapshot.set_box_size(16);
  scene.map.depth = 32;
  EXPECT_NEAR(sum(map_of(scene, snapshot)), 4 * 4 * 2, 1e-4);
}

TEST(MapGeometry, RefusesAKernelThatReachesOverManyBoxes) {
  Scene scene = map_scene();
  scene.map.width = 1;
  auto snapshot = one_particle({{0, 0, 0}}, 3000).snapshot();
  snapshot.set_box_size(1);
  std::string message;
  try {
    map_of(scene, snapshot);
  } catch (const UsageError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("a smoothing length of 3000 in a box of 1,"));
}

TEST(MapGeometry, FindsAParticleThatLiesVeryManyBoxesAway) {
  Scene scene = map_scene();
  scene.image.height = 64;
  auto snapshot = one_particle({{1e30, 0, 0}}).snapshot();
  snapshot.set_box_size(64);
  EXPECT_NEAR(sum(map_of(scene, snapshot)), 1, 1e-6);
}

TEST(MapGeometry, HasTheWholeBoxOnceFromAnyAxis) {
  Gas gas = test::random_gas(200, 32, 0.5F, 8);
  auto snapshot = gas.snapshot();
  snapshot.set_box_size(64);
  const double mass = std::accumulate(gas.mass.begin(), gas.mass.end(), 0.0);
  Scene scene = map_scene();
  scene.image.height = 64;
  scene.map.center = Vec3{{7, -11, 29}};
  for (const MapView view : {MapView::xy, MapView::xz, MapView::yz}) {
    scene.map.view = view;
    EXPECT_NEAR(sum(map_of(scene, snapshot)) / mass, 1, 1e-6);
  }
}

TEST(MapGeometry, FindsTheCenterOfMassAcrossAFace) {
  Gas gas = one_particle({{63, 32, 32}});
  gas.add({{1, 32, 32}}, 0.5F, 1, 100);
  auto snapshot = gas.snapshot();
  snapshot.set_box_size(64);
  Scene scene = map_scene();
  scene.map.center.reset();
  scene.map.center_at = MapCenter::mass;
  const double x = map_of(scene, snapshot).center.a[0];
  EXPECT_NEAR(std::min(x, 64 - x), 0, 1e-4);
}

TEST(MapGeometry, FindsTheCenterOfMassInAPeriodicBoxAsInAnOpenOne) {
  const Gas gas = test::random_gas(50, 12, 1, 4);
  Scene scene = map_scene();
  scene.map.center.reset();
  scene.map.center_at = MapCenter::mass;
  const Map open = map_of(scene, gas.snapshot());
  auto snapshot = gas.snapshot();
  snapshot.set_box_size(64);
  const Map periodic = map_of(scene, snapshot);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double apart = periodic.center.a[axis] - open.center.a[axis];
    EXPECT_NEAR(apart - 64 * std::nearbyint(apart / 64), 0, 1e-9);
  }
}

TEST(MapGeometry, TakesNoBoxForWhatIsPlacedElsewhere) {
  Scene scene = map_scene();
  scene.components.front().placement.origin = Vec3{{8, 8, 8}};
  auto snapshot = one_particle({{0, 0, 0}}).snapshot();
  snapshot.set_box_size(16);
  EXPECT_NEAR(sum(map_of(scene, snapshot)), 1, 1e-6);
  scene.map.periodic = true;
  EXPECT_THROW(map_of(scene, snapshot), UsageError);
}

TEST(MapGeometry, SelectsASphereAcrossTheFacesOfABox) {
  Scene scene = map_scene();
  scene.image.height = 64;
  scene.map.center.reset();
  ParticleSet& select = scene.components.front().select;
  select.sphere_center = Vec3{{1, 32, 32}};
  select.sphere_radius = 4;
  Gas gas = one_particle({{63.5, 32, 32}});
  gas.add({{10, 32, 32}}, 0.5F, 1, 100);
  auto snapshot = gas.snapshot();
  snapshot.set_box_size(64);
  const Map map = map_of(scene, snapshot);
  EXPECT_EQ(map.particles, 1U);
  EXPECT_EQ(brightest(map).first, 63);
}

TEST(MapGeometry, ShowsTheWholeBoxInAPictureOfAnyShape) {
  Scene scene = map_scene();
  scene.map.width.reset();
  scene.map.center.reset();
  auto snapshot = one_particle({{1, 1, 1}}).snapshot();
  snapshot.set_box_size(48);
  EXPECT_NEAR(map_of(scene, snapshot).pixel, 1, 1e-12);
}

TEST(MapGeometry, HasTheMiddleOfTheBoxWhateverIsSelected) {
  Scene scene = map_scene();
  scene.map.center.reset();
  auto snapshot = test::random_gas(200, 32, 0.5F, 1).snapshot();
  snapshot.set_box_size(64);
  scene.components.front().select.where = {"position_x > 5 and position_y > 5", "position_z > 5"};
  EXPECT_EQ(map_of(scene, snapshot).center.a[0], 0);
}

// Stars in one corner of it.
TEST(MapGeometry, HasTheMiddleOfABoxThatOtherParticlesTell) {
  Scene scene = map_scene();
  scene.map.center.reset();
  const Gas stars = one_particle({{3, 4, 5}});
  for (const double first : {-32.0, 0.0}) {
    Gas gas = one_particle({{first + 1, first + 1, first + 1}});
    gas.add({{first + 63, first + 63, first + 63}}, 0.5F, 1, 100);
    auto snapshot = gas.snapshot();
    snapshot.add(4, "position", stars.position, 3);
    snapshot.add(4, "smoothing_length", stars.h);
    snapshot.add(4, "mass", stars.mass);
    snapshot.set_box_size(64);
    scene.components.front().types = {4};
    EXPECT_EQ(map_of(scene, snapshot).center.a[0], first + 32);
  }
}

TEST(MapGeometry, OfAnEmptySelectionIsThatOfTheBox) {
  Scene scene = map_scene();
  scene.map.center.reset();
  scene.map.width.reset();
  scene.components.front().select.where = {"temperature > 1e20"};
  auto snapshot = one_particle({{40, 40, 40}}).snapshot();
  snapshot.set_box_size(64);
  std::vector<std::string> notes;
  const Map map = map_of(scene, snapshot, &notes);
  EXPECT_EQ(sum(map), 0);
  EXPECT_EQ(map.center.a[0], 32);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("leave none of its 1 particles")));
}

TEST(MapGeometry, OfAnEmptySelectionWithoutABoxHasToBeSaid) {
  Scene scene = map_scene();
  scene.components.front().select.where = {"temperature > 1e20"};
  const auto snapshot = one_particle({{40, 40, 40}}).snapshot();
  EXPECT_NO_THROW(map_of(scene, snapshot));
  scene.map.width.reset();
  EXPECT_THAT([&] { map_of(scene, snapshot); },
              ThrowsMessage<UsageError>(HasSubstr("; set map.width")));
  scene.map.center.reset();
  EXPECT_THAT([&] { map_of(scene, snapshot); },
              ThrowsMessage<UsageError>(AllOf(HasSubstr("leave none of 1 particles"),
                                              HasSubstr("set map.center and map.width"))));
}

TEST(MapGeometry, FindsTheDensestPlace) {
  Gas gas = test::random_gas(50, 20, 1, 4);
  gas.add({{3, -4, 5}}, 4, 1, 100, {{0, 0, 0}}, 50);
  Scene scene = map_scene();
  scene.map.center.reset();
  scene.map.center_at = MapCenter::densest;
  const Map map = map_of(scene, gas.snapshot());
  EXPECT_NEAR(map.center.a[0], 3, 1e-6);
  EXPECT_NEAR(map.center.a[1], -4, 1e-6);
}

TEST(MapGeometry, RefusesAPeriodicMapOfAnUnknownBox) {
  Scene scene = map_scene();
  scene.map.periodic = true;
  EXPECT_THROW(map_of(scene, one_particle({{0, 0, 0}}).snapshot()), UsageError);
}

// Balls of gas of which maps are known in closed form.

const double pi = std::acos(-1.0);

// A lattice of spacing 1: sums of Gaussians wider than it are integrals, to many digits.
template <class Density>
Gas lattice(int reach, float h, Density density) {
  Gas gas;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const double rho = density(std::sqrt(x * x + y * y + z * z));
        if (rho > 0) {
          gas.add({{double(x), double(y), double(z)}}, h, static_cast<float>(rho),
                  static_cast<float>(z * z), {{0, 0, 0}}, static_cast<float>(rho));
        }
      }
    }
  }
  return gas;
}

// rho = exp(-r^2 / s^2): smoothed with a kernel of sigma it is a Gaussian of s^2 + sigma^2.
TEST(MapOfABall, IsGaussianForAGaussianBall) {
  constexpr double s = 4;
  constexpr float h = 6;
  const Gas gas = lattice(18, h, [](double r) { return std::exp(-r * r / (s * s)); });
  const Map map = map_of(map_scene(), gas.snapshot());
  const double sigma = sigma_of_h * double{h}, wide = std::sqrt(s * s + sigma * sigma);
  const double mass = std::pow(pi, 1.5) * s * s * s;
  const auto along = [wide](double from) {
    return 0.5 * (std::erf((from + 1) / wide) - std::erf(from / wide));
  };
  for (const auto& [x, y] :
       {std::make_pair(32, 24), std::make_pair(35, 22), std::make_pair(26, 29)}) {
    const double expected = mass * along(x - 32) * along(23 - y);
    EXPECT_NEAR(static_cast<double>(at(map, x, y)) / expected, 1, 2e-6);
  }
}

// rho = 1 within R: the column at distance r is 2 sqrt(R^2 - r^2), and the mean of z^2 along it
// (R^2 - r^2) / 3. Smoothing lessens them by sigma^2 / (2 R^2) and sigma^2 / R^2 at the middle,
// which is 0.5 and 0.9 %, and by little more here. The lattice's edge is a cell wide.
TEST(MapOfABall, HasTheChordsOfAUniformBall) {
  constexpr double radius = 20;
  const Gas gas = lattice(21, 5, [](double r) { return std::clamp(radius + 0.5 - r, 0.0, 1.0); });
  Scene scene = map_scene();
  const Map column = map_of(scene, gas.snapshot());
  scene.map.quantity = "temperature";
  const Map mean = map_of(scene, gas.snapshot());
  for (const int x : {32, 38, 26}) {
    const double square = radius * radius - std::pow(x - 31.5, 2) - 0.25;
    EXPECT_NEAR(static_cast<double>(at(column, x, 24)) / (2 * std::sqrt(square)), 1, 0.01);
    EXPECT_NEAR(static_cast<double>(at(mean, x, 24)) / (square / 3), 1, 0.02);
  }
}

// In the plane through its center a uniform ball has its density, as far as the kernels reach.
TEST(MapOfABall, HasItsDensityInASlice) {
  const Gas gas = lattice(15, 5, [](double r) { return r <= 14 ? 1.0 : 0.0; });
  Scene scene = map_scene();
  scene.map.slice = true;
  EXPECT_NEAR(static_cast<double>(at(map_of(scene, gas.snapshot()), 32, 24)), 1, 1e-3);
}

}  // namespace
}  // namespace splotchcl::test
