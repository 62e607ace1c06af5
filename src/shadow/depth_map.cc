#include "shadow/depth_map.h"

namespace laterna::shadow {

void DepthMap::require(int tile_x, int tile_y) {
  if (is_drawn(tile_x, tile_y)) return;
  std::atomic<std::uint8_t>& state = states_->of_tile[tile_number(tile_x, tile_y)];
  for (;;) {
    std::uint8_t found = kMissing;
    if (state.compare_exchange_strong(found, kBeingDrawn, std::memory_order_acquire)) break;
    if (found == kDrawn) return;
    state.wait(found, std::memory_order_acquire);
  }
  const auto leave = [&](TileState left) {
    state.store(left, std::memory_order_release);
    state.notify_all();
  };
  try {
    painter_->paint(view_, tile_x, tile_y, tile(tile_x, tile_y), triangle_tile(tile_x, tile_y));
  } catch (...) {
    // Others may have the memory for it.
    leave(kMissing);
    throw;
  }
  leave(kDrawn);
  states_->missing.fetch_sub(1, std::memory_order_acq_rel);
}

void DepthMap::forget(int tile_x, int tile_y) {
  if (!is_drawn(tile_x, tile_y)) return;
  states_->of_tile[tile_number(tile_x, tile_y)].store(kMissing, std::memory_order_release);
  states_->missing.fetch_add(1, std::memory_order_acq_rel);
}

}  // namespace laterna::shadow
