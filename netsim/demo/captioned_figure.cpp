#include "netsim/demo/captioned_figure.h"

namespace tandem::netsim::demo {

std::string to_html(const CaptionedFigure& figure, std::string_view prefix) {
  return "<figure id=\"" + std::string(prefix) + "-" + figure.anchor + "\">\n<h4>" + plot::escaped(figure.title) +
         "</h4>\n<div class=\"wide\">" + plot::to_svg(figure.figure) + "</div><div class=\"narrow\">" +
         plot::to_svg(figure.figure, plot::kNarrowWidth) + "</div><figcaption>" + plot::escaped(figure.caption) +
         "</figcaption>\n</figure>\n";
}

}  // namespace tandem::netsim::demo
