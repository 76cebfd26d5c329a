#pragma once

// Components of scene files that tests of ranks draw.
namespace splotchcl::test {

constexpr char gas_component[] = R"(
[[component]]
name = "gas"
types = "gas"
color = { field = "internal_energy", scaling = "log" }
palette = "temperature"
)";
constexpr char stars_component[] = R"(
[[component]]
name = "stars"
types = "stars"
palette = "stars"
absorption = 0.3
)";

}  // namespace splotchcl::test
