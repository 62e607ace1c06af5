// The stages of drawing, and how long each took.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace laterna {

/// In the order in which data flows through them.
enum class Stage : std::uint8_t {
  cull,       ///< clusters out of view are left out, the others sorted front to back
  transform,  ///< vertices to the screen
  set_up,     ///< triangles turned away or without area left out, snapped, given their depth planes
  clip,       ///< transform and set_up of clusters that cross the near plane or the guard band
  bin,        ///< triangles sorted by tile
  raster,     ///< nearest depth and triangle of every sample
  surface,    ///< positions, normals and textures of the samples
  shadow,     ///< how much of each light arrives: look-ups and exact tests
  light,      ///< what lights send and surfaces reflect
  encode,     ///< tiles to the caller's memory
};
inline constexpr std::size_t kStageCount = 10;

/// "cull", "transform", "set-up", …
std::string_view name_of(Stage stage);

/// Milliseconds by stage, summed over the threads that worked on it.
struct StageTimes {
  std::array<double, kStageCount> ms{};

  double& operator[](Stage stage) { return ms[static_cast<std::size_t>(stage)]; }
  double operator[](Stage stage) const { return ms[static_cast<std::size_t>(stage)]; }
  StageTimes& operator+=(const StageTimes& other);
  [[nodiscard]] double total() const;
  /// `total_ms` divided among stages as this is.
  [[nodiscard]] StageTimes share_out(double total_ms) const;
};

}  // namespace laterna
