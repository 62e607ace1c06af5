// Luxels that shine much more than the rest (a projected slide, a patch of sun, a lamp): few rays would find them, so that
// they are asked one by one, or many at a time where they lie close together and far away.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "bake/luxel_rays.h"
#include "bake/luxel_tree.h"

namespace laterna::bake {

/// Tells luxels that give off more than twice the mean from the rest, which rays find well. Sums of the bright ones are taken
/// over a tree as lightcuts do (Walter and others, Lightcuts, 2005: what brings most is opened first, up to a number of boxes), with
/// the form factor from a point to a disc, A cos θ cos θ' / (π d² + A) (Wallace, Elmquist and Haines, A ray tracing algorithm for
/// progressive radiosity, 1989). That factor is good from a few widths of the luxel on. What is nearer is left to rays, which meet
/// it often.
class BrightLuxels {
 public:
  /// `exitance`: what each place gives off. Tree and exitance must outlive this.
  BrightLuxels(const LuxelTree& tree, std::span<const glm::vec3> exitance);

  /// Whether what a ray from one place to another brings is not part of irradiance_at().
  [[nodiscard]] bool is_left_to_rays(std::uint32_t receiver, std::uint32_t place) const {
    return !is_bright(place) || is_near(receiver, place);
  }
  struct Brought {
    glm::vec3 irradiance{0};
    /// Of all channels together, each part of it over the distance from which it comes, in metres.
    float per_distance = 0;
  };

  /// What comes to `receiver` from all bright luxels that are not left to rays. `effort`: above 0 to 1, the part of the boxes and
  /// rays that are worth it for a sum that nothing is averaged with; the mean over receivers is the same for all.
  [[nodiscard]] Brought brought_to(std::uint32_t receiver, float effort, const LuxelRays& rays,
                                   LuxelRays::Scratch& scratch) const;

 private:
  // Of a node's bright luxels.
  struct Shine {
    glm::vec3 flux{0};    // over all of them
    glm::vec3 centre{0};  // mean position and
    glm::vec3 axis{0};    // mean normal, weighted by strength; the latter is shorter the more normals differ
    glm::vec3 low_ws{0}, high_ws{0};
    float strength = 0;  // flux of all channels together
    float area = 0;
    float largest = 0;  // area of the largest
    float radius = 0;   // about the centre, of a sphere that holds them
    void add(const Shine& other);
    void find_radius();
  };
  struct Sum;

  [[nodiscard]] bool is_bright(std::uint32_t place) const;
  [[nodiscard]] bool is_near(std::uint32_t receiver, std::uint32_t place) const;
  [[nodiscard]] Shine shine_of(std::uint32_t place) const;
  [[nodiscard]] Shine shine_below(std::uint32_t node) const;
  template <class Seen>
  void add(Sum& sum, const Shine& shine, Seen seen) const;
  void add_samples(Sum& sum, std::span<const std::pair<float, std::uint32_t>> boxes) const;
  void add_sample(Sum& sum, std::uint32_t node, int rays) const;
  // More than a node can bring, all channels together.
  [[nodiscard]] float bound_at(std::uint32_t receiver, std::uint32_t node) const;
  [[nodiscard]] bool can_be_one(const Sum& sum, std::uint32_t node) const;
  [[nodiscard]] std::uint32_t pick(std::uint32_t node, double number) const;

  const LuxelTree& tree_;
  std::span<const glm::vec3> exitance_;
  float most_even_ = 0;
  std::vector<Shine> shine_;         // by node
  std::vector<double> flux_before_;  // by place, of all channels: that of bright luxels at places before it
};

}  // namespace laterna::bake
