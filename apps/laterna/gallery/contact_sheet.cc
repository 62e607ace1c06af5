#include "contact_sheet.h"

#include <algorithm>
#include <cstddef>

namespace laterna::app {
namespace {

void paste(LayeredImage& sheet, const LayeredImage& picture, int left, int top) {
  for (Channel& channel : sheet.channels) {
    const Channel* from = picture.find(channel.name);
    if (from == nullptr) continue;
    for (int y = 0; y < picture.height; ++y) {
      const auto row = from->values.begin() + static_cast<std::ptrdiff_t>(y) * picture.width;
      std::copy_n(row, picture.width,
                  channel.values.begin() + static_cast<std::ptrdiff_t>(top + y) * sheet.width + left);
    }
  }
}

}  // namespace

LayeredImage contact_sheet(const std::vector<std::vector<LayeredImage>>& rows) {
  LayeredImage sheet;
  if (rows.empty() || rows.front().empty()) return sheet;
  const int width = rows.front().front().width;
  const int height = rows.front().front().height;
  const int gap = std::max(1, width / 40);
  std::size_t columns = 0;
  for (const std::vector<LayeredImage>& row : rows) columns = std::max(columns, row.size());
  sheet.width = static_cast<int>(columns) * (width + gap) - gap;
  sheet.height = static_cast<int>(rows.size()) * (height + gap) - gap;
  const std::size_t pixels = static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height);
  for (const char* name : {"R", "G", "B"}) sheet.channels.push_back({name, std::vector<float>(pixels, 1.0F)});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      paste(sheet, rows[r][c], static_cast<int>(c) * (width + gap), static_cast<int>(r) * (height + gap));
  }
  return sheet;
}

}  // namespace laterna::app
