// Compares Tandem with packages that exchange messages, each in processes of its own. Rounds are interleaved. On a
// shared machine only the ratios within one run are meaningful.
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace {

/// Code of a program whose package does not encrypt, or has no other way.
constexpr int kOtherWay = 3;

struct Program {
  const char *name, *path, *package;  ///< an empty path: not built, because the package is missing
};
constexpr Program kPrograms[] = {{"bare echo", PEER_ECHO, ""},
                                 {"Tandem", PEER_TANDEM, ""},
                                 {"ENet", PEER_ENET, "libenet-dev"},
                                 {"asio", PEER_ASIO, ""},
                                 {"ZeroMQ", PEER_ZEROMQ, "libzmq3-dev"},
                                 {"Cyclone DDS", PEER_DDS, "cyclonedds-dev cyclonedds-tools"},
                                 {"gRPC", PEER_GRPC, "libgrpc++-dev protobuf-compiler-grpc"}};

struct Result {
  double cpu_ns = 0, loop_p50_us = 0, loop_p99_us = 0, path_p50_us = 0, answered = 0;
};

struct Row {
  const Program* program;
  bool sealed = false;
  std::vector<double> cpu, ratio, p50, p99, path, answered;
};

/// @return nothing if the program does not have this way; ends this program if it failed
std::optional<Result> run(const Program& program, int clients, double length, bool sealed) {
  const std::string command = std::string("'") + program.path + "' " + std::to_string(clients) + " " +
                              std::to_string(length) + (sealed ? " sealed" : " plain");
  std::FILE* const out = popen(command.c_str(), "r");
  if (out == nullptr) std::perror("popen"), std::exit(1);
  Result r;
  const int fields = std::fscanf(out, "cpu_ns=%lf loop_p50_us=%lf loop_p99_us=%lf path_p50_us=%lf answered=%lf",
                                 &r.cpu_ns, &r.loop_p50_us, &r.loop_p99_us, &r.path_p50_us, &r.answered);
  const int status = pclose(out);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kOtherWay) return std::nullopt;
  if (status != 0 || fields != 5) std::fprintf(stderr, "failed: %s\n", command.c_str()), std::exit(1);
  return r;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void compare(int clients, double length, int rounds) {
  std::vector<Row> rows;
  for (const Program& program : kPrograms)
    for (const bool sealed : {false, true})
      if (*program.path != '\0') rows.push_back({&program, sealed, {}, {}, {}, {}, {}, {}});
  for (int round = 0; round < rounds; ++round) {
    double echo = 0;
    for (Row& row : rows) {
      const auto result = run(*row.program, clients, length, row.sealed);
      if (!result) continue;
      if (row.program == &kPrograms[0]) echo = result->cpu_ns;
      row.cpu.push_back(result->cpu_ns), row.ratio.push_back(result->cpu_ns / echo);
      row.p50.push_back(result->loop_p50_us), row.p99.push_back(result->loop_p99_us);
      row.path.push_back(result->path_p50_us), row.answered.push_back(100 * result->answered);
    }
    std::fprintf(stderr, "%d clients: round %d of %d\n", clients, round + 1, rounds);
  }
  std::printf("\n%d clients\n%-12s %-7s %12s %8s %14s %10s %10s %10s %9s\n", clients, "", "", "CPU ns", "/ echo",
              "(min..max)", "loop p50", "loop p99", "path p50", "answered");
  for (const Row& row : rows) {
    if (row.cpu.empty()) continue;
    std::printf("%-12s %-7s %12.0f %8.2f (%5.2f..%5.2f) %7.0f us %7.0f us %7.0f us %7.1f %%\n", row.program->name,
                row.sealed ? "sealed" : "plain", median(row.cpu), median(row.ratio), std::ranges::min(row.ratio),
                std::ranges::max(row.ratio), median(row.p50), median(row.p99), median(row.path), median(row.answered));
  }
}

}  // namespace

/// Arguments: seconds per run, rounds.
int main(int argc, char** argv) {
  const double length = argc > 1 ? std::atof(argv[1]) : 1;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  if (!(length > 0 && length <= 60) || rounds < 1 || rounds > 100) {
    std::fprintf(stderr, "usage: %s [SECONDS [ROUNDS]]   (up to 60 s, 1 to 100 rounds)\n", argv[0]);
    return 2;
  }
  std::printf(
      "One message of the size of a STATE (3 axes) per client and millisecond, answered by one of the size of a FORCE; "
      "all clients\nsend at the millisecond; medians of %d interleaved rounds of %.1f s. CPU: all threads of the "
      "server's "
      "process, per answer.\nTandem couples hands at its tick; the others answer at once. path: the loop without the "
      "wait "
      "for the tick.\n",
      rounds, length);
  for (const Program& program : kPrograms)
    if (*program.path == '\0') std::printf("not run: %s needs %s\n", program.name, program.package);
  for (const int clients : {3, 99}) compare(clients, length, rounds);
  return 0;  // a measurement, not a test: shared machines are noisy
}
