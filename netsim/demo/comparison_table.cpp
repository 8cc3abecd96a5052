#include "netsim/demo/comparison_table.h"

#include "netsim/demo/headline.h"
#include "netsim/demo/text_table.h"
#include "netsim/plot/svg_plot.h"

namespace tandem::netsim::demo {

using plot::escaped;

namespace {

std::string cell_html(const Cell& cell, std::string_view column) {
  std::string value = cell.value;
  std::string limit = escaped(cell.limit);
  if (cell.mark != Mark::kNone) {
    const bool met = cell.mark == Mark::kMet;
    limit += std::string(" ") + tag("span", std::string(symbol(cell.mark)),
                                    met ? "class=\"met\" title=\"met\"" : "class=\"missed\" title=\"missed\"");
    if (!met) value = tag("span", value, "class=\"missed\"");
  }
  // Narrow screens hide the head of the table and empty cells.
  const std::string label = "data-label=\"" + std::string(column) + "\"";
  return tag("td", value, "class=\"value" + std::string(cell.value == "–" ? " none" : "") + "\" " + label) +
         tag("td", limit, "class=\"limit\"");
}

/// Returns the label with an indent if it begins with spaces.
std::string indented(const std::string& label) {
  const std::size_t spaces = label.find_first_not_of(' ');
  return (spaces == 0 ? "" : "&emsp;") + escaped(label.substr(spaces));
}

}  // namespace

std::string tag(const std::string& name, const std::string& text, const std::string& attributes) {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + text + "</" + name + ">";
}

std::string to_html(const Comparison& comparison) {
  std::string html =
      "<div class=\"scroll\"><table class=\"comparison\">\n<thead><tr><th></th><th></th><th>paper</th><th "
      "colspan=\"2\">our "
      "reproduction<br>(the paper’s "
      "gains)</th><th colspan=\"2\">Tandem’s<br>defaults</th><th colspan=\"2\">defaults on the<br>bad "
      "network</th></tr></thead>\n";
  for (const Section& section : comparison.sections) {
    html += "<tbody><tr class=\"section\">" + tag("th", escaped(section.title), "colspan=\"9\"") + "</tr>\n";
    for (const Row& row : section.rows) {
      std::string notes;
      for (const char letter : row.notes)
        notes += (notes.empty() ? "" : ",") + ("<a href=\"#note-" + std::string(1, letter) + "\">" + letter + "</a>");
      const std::string paper = row.paper.empty() ? "class=\"paper none\"" : "class=\"paper\" data-label=\"paper\"";
      html += "<tr>" + tag("td", indented(row.label) + (notes.empty() ? "" : " " + tag("sup", notes))) +
              tag("td", escaped(row.unit)) + tag("td", row.paper, paper);
      for (std::size_t s = 0; s < kSettings; ++s) html += cell_html(row.cells[s], name_of(static_cast<Setting>(s)));
      html += "</tr>\n";
    }
    html += "</tbody>\n";
  }
  html += "</table></div>\n<ol class=\"notes\">\n";
  char letter = 'a';
  for (const std::string& note : comparison.footnotes)
    html += tag("li", escaped(note), "id=\"note-" + std::string(1, letter++) + "\"") + "\n";
  return html + "</ol>\n";
}

}  // namespace tandem::netsim::demo
