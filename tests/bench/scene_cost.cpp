// The cost of a scene for the server: user-space instructions of a sealed client-tick, from one axis in free space to
// eight hands in contact, with the bytes of the datagrams. A scene may cost only what it names, so that the first row
// is the cost of the system itself.
#include <cstdio>
#include <cstring>
#include <string>

#include "tests/bench/scene_rows.h"
#include "tests/bench/served_sessions.h"

namespace tandem::bench {
namespace {

int print_table(const std::string& self) {
  std::printf(
      "user-space instructions of the server per sealed client-tick (callgrind; asked: at most 1200 beyond cipher and "
      "copy in the first row)\n%-66s %6s %7s %6s %7s\n",
      "scene", "all", "cipher", "copy", "beyond");
  for (const Row& row : kRows) {
    const auto cost = cost_of(self, row);
    if (!cost) {
      std::printf("%-66s [ NOT RUN ] valgrind is missing or failed\n", row.what);
      continue;
    }
    std::printf("%-66s %6.0f %7.0f %6.0f %7.0f\n", row.what, cost->all, cost->cipher, cost->copy, cost->rest());
  }
  return 0;
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  using namespace tandem::bench;
  if (argc == 4 && std::strcmp(argv[1], "--serve") == 0) {
    const Row& row = row_of(argv[2]);
    return serve(scene_of(row), {row.recorded, row.watched, row.inputs}, std::atoi(argv[3]));
  }
  return print_table(argv[0]);
}
