#include "page.h"

#include <fmt/format.h>

#include <algorithm>

#include "laterna/build_info.h"

namespace laterna::app {
namespace {

// Light and dark as the reader's system has it. Pictures of detail keep their pixels.
constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ground: #fbfaf7; --card: #fff; --ink: #22252b; --soft: #5d6470; --line: #dcd9d2; --accent: #8a4b12; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16181c; --card: #1e2126; --ink: #e6e4df; --soft: #a2a8b3; --line: #363b44; --accent: #e9ab6b; }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 16px/1.55 system-ui, sans-serif; }
header, main, footer { max-width: 1360px; margin: 0 auto; padding: 0 24px; }
h1 { font-size: 2rem; margin: 40px 0 8px; }
h2 { margin: 56px 0 4px; border-bottom: 2px solid var(--accent); padding-bottom: 6px; }
h3 { margin: 0 0 2px; font-size: 1.2rem; }
a { color: var(--accent); }
p { max-width: 80ch; margin: 8px 0; }
nav ol { columns: 3 300px; padding-left: 1.4em; }
nav ol ol { columns: 1; }
nav li { break-inside: avoid; }
.remark, .origin { color: var(--soft); }
.origin { font-size: .9rem; margin: 0 0 8px; }
article { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 20px 24px; margin: 24px 0; }
.pictures { display: grid; gap: 16px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 300px), 1fr)); margin: 16px 0; }
.pictures.few { grid-template-columns: repeat(auto-fill, minmax(min(100%, 400px), 1fr)); }
figure { margin: 0; }
figure.wide { grid-column: 1 / -1; }
figure img { display: block; width: 100%; height: auto; border: 1px solid var(--line); border-radius: 4px; }
figure img.detail { image-rendering: pixelated; }
figcaption { font-size: .9rem; color: var(--soft); margin-top: 4px; }
.absent { border: 1px dashed var(--line); border-radius: 4px; padding: 24px; color: var(--soft); }
details { margin-top: 8px; }
summary { cursor: pointer; color: var(--accent); }
pre { overflow-x: auto; background: var(--ground); border: 1px solid var(--line); border-radius: 6px; padding: 10px 12px; font-size: .85rem; }
footer { color: var(--soft); font-size: .9rem; padding: 32px 24px; }
)";

std::string contents(const std::vector<DrawnChapter>& chapters) {
  std::string list = "<nav aria-label=\"Figures\"><ol>\n";
  for (const DrawnChapter& chapter : chapters) {
    list += fmt::format("<li>{}<ol>\n", escaped(chapter.chapter->document));
    for (const DrawnFigure& drawn : chapter.figures)
      list +=
          fmt::format("<li><a href=\"#{}\">{}</a></li>\n", drawn.figure->id, escaped(drawn.figure->title));
    list += "</ol></li>\n";
  }
  return list + "</ol></nav>\n";
}

std::string panel_html(const Panel& panel) {
  const std::string caption = escaped(panel.caption);
  if (panel.file.empty()) {
    return fmt::format(
        "<figure><div class=\"absent\">This build cannot draw this picture.</div>"
        "<figcaption>{}</figcaption></figure>\n",
        caption);
  }
  // Rows of frames take the whole width.
  const bool is_wide = panel.width > 2 * panel.height;
  return fmt::format(
      "<figure{5}><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" width=\"{2}\" height=\"{3}\"{4} "
      "loading=\"lazy\"></a>"
      "<figcaption>{1}</figcaption></figure>\n",
      panel.file, caption, panel.width * panel.magnification, panel.height * panel.magnification,
      panel.magnification > 1 ? " class=\"detail\"" : "", is_wide ? " class=\"wide\"" : "");
}

std::string figure_html(const DrawnFigure& drawn) {
  const Figure& figure = *drawn.figure;
  std::string html = fmt::format(
      "<article id=\"{}\">\n<h3>{}</h3>\n<p class=\"origin\">{}</p>\n<p>{}</p>\n<div class=\"pictures{}\">\n",
      figure.id, escaped(figure.title), escaped(figure.origin), escaped(figure.caption),
      drawn.panels.size() == 2 || drawn.panels.size() == 4 ? " few" : "");
  for (const Panel& panel : drawn.panels) html += panel_html(panel);
  html += "</div>\n";
  if (!figure.failure.empty())
    html += fmt::format("<p><strong>Where it fails.</strong> {}</p>\n", escaped(figure.failure));
  html += fmt::format(
      "<details><summary>Make it again, and on a scene of your own</summary>\n<pre>laterna gallery -o DIR "
      "--only {}\n{}</pre>"
      "</details>\n</article>\n",
      figure.id, escaped(figure.recipe));
  return html;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string gallery_page(const std::vector<DrawnChapter>& chapters) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Laterna: the figures of the papers</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n"
      "<h1>The figures of the papers, re-made</h1>\n"
      "<p>Four texts taught the world how projected light and its shadows are drawn. Here is what they show, "
      "drawn anew "
      "on scenes of our own, with what each technique gets wrong said beside it; after that lenses, films, "
      "photographs and lamps, with what was measured in them. A click on a picture shows it in its own "
      "size.</p>\n",
      kStyle);
  html += contents(chapters) + "</header>\n<main>\n";
  for (const DrawnChapter& chapter : chapters) {
    html += fmt::format("<section>\n<h2>{}</h2>\n<p class=\"remark\">{}</p>\n",
                        escaped(chapter.chapter->document), escaped(chapter.chapter->remark));
    for (const DrawnFigure& figure : chapter.figures) html += figure_html(figure);
    html += "</section>\n";
  }
  return html + fmt::format(
                    "</main>\n<footer>Drawn by laterna {} on the CPU. Every picture is the same, bit for "
                    "bit, on every "
                    "machine, but for those that rays were traced for.</footer>\n</body>\n</html>\n",
                    escaped(version()));
}

}  // namespace laterna::app
