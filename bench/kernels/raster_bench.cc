// Triangles to pixels: set-up, sorting by tile, and the tile raster by size of triangle and by what it writes.
#include "drawing.h"
#include "kernel_run.h"
#include "raster/triangle_setup.h"

namespace laterna {
namespace {

void set_up(benchmark::State& state, InstructionSet set) {
  const Drawing drawing(small_triangles(), torus_view(), set);
  const TriangleClusters geometry = drawing.frame().geometry();
  const raster::SetupView view(drawing.view());
  const raster::SetUpCluster kernel = raster::set_up_cluster_for(set);
  raster::Batch batch;
  const auto set_up_all = [&] {
    batch.small.clear();
    batch.wide.clear();
    for (std::uint32_t cluster = 0; cluster < geometry.clusters.size(); ++cluster) {
      kernel({&view, &geometry, &drawing.options(), cluster, false}, batch);
    }
  };
  set_up_all();  // once, so that the batch has its memory
  measure(state, "triangles", static_cast<double>(drawing.frame().triangle_count()), set_up_all);
}

void set_up_and_sort(benchmark::State& state, InstructionSet set) {
  Drawing drawing(small_triangles(), torus_view(), set);
  measure(state, "triangles", static_cast<double>(drawing.frame().triangle_count()),
          [&] { drawing.sort_into_tiles(); });
}

enum class Sink : std::uint8_t { depth, visibility };

void draw_tiles(benchmark::State& state, InstructionSet set, const frame::Frame& frame, const View& view,
                Sink sink) {
  Drawing drawing(frame, view, set);
  const auto covered = static_cast<double>(drawing.count_covered());
  if (sink == Sink::depth) {
    measure(state, "pixels", covered, [&] { drawing.draw_depth(); });
  } else {
    measure(state, "pixels", covered, [&] { drawing.draw_visibility(); });
  }
}

const bool kRegistered = [] {
  register_kernel("triangle set-up", set_up);
  register_kernel("culling, set-up and sorting", set_up_and_sort);
  for (const Sink sink : {Sink::depth, Sink::visibility}) {
    const std::string writes = sink == Sink::depth ? "depth" : "depth and id";
    register_kernel("raster, small triangles, " + writes,
                    [sink](benchmark::State& state, InstructionSet set) {
                      draw_tiles(state, set, small_triangles(), torus_view(), sink);
                    });
    register_kernel("raster, wide triangles, " + writes, [sink](benchmark::State& state, InstructionSet set) {
      draw_tiles(state, set, wide_triangles(), torus_view(), sink);
    });
    register_kernel("raster, two triangles, " + writes, [sink](benchmark::State& state, InstructionSet set) {
      draw_tiles(state, set, floor_triangles(), floor_view(), sink);
    });
  }
  return true;
}();

}  // namespace
}  // namespace laterna
