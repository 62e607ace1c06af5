#include "shade/fragment_list.h"

#include <algorithm>
#include <numeric>

namespace laterna::shade {

void FragmentList::sort() {
  std::sort(fragments_.begin(), fragments_.end(), [](const raster::Fragment& a, const raster::Fragment& b) {
    if (a.pixel != b.pixel) return a.pixel < b.pixel;
    return a.reversed_depth != b.reversed_depth ? a.reversed_depth < b.reversed_depth : a.id > b.id;
  });
}

std::span<const FragmentList::Run> FragmentList::by_surface(const frame::Frame& frame) {
  const auto surface = [&](std::uint32_t i) { return frame.clusters[cluster_of(fragments_[i].id)].material; };
  order_.resize(fragments_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return surface(a) < surface(b); });
  runs_.clear();
  for (std::size_t first = 0; first < order_.size();) {
    std::size_t end = first + 1;
    while (end < order_.size() && surface(order_[end]) == surface(order_[first])) ++end;
    runs_.push_back({surface(order_[first]), std::span(order_).subspan(first, end - first)});
    first = end;
  }
  return runs_;
}

}  // namespace laterna::shade
