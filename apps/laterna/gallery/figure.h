// A figure of the gallery: what it shows and who draws it. One file for each document that figures are re-made from.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace laterna::app {

class Sitting;

struct Figure {
  std::string_view id;       ///< on the command line, and of its pictures' files
  std::string_view title;    ///< what is shown
  std::string_view origin;   ///< where in the document
  std::string_view caption;  ///< what one should see
  std::string_view failure;  ///< where the technique goes wrong, and whether it does here
  std::string_view recipe;   ///< commands and lines of a rig that do the same to a scene of one's own
  void (*draw)(Sitting& sitting);
};

/// The figures of one document.
struct Chapter {
  std::string_view document;  ///< who wrote it, and what it is called
  std::string_view remark;
  std::span<const Figure> figures;
};

Chapter segal_1992_chapter();
Chapter chen_tung_chapter();
Chapter mit_lecture_20_chapter();
Chapter wikipedia_chapter();
Chapter bentley_chapter();
Chapter environment_chapter();
Chapter later_chapter();
Chapter lens_chapter();
Chapter photograph_chapter();
Chapter lamp_chapter();
Chapter material_chapter();
Chapter relief_chapter();
Chapter mirror_chapter();

/// A picture of a figure, once it is drawn.
struct Panel {
  std::string file;  ///< beside the page; empty: not drawn
  std::string caption;
  int width = 0, height = 0;  ///< pixels
  int magnification = 1;      ///< of an enlarged detail, whose pixels are to be seen
};

}  // namespace laterna::app
