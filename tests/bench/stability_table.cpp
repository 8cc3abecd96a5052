// Prints the stability limits of the laws, found by bisection of simulated motion, beside those of theory.
#include "tests/common/control/stability_rows.h"

int main() {
  using namespace tandem::test;
  for (const auto& rows :
       {colgate_schenkel_rows(), gil_hulin_rows(), diolaiti_rows(), p_plus_d_rows(), replica_rows(), peer_rows()})
    for (const StabilityRow& row : rows) print(row);
  return 0;
}
