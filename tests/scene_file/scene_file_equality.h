#pragma once

#include <gtest/gtest.h>

#include "splotchcl/scene.h"

// Every member of a scene, one by one, so that a failure says which.
namespace splotchcl::test {

inline bool same(const Vec3& a, const Vec3& b) {
  return a.a[0] == b.a[0] && a.a[1] == b.a[1] && a.a[2] == b.a[2];
}

inline void expect_same(const FieldMap& a, const FieldMap& b) {
  EXPECT_EQ(a.field, b.field);
  EXPECT_EQ(a.scaling, b.scaling);
  EXPECT_EQ(a.minimum, b.minimum);
  EXPECT_EQ(a.maximum, b.maximum);
  EXPECT_EQ(a.percentiles, b.percentiles);
}

inline void expect_same(const std::optional<Vec3>& a, const std::optional<Vec3>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_TRUE(same(*a, *b));
}

inline void expect_same(const ParticleSet& a, const ParticleSet& b) {
  EXPECT_EQ(a.where, b.where);
  EXPECT_EQ(a.id_file, b.id_file);
  EXPECT_EQ(a.halo, b.halo);
  EXPECT_EQ(a.halo_catalog, b.halo_catalog);
  expect_same(a.box_minimum, b.box_minimum);
  expect_same(a.box_maximum, b.box_maximum);
  expect_same(a.sphere_center, b.sphere_center);
  EXPECT_EQ(a.sphere_radius, b.sphere_radius);
}

inline void expect_same(const Placement& a, const Placement& b) {
  expect_same(a.origin, b.origin);
  EXPECT_TRUE(same(a.axis, b.axis));
  EXPECT_EQ(a.angle_degrees, b.angle_degrees);
  EXPECT_EQ(a.scale, b.scale);
}

inline void expect_same(const MapSettings& a, const MapSettings& b) {
  EXPECT_EQ(a.component, b.component);
  EXPECT_EQ(a.quantity, b.quantity);
  EXPECT_EQ(a.statistic, b.statistic);
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(a.slice, b.slice);
  EXPECT_EQ(a.view, b.view);
  expect_same(a.center, b.center);
  EXPECT_EQ(a.center_at, b.center_at);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.periodic, b.periodic);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.length_unit, b.length_unit);
  EXPECT_EQ(a.mass_unit, b.mass_unit);
  EXPECT_EQ(a.velocity_unit, b.velocity_unit);
  EXPECT_EQ(a.floor, b.floor);
  EXPECT_EQ(a.noise, b.noise);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.sky, b.sky);
  EXPECT_EQ(a.scaling, b.scaling);
  EXPECT_EQ(a.softening, b.softening);
  EXPECT_EQ(a.exponent, b.exponent);
  EXPECT_EQ(a.minimum, b.minimum);
  EXPECT_EQ(a.maximum, b.maximum);
  EXPECT_EQ(a.percentiles, b.percentiles);
  EXPECT_EQ(a.palette, b.palette);
  EXPECT_EQ(a.contours, b.contours);
  EXPECT_EQ(a.contour_count, b.contour_count);
}

inline void expect_same(const Component& a, const Component& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.snapshot, b.snapshot);
  EXPECT_EQ(a.types, b.types);
  expect_same(a.select, b.select);
  expect_same(a.exclude, b.exclude);
  EXPECT_TRUE(same(a.center, b.center));
  expect_same(a.placement, b.placement);
  EXPECT_EQ(a.size_field, b.size_field);
  EXPECT_EQ(a.size_factor, b.size_factor);
  EXPECT_EQ(a.size_fixed, b.size_fixed);
  expect_same(a.color, b.color);
  EXPECT_EQ(a.color_vector, b.color_vector);
  EXPECT_EQ(a.absorption_palette, b.absorption_palette);
  expect_same(a.intensity, b.intensity);
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(a.palette, b.palette);
  EXPECT_EQ(a.brightness, b.brightness);
  EXPECT_EQ(a.absorption.kind, b.absorption.kind);
  EXPECT_EQ(a.absorption.factor, b.absorption.factor);
  EXPECT_EQ(a.reference_column, b.reference_column);
}

