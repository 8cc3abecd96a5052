#include "common/control/channel_wave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace tandem::control {
namespace {

constexpr double kT = 0.001, kB = 5, kK = 1000;
constexpr double kPerSquare = kB / (4 * kT);  ///< energy of a wave over its square [N/m]

/// One axis, no position correction.
ChannelParams plain(Side side, double e0) {
  ChannelParams p;
  p.side = side;
  p.dof = 1;
  p.e0 = e0;
  p.schedule.k = kK;
  p.impedance = kB;
  p.v_app = 0;
  p.margin_max = 10;
  return p;
}

EndInput wave(double rate, double x = 0) {
  EndInput in;
  in.dt = kT;
  in.rx.v[0] = rate;
  in.x[0] = x;
  return in;
}

TEST(WaveChannel, SplitsAnArrivingWaveIntoMotionAndAWaveThatLeaves) {
  WaveEnd end(plain(Side::kClient, 1));
  end.engage({}, 0);
  const EndState& s = end.move(wave(1));  // dy_in = 1 mm; k T / b = 0.2, so dr = 1 mm / 1.2
  EXPECT_NEAR(s.ref[0], 1e-3 / 1.2, 1e-15);
  AxisArray sent{};
  end.replace_velocity(sent);
  EXPECT_NEAR(sent[0], (1e-3 / 1.2 - 0.2 * 1e-3 / 1.2) / kT, 1e-12);  // F T / b = 0.2 dr leaves less
  EXPECT_NEAR(s.paid[0], kPerSquare * 1e-6, 1e-15);
  EXPECT_NEAR(s.absorbed[0], kPerSquare * std::pow(0.8e-3 / 1.2, 2), 1e-15);
  const double force = kK * s.ref[0];
  EXPECT_NEAR(force * s.ref[0], s.paid[0] - s.absorbed[0], 1e-15);  // work of the channel = waves in - waves out
}

TEST(WaveChannel, AWaveActsOnlyAsFarAsItIsPaidFor) {
  WaveEnd end(plain(Side::kClient, 0));
  end.engage({}, 0);
  EXPECT_EQ(end.move(wave(1)).ref[0], 0) << "no energy has arrived";
  EndInput in = wave(1);
  in.rx.e_in[0] =
      static_cast<std::uint64_t>(std::llround(0.25 * kPerSquare * 1e-6 * 1e9)) + 1;  // a quarter: half the wave
  EXPECT_NEAR(end.move(in).ref[0], 0.5e-3 / 1.2, 1e-8);
  EXPECT_TRUE(end.ledger(0).holds());
  EXPECT_GT(end.refused(), 0);
}

TEST(WaveChannel, StoresNoMoreThanTheWavesUnderWay) {  // ends in series over a constant delay, no position correction
  for (const std::size_t delay : {1U, 20U, 200U}) {
    SCOPED_TRACE(delay);
    WaveEnd client(plain(Side::kClient, 1)), server(plain(Side::kServer, 1));
    client.engage({}, 0);
    server.engage({}, 0);
    std::deque<double> up(delay, 0.0), down(delay, 0.0);
    double given = 0;  // by the channel, both ends [J]
    double x = 0;
    for (int tick = 0; tick < 4000; ++tick) {
      x = 0.02 * std::sin(2 * 3.14159265358979 * 0.7 * tick * kT);
      const auto step = [&](WaveEnd& end, std::deque<double>& from, std::deque<double>& to, double near) {
        const double before = end.state().ref[0];
        EndInput in = wave(from.front(), near);
        from.pop_front();
        in.rx.e_in[0] = 4'000'000'000'000ULL;  // never short of energy
        const EndState& s = end.move(in);
        given += kK * (s.ref[0] - near) * (s.ref[0] - before);
        AxisArray sent{};
        end.replace_velocity(sent);
        to.push_back(sent[0]);
      };
      step(client, down, up, x);
      step(server, up, down, 0.3 * x);
      double under_way = 0;
      for (const auto* line : {&up, &down})
        for (const double rate : *line) under_way += kPerSquare * rate * rate * kT * kT;
      ASSERT_NEAR(given, -under_way, 1e-9) << tick;
    }
  }
}

TEST(WaveChannel, MovesToTheReferenceOfTheOtherEndAtTheApproachSpeed) {
  ChannelParams p = plain(Side::kClient, 1);
  p.v_app = 0.1;
  WaveEnd client(p);
  client.engage({}, 0);
  EndInput in = wave(0);
  in.rx.x[0] = 0.05;
  in.rx.f[0] = 10;  // the server's reference is 10 N / 1000 N/m beyond its tool
  for (int tick = 0; tick < 5000; ++tick) {
    in.x[0] = client.state().ref[0];  // a hand that goes along
    const double before = client.state().ref[0];
    client.move(in);
    ASSERT_LE(std::abs(client.state().ref[0] - before), 0.1 * kT + 1e-12);
  }
  EXPECT_NEAR(client.state().ref[0], 0.06, 1e-6);
}

}  // namespace
}  // namespace tandem::control
