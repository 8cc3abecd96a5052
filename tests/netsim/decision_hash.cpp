#include <cstdio>

#include "common/link/digest.h"
#include "tests/netsim/decision_matrix.h"

/// Prints the SHA-256 of the decision log of every network of the fixed matrix, and of all together: the same lines on
/// every build, compiler and machine. Exit 1 when a network decided nothing.
int main() {
  using namespace tandem;
  link::Digest together;
  bool empty = false;
  for (const netsim::test::MatrixEntry& entry : netsim::test::decision_matrix()) {
    const auto rows = entry.log();
    const std::string text = netsim::decision_csv(rows);
    link::Digest digest;
    digest.add(text);
    together.add(text);
    empty = empty || rows.empty();
    std::printf("%s  %s, %zu decisions\n", digest.hex().c_str(), entry.name.c_str(), rows.size());
  }
  std::printf("%s  all\n", together.hex().c_str());
  return empty ? 1 : 0;
}
