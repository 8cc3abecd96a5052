#include "netsim/cells/cell_numbers.h"

#include <cmath>

#include "netsim/plot/ticks.h"

namespace tandem::netsim {

namespace {

constexpr double kSmallest = 0.005;  // in reports; below, two decimals suffice

}  // namespace

std::string report_text(const CellNumberRow& row, double value) {
  const double shown = value * row.factor;
  if (std::abs(shown) < kSmallest) return plot::number_text(shown, shown == 0 ? 0 : 2);
  return plot::significant_text(shown, row.digits);
}

}  // namespace tandem::netsim
