// The vector vocabulary of base/vectors-inl.h and its neighbours, made callable on every instruction set. All
// spans are of one length, a multiple of 16, and start on a cache line.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "frame/frame.h"
#include "image/mip_chain.h"
#include "laterna/instruction_set.h"
#include "laterna/sampler.h"
#include "shadow/projected_view.h"

namespace laterna::kernels {

using Numbers = std::span<const float>;
using Results = std::span<float>;

using OneArgument = void (*)(Numbers x, Results result);
using TwoArguments = void (*)(Numbers x, Numbers y, Results result);
using ThreeArguments = void (*)(Numbers x, Numbers y, Numbers z, Results result);

OneArgument exponentials_for(InstructionSet set);
OneArgument logarithms_for(InstructionSet set);
OneArgument cosines_for(InstructionSet set);
OneArgument saturated_for(InstructionSet set);
TwoArguments powers_for(InstructionSet set);

/// x, y, z of the records at `index`, and z of `counts` there.
struct RecordProbes {
  std::span<const glm::vec3> records;
  std::span<const glm::ivec3> counts;
  std::span<const std::int32_t> index;
  Results x, y, z, last_count;
};
using GatherProbes = void (*)(const RecordProbes& probes);
GatherProbes gather_probes_for(InstructionSet set);

/// Three results per input: the components of the normalised vector.
struct Directions {
  Numbers x, y, z;
  Results unit_x, unit_y, unit_z;
};
using Normalise = void (*)(const Directions& directions);
Normalise normalise_for(InstructionSet set);

/// result[i]: 1 where stored, tested and bias say lit, otherwise 0.
ThreeArguments compare_depths_for(InstructionSet set);

/// A row of equation 6 at pixels (x, y) and reversed depths q.
struct RowPoints {
  const shadow::ProjectedRow* row;
  Numbers x, y, q;
  Results value;
};
using EvaluateRow = void (*)(const RowPoints& points);
EvaluateRow evaluate_row_for(InstructionSet set);

struct TextureProbes {
  const image::MipChain* chain;
  Sampler sampler;
  int anisotropy;
  Numbers u, v, du_dx, dv_dx, du_dy, dv_dy;
  Results r, g, b, a;
};
using LookUpTexture = void (*)(const TextureProbes& probes);
LookUpTexture look_up_texture_for(InstructionSet set);

/// is_hole[i]: 1 where the point of triangle ids[i] with weights b[i] and c[i] is a hole, otherwise 0.
struct SurfaceProbes {
  const frame::Frame* frame;
  std::span<const TriangleId> ids;
  Numbers b, c;
  Results is_hole;
};
using FindHoles = void (*)(const SurfaceProbes& probes);
FindHoles find_holes_for(InstructionSet set);

}  // namespace laterna::kernels
