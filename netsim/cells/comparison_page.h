#pragma once

#include <string>

#include "netsim/cells/comparison_result.h"
#include "netsim/plot/svg_plot.h"

/// A comparison as one HTML file: no script, no external resource, light and dark. Pure functions.
namespace tandem::netsim {

/// Returns the page. @param version  of the program
[[nodiscard]] std::string comparison_page(const ComparisonResult& comparison, const std::string& version);

/// Returns the heat maps of a grid: one table per number that the grid has. Rows are laws and conditions, columns are
/// delays; a square shows the median, and on request its cell and its worst seed.
[[nodiscard]] std::string heat_maps(const ComparisonResult& comparison, std::size_t grid);
/// Returns the style sheet of the heat maps.
[[nodiscard]] std::string heat_style();

/// Returns the curves over the delay of every law with coupling ESC: tracking in task FREE, and stiffness felt in task
/// WALL, with two hands, all authority at the leader, and no other impairment. Cells of which most seeds are unstable,
/// and panels without numbers, are left out.
[[nodiscard]] plot::Figure laws_figure(const ComparisonResult& comparison);
/// Returns the same of every coupling of law PD: tracking and drag in task FREE.
[[nodiscard]] plot::Figure couplings_figure(const ComparisonResult& comparison);

}  // namespace tandem::netsim