inline void expect_same(const ReadSettings& a, const ReadSettings& b) {
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.every, b.every);
  EXPECT_EQ(a.max_particles, b.max_particles);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.neighbors, b.neighbors);
  EXPECT_EQ(a.cache_smoothing_lengths, b.cache_smoothing_lengths);
}

inline void expect_same(const Camera& a, const Camera& b) {
  EXPECT_TRUE(same(a.position, b.position));
  EXPECT_TRUE(same(a.look_at, b.look_at));
  EXPECT_TRUE(same(a.sky, b.sky));
  EXPECT_EQ(a.field_of_view_degrees, b.field_of_view_degrees);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.projection, b.projection);
  EXPECT_EQ(a.cube_layout, b.cube_layout);
  EXPECT_EQ(a.near_limit, b.near_limit);
  EXPECT_EQ(a.far_limit, b.far_limit);
}

inline void expect_same(const PathSettings& a, const PathSettings& b) {
  EXPECT_EQ(a.file, b.file);
  ASSERT_EQ(a.orbit.has_value(), b.orbit.has_value());
  if (a.orbit) {
    EXPECT_EQ(a.orbit->degrees, b.orbit->degrees);
    expect_same(a.orbit->center, b.orbit->center);
    expect_same(a.orbit->axis, b.orbit->axis);
    EXPECT_EQ(a.orbit->radius, b.orbit->radius);
  }
  ASSERT_EQ(a.fly.has_value(), b.fly.has_value());
  if (a.fly) {
    ASSERT_EQ(a.fly->through.size(), b.fly->through.size());
    for (std::size_t i = 0; i < a.fly->through.size(); ++i)
      EXPECT_TRUE(same(a.fly->through[i], b.fly->through[i]));
    expect_same(a.fly->look_at, b.fly->look_at);
    EXPECT_EQ(a.fly->is_eased, b.fly->is_eased);
  }
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
    EXPECT_EQ(a.keyframes[i].frame, b.keyframes[i].frame);
    EXPECT_EQ(a.keyframes[i].values, b.keyframes[i].values);
  }
  EXPECT_EQ(a.is_smooth, b.is_smooth);
  EXPECT_EQ(a.look, b.look);
}

inline void expect_same(const SequenceSettings& a, const SequenceSettings& b) {
  EXPECT_EQ(a.snapshots, b.snapshots);
  EXPECT_EQ(a.pattern, b.pattern);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.last, b.last);
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.interpolation, b.interpolation);
  EXPECT_EQ(a.omega_matter, b.omega_matter);
  EXPECT_EQ(a.omega_lambda, b.omega_lambda);
  EXPECT_EQ(a.hubble_rate, b.hubble_rate);
}

inline void expect_same(const TextSettings& a, const TextSettings& b) {
  EXPECT_EQ(a.text, b.text);
  EXPECT_EQ(a.at, b.at);
  EXPECT_EQ(a.size, b.size);
}

inline void expect_same(const ColorBarSettings& a, const ColorBarSettings& b) {
  EXPECT_EQ(a.show, b.show);
  EXPECT_EQ(a.at, b.at);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.labels, b.labels);
}

inline void expect_same(const ScaleBarSettings& a, const ScaleBarSettings& b) {
  EXPECT_EQ(a.show, b.show);
  EXPECT_EQ(a.at, b.at);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.unit, b.unit);
}

inline void expect_same(const InsetSettings& a, const InsetSettings& b) {
  EXPECT_EQ(a.show, b.show);
  EXPECT_EQ(a.at, b.at);
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.border, b.border);
  EXPECT_EQ(a.border_color, b.border_color);
  expect_same(a.position, b.position);
  expect_same(a.look_at, b.look_at);
  expect_same(a.sky, b.sky);
  EXPECT_EQ(a.field_of_view_degrees, b.field_of_view_degrees);
  EXPECT_EQ(a.components, b.components);
}

