#pragma once

#include <string>
#include <vector>

/// Stability limits found by experiment with the laws, beside those of theory.
namespace tandem::test {

struct StabilityRow {
  std::string family;  ///< source of the closed form
  std::string loop;    ///< the closed loop and its parameters
  std::string unit;
  double experiment = 0;  ///< largest stable value of the code under test, by bisection of simulated motion
  double exact = 0;  ///< the same from eigenvalues of matrices written down independently; Diolaiti: energy balance
  double closed_form = 0;  ///< formula of the source
  bool friction = false;
};

[[nodiscard]] std::vector<StabilityRow> colgate_schenkel_rows();
[[nodiscard]] std::vector<StabilityRow> gil_hulin_rows();
[[nodiscard]] std::vector<StabilityRow> diolaiti_rows();
[[nodiscard]] std::vector<StabilityRow> p_plus_d_rows();
[[nodiscard]] std::vector<StabilityRow> peer_rows();
[[nodiscard]] std::vector<StabilityRow> replica_rows();

/// Prints one row.
void print(const StabilityRow& row);

}  // namespace tandem::test
