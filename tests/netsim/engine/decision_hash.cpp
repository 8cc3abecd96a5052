#include <cstdio>

#include "common/transport/digest.h"
#include "tests/netsim/engine/decision_matrix.h"

/// Prints the SHA-256 of the decision log of every network of the fixed matrix, and of all together. The lines must be
/// equal for every build, compiler and machine. Exits with 1 if a network has no decisions.
int main() {
  using namespace tandem;
  transport::Digest together;
  bool empty = false;
  for (const netsim::test::MatrixEntry& entry : netsim::test::decision_matrix()) {
    const auto rows = entry.log();
    const std::string text = netsim::decision_csv(rows);
    transport::Digest digest;
    digest.add(text);
    together.add(text);
    empty = empty || rows.empty();
    std::printf("%s  %s, %zu decisions\n", digest.hex().c_str(), entry.name.c_str(), rows.size());
  }
  std::printf("%s  all\n", together.hex().c_str());
  return empty ? 1 : 0;
}
