// The gallery as one HTML page. It needs nothing but its pictures: no script, no font and no network.
#pragma once

#include <string>
#include <vector>

#include "figure.h"

namespace laterna::app {

/// A figure with what was drawn for it.
struct DrawnFigure {
  const Figure* figure = nullptr;
  std::vector<Panel> panels;
};
struct DrawnChapter {
  const Chapter* chapter = nullptr;
  std::vector<DrawnFigure> figures;
};

std::string gallery_page(const std::vector<DrawnChapter>& chapters);

/// Text as it stands in HTML, within attributes as well.
std::string escaped(std::string_view text);

}  // namespace laterna::app
