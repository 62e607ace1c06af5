// Which objects can shade which: each compared with each, as the paper does, and by one sort and a sweep (row 48).
#include <random>
#include <vector>

#include "kernel_run.h"
#include "light/shadow_pairs.h"

namespace laterna {
namespace {

using light::BoundingSphere;
using light::ShadowPair;

// Spheres up to 1 m in radius in a room of 200 m, under a lamp.
std::vector<BoundingSphere> spheres(std::size_t count) {
  std::mt19937 random(48);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  std::vector<BoundingSphere> all(count);
  for (BoundingSphere& s : all)
    s = {{between(-100, 100), between(-100, 100), between(-100, 100)}, between(0, 1)};
  return all;
}

constexpr glm::dvec4 kLamp(20, 300, 10, 1);

using FindPairs = std::vector<ShadowPair> (*)(std::span<const BoundingSphere>, const glm::dvec4&);

void find_pairs(benchmark::State& state, FindPairs find, std::size_t count) {
  const std::vector<BoundingSphere> all = spheres(count);
  measure(state, "spheres", static_cast<double>(count), [&] { benchmark::DoNotOptimize(find(all, kLamp)); });
}

const bool kRegistered = [] {
  for (const std::size_t count : {1000U, 10000U}) {
    const std::string of = ", " + std::to_string(count) + " spheres";
    for (const auto& [name, find] : {std::pair{"pairs, each with each", &light::find_shadow_pairs},
                                     std::pair{"pairs, sweep and prune", &light::sweep_shadow_pairs}}) {
      benchmark::RegisterBenchmark((name + of).c_str(), [find = find, count](benchmark::State& state) {
        find_pairs(state, find, count);
      })->Unit(benchmark::kMicrosecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace laterna
