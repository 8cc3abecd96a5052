// The cost of one step of coupling and ledger on one axis of one seat, in double and in float: user-space instructions
// (callgrind) and ns.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

#include "common/control/channel_replica.h"
#include "common/control/tool_copy.h"
#include "tests/bench/instruction_count.h"

namespace tandem::bench {
namespace {

using namespace control;

/// One seat with the numbers of scene one_axis: 372 N/m to a tool of 20 g; authority shared, so that the ledger pays.
struct Seat {
  explicit Seat(const Numerics& numerics)
      : copy({.tool = {}, .axes = 1, .contacts = {}, .k_c = 372, .numerics = numerics, .assist = {}}), end(params()) {
    copy.rest_at(hand, hand);
    end.engage(hand, 0);
    in.authority = 0.5;
  }
  static ChannelParams params() {
    ChannelParams p;
    p.dof = 1;
    p.effort_max = 3.3;
    return p;
  }
  ToolCopy copy;
  ReplicaReference end;
  AxisArray hand{};
  EndInput in;
  int ticks = 0;
};

extern "C" [[gnu::noipa]] void tandem_bench_step(Seat* s) {
  s->in.x[0] = s->copy.tool().x(0);
  s->in.dissipated[0] = s->copy.dissipated(0);
  s->end.move(s->in);
  s->copy.delivered(s->copy.step(s->hand, s->in.authority, s->end));
}

/// Advances by one tick of a hand on a sawtooth of 10 mm, while the others stand 5 mm away.
void tick(Seat& seat) {
  seat.hand[0] = 1e-5 * (seat.ticks++ % 1000);
  seat.in.rx.x[0] = 5e-3;
  tandem_bench_step(&seat);
}

int run(Precision precision, int ticks) {
  Seat seat({Integrator::kImplicitEuler, precision, 1});
  for (int i = 0; i < ticks; ++i) tick(seat);
  return seat.copy.tool().x(0) > -1 ? 0 : 1;
}

/// Shortest mean time of a tick over many loops [ns].
double time_of(Precision precision) {
  constexpr int kLoops = 50, kTicks = 2000;
  Seat seat({Integrator::kImplicitEuler, precision, 1});
  double least = std::numeric_limits<double>::infinity();
  for (int loop = 0; loop < kLoops; ++loop) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kTicks; ++i) tick(seat);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    least = std::min(least, took.count() / kTicks);
  }
  return least;
}

int print_table(const std::string& self) {
  std::printf("one step of coupling and ledger, one axis, one seat, integrator implicit_euler\n%-8s %14s %8s\n", "type",
              "instructions", "ns");
  for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
    const std::string name(kPrecisionNames[static_cast<std::size_t>(precision)]);
    constexpr int kFew = 100, kMany = 1100;
    const auto count = [&](int ticks) {
      return count_instructions(self + " --run " + name + " " + std::to_string(ticks), "tandem_bench_step",
                                "step_cost.callgrind");
    };
    const auto few = count(kFew), many = count(kMany);
    const std::string instructions =
        few && many ? std::to_string(std::lround((*many - *few).all / (kMany - kFew))) : "not counted";
    std::printf("%-8s %14s %8.0f\n", name.c_str(), instructions.c_str(), time_of(precision));
  }
  std::printf("instructions are counted by callgrind; valgrind is missing or failed where they are not\n");
  return 0;
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  using namespace tandem::bench;
  if (argc == 4 && std::strcmp(argv[1], "--run") == 0)
    return run(
        std::strcmp(argv[2], "float") == 0 ? tandem::control::Precision::kFloat : tandem::control::Precision::kDouble,
        std::atoi(argv[3]));
  return print_table(argv[0]);
}