inline void expect_same(const FinishSettings& a, const FinishSettings& b) {
  EXPECT_EQ(a.exposure, b.exposure);
  EXPECT_EQ(a.saturation, b.saturation);
  EXPECT_EQ(a.contrast, b.contrast);
  EXPECT_EQ(a.contrast_pivot, b.contrast_pivot);
  EXPECT_EQ(a.font, b.font);
  EXPECT_EQ(a.text_size, b.text_size);
  EXPECT_EQ(a.text_color, b.text_color);
  expect_same(a.title, b.title);
  expect_same(a.label, b.label);
  expect_same(a.caption, b.caption);
  EXPECT_EQ(a.frame, b.frame);
  expect_same(a.color_bar, b.color_bar);
  expect_same(a.scale_bar, b.scale_bar);
  expect_same(a.inset, b.inset);
  EXPECT_EQ(a.cross_fade.scene, b.cross_fade.scene);
  EXPECT_EQ(a.cross_fade.amount, b.cross_fade.amount);
  EXPECT_EQ(a.fade, b.fade);
  EXPECT_EQ(a.fade_color, b.fade_color);
}

inline void expect_same(const Stereo& a, const Stereo& b) {
  EXPECT_EQ(a.angle_degrees, b.angle_degrees);
  EXPECT_EQ(a.mode, b.mode);
  EXPECT_EQ(a.eyes, b.eyes);
  EXPECT_EQ(a.layout, b.layout);
}

inline void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.snapshot, b.snapshot);
  expect_same(a.read, b.read);
  EXPECT_EQ(a.tolerance, b.tolerance);
  EXPECT_EQ(a.image.width, b.image.width);
  EXPECT_EQ(a.image.height, b.image.height);
  EXPECT_EQ(a.image.background, b.image.background);
  EXPECT_EQ(a.image.gamma, b.image.gamma);
  EXPECT_EQ(a.image.background_image, b.image.background_image);
  EXPECT_EQ(a.image.convention, b.image.convention);
  ASSERT_EQ(a.camera.has_value(), b.camera.has_value());
  if (a.camera) expect_same(*a.camera, *b.camera);
  ASSERT_EQ(a.stereo.has_value(), b.stereo.has_value());
  if (a.stereo) expect_same(*a.stereo, *b.stereo);
  EXPECT_EQ(a.kernel.width, b.kernel.width);
  EXPECT_EQ(a.kernel.cut, b.kernel.cut);
  EXPECT_EQ(a.kernel.sampling, b.kernel.sampling);
  EXPECT_EQ(a.kernel.min_radius_pixels, b.kernel.min_radius_pixels);
  EXPECT_EQ(a.sort.by, b.sort.by);
  EXPECT_EQ(a.sort.field, b.sort.field);
  EXPECT_EQ(a.sort.descending, b.sort.descending);
  expect_same(a.path, b.path);
  EXPECT_EQ(a.movie.frames, b.movie.frames);
  EXPECT_EQ(a.movie.frames_per_second, b.movie.frames_per_second);
  EXPECT_EQ(a.movie.codec, b.movie.codec);
  EXPECT_EQ(a.movie.rate_factor, b.movie.rate_factor);
  expect_same(a.time, b.time);
  EXPECT_EQ(a.periodic.wrap, b.periodic.wrap);
  EXPECT_EQ(a.periodic.box, b.periodic.box);
  expect_same(a.finish, b.finish);
  expect_same(a.map, b.map);
  ASSERT_EQ(a.components.size(), b.components.size());
  for (std::size_t i = 0; i < a.components.size(); ++i) {
    expect_same(a.components[i], b.components[i]);
  }
}

}  // namespace splotchcl::test
