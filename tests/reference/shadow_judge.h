// Whether light arrives at a point, judged against every triangle by itself, in extended precision, by distances in metres:
// how far the way to the light passes from each edge. So it can also say that it is a tie.
#pragma once

#include <vector>

#include "frame/frame.h"

namespace laterna::reference {

enum class Judgement { lit, dark, tie };

class ShadowJudge {
 public:
  /// Both must outlive the judge.
  ShadowJudge(const frame::Frame& frame, const frame::PlacedLight& light);

  /// Triangle `own` does not count, nor what is nearer to the point than `nearest`. A tie: moving things by `tolerance`
  /// metres, or alpha by `alpha_tolerance`, could change the answer.
  [[nodiscard]] Judgement judge(const glm::dvec3& position_ws, TriangleId own, double nearest,
                                double tolerance, double alpha_tolerance = 0) const;
  /// Of those that cast shadows, the one nearest to the point.
  [[nodiscard]] TriangleId triangle_at(const glm::dvec3& position_ws) const;

 private:
  struct Caster {
    TriangleId id;
    glm::dvec3 corner[3];
  };
  [[nodiscard]] Judgement judge(const Caster& caster, const glm::dvec3& position_ws, double nearest,
                                double tolerance, double alpha_tolerance) const;
  [[nodiscard]] Judgement judge_alpha(TriangleId id, double b, double c, double tolerance) const;

  const frame::Frame& frame_;
  std::vector<Caster> casters_;
  bool is_parallel_;
  glm::dvec3 position_ws_, forward_ws_;
  double near_;  // along the axis; −∞: everything counts
};

}  // namespace laterna::reference
