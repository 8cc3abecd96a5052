// Integrators of a linear body: orders of convergence, closed forms, energy, axes that depend on each other, no heap.
#include "common/control/integrator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>

#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr std::array kAll{Integrator::kImplicitEuler, Integrator::kImplicitMidpoint, Integrator::kSemiImplicitEuler,
                          Integrator::kRk4, Integrator::kExact};
std::string name_of(Integrator how) { return std::string(kIntegratorNames[static_cast<std::size_t>(how)]); }

/// A tool of 20 g on the spring of a Touch: 141 rad/s.
template <class S>
LinearBody<S, 1> oscillator(double b, double f = 0, double k = 400) {
  LinearBody<S, 1> body;
  body.m = S(0.02);
  body.k(0, 0) = S(k);
  body.b(0, 0) = S(b);
  body.f(0) = S(f);
  return body;
}
template <class S>
Motion<S, 1> at(double x, double v) {
  Motion<S, 1> motion;
  motion.x(0) = S(x);
  motion.v(0) = S(v);
  return motion;
}
template <class S>
Motion<S, 1> run(Integrator how, const LinearBody<S, 1>& body, Motion<S, 1> motion, double h, int steps) {
  for (int i = 0; i < steps; ++i) motion = advanced<S, 1>(how, body, motion, S(h));
  return motion;
}

/// Closed form of the underdamped oscillator: x and v after time t.
struct Closed {
  long double x, v;
};
Closed closed_form(long double b, long double f, long double x0, long double v0, long double t) {
  const long double m = 0.02L, k = 400, rest = f / k, decay = b / (2 * m);
  const long double w = std::sqrt(k / m - decay * decay), a = x0 - rest, c = (v0 + decay * a) / w;
  const long double e = std::exp(-decay * t), cosine = std::cos(w * t), sine = std::sin(w * t);
  return {rest + e * (a * cosine + c * sine), e * ((c * w - decay * a) * cosine - (a * w + decay * c) * sine)};
}

template <class S>
long double error_at(Integrator how, double h, double t) {
  const auto steps = static_cast<int>(std::lround(t / h));
  const Motion<S, 1> end = run<S>(how, oscillator<S>(0.2, 1), at<S>(0.01, 0.5), h, steps);
  const Closed truth = closed_form(0.2L, 1, 0.01L, 0.5L, t);
  return std::hypot(static_cast<long double>(end.x(0)) - truth.x,
                    (static_cast<long double>(end.v(0)) - truth.v) / 141.4L);
}

template <class S>
double order_of(Integrator how, double h) {
  return static_cast<double>(std::log2(error_at<S>(how, h, 0.096) / error_at<S>(how, h / 2, 0.096)));
}

TEST(Integrator, ConvergesWithItsOrderInDouble) {
  EXPECT_NEAR(order_of<double>(Integrator::kImplicitEuler, 2e-5), 1, 0.05);
  EXPECT_NEAR(order_of<double>(Integrator::kSemiImplicitEuler, 2e-5), 1, 0.05);
  EXPECT_NEAR(order_of<double>(Integrator::kImplicitMidpoint, 2e-4), 2, 0.05);
  EXPECT_NEAR(order_of<double>(Integrator::kRk4, 1e-3), 4, 0.1);
}

// Steps are large, so that the errors are above the rounding of float.
TEST(Integrator, ConvergesWithItsOrderInFloat) {
  EXPECT_NEAR(order_of<float>(Integrator::kImplicitEuler, 2e-4), 1, 0.1);
  EXPECT_NEAR(order_of<float>(Integrator::kSemiImplicitEuler, 2e-4), 1, 0.1);
  EXPECT_NEAR(order_of<float>(Integrator::kImplicitMidpoint, 1e-3), 2, 0.1);
  EXPECT_NEAR(order_of<float>(Integrator::kRk4, 4e-3), 4, 0.4);
}

TEST(Integrator, IsExactForTheDampedOscillator) {
  for (const double h : {1e-5, 1e-3, 8e-3}) {
    EXPECT_LT(error_at<double>(Integrator::kExact, h, 0.096), 1e-13 * (0.096 / h)) << h;
    EXPECT_LT(error_at<float>(Integrator::kExact, h, 0.096), 2e-8 * (0.096 / h)) << h;
  }
}

TEST(Integrator, IsExactForAFreeMassAndAForce) {
  const Motion<double, 1> end =
      run<double>(Integrator::kExact, oscillator<double>(0, 0.1, 0), at<double>(0, 1), 1e-3, 100);
  EXPECT_NEAR(end.v(0), 1 + 0.1 / 0.02 * 0.1, 1e-13);
  EXPECT_NEAR(end.x(0), 0.1 + 0.5 * 0.1 / 0.02 * 0.01, 1e-13);
}

TEST(Integrator, IsExactForAnOverdampedMass) {  // B / m = 1000 / s: v decays by e^-1 per millisecond
  const Motion<double, 1> end =
      run<double>(Integrator::kExact, oscillator<double>(20, 0, 0), at<double>(0, 1), 1e-3, 5);
  EXPECT_NEAR(end.v(0), std::exp(-5.0), 1e-14);
  EXPECT_NEAR(end.x(0), (1 - std::exp(-5.0)) * 1e-3, 1e-15);
}

template <class S>
double energy(const LinearBody<S, 1>& body, const Motion<S, 1>& at) {
  const double x = static_cast<double>(at.x(0)), v = static_cast<double>(at.v(0));
  return 0.5 * static_cast<double>(body.m) * v * v + 0.5 * static_cast<double>(body.k(0, 0)) * x * x;
}

/// Smallest and largest energy over its start, of an undamped oscillator, in the first and last tenth of a long run.
struct EnergySpan {
  double first_low = 2, first_high = 0, last_low = 2, last_high = 0;
};
EnergySpan energy_of(Integrator how) {
  const LinearBody<double, 1> body = oscillator<double>(0);
  Motion<double, 1> motion = at<double>(0.01, 0);
  const double start = energy(body, motion);
  EnergySpan span;
  constexpr int kSteps = 100'000;
  for (int i = 0; i < kSteps; ++i) {
    motion = advanced<double, 1>(how, body, motion, 1e-3);
    const double part = energy(body, motion) / start;
    if (i < kSteps / 10) {
      span.first_low = std::min(span.first_low, part);
      span.first_high = std::max(span.first_high, part);
    } else if (i >= kSteps - kSteps / 10) {
      span.last_low = std::min(span.last_low, part);
      span.last_high = std::max(span.last_high, part);
    }
  }
  return span;
}

TEST(Integrator, MidpointAndExactConserveEnergy) {
  for (const Integrator how : {Integrator::kImplicitMidpoint, Integrator::kExact}) {
    const EnergySpan span = energy_of(how);
    EXPECT_NEAR(span.last_low, 1, 1e-9) << name_of(how);
    EXPECT_NEAR(span.last_high, 1, 1e-9) << name_of(how);
  }
}

// Its modified energy m v^2 / 2 + k x^2 / 2 - h k x v / 2 is constant, so the true energy stays within h w / 2 = 7 % /
// 2 of it [Hairer, Lubich, Wanner 2006, IX.3].
TEST(Integrator, SemiImplicitEulerKeepsTheEnergyBounded) {
  const EnergySpan span = energy_of(Integrator::kSemiImplicitEuler);
  EXPECT_GT(span.last_high, 1.05) << "it is not conserved";
  EXPECT_LT(span.last_high, 1 + 0.1415 / (1 - 0.0708));
  EXPECT_GT(span.last_low, 0.85);
  EXPECT_NEAR(span.last_high, span.first_high, 1e-3) << "no drift";
  EXPECT_NEAR(span.last_low, span.first_low, 1e-3);
}

TEST(Integrator, ImplicitEulerDissipatesWithoutADamper) {
  const LinearBody<double, 1> body = oscillator<double>(0);
  Motion<double, 1> motion = at<double>(0.01, 0);
  double before = energy(body, motion);
  for (int i = 0; i < 1000; ++i) {
    const Motion<double, 1> next = advanced<double, 1>(Integrator::kImplicitEuler, body, motion, 1e-3);
    const double after = energy(body, next);
    // The identity of the method: it loses m dv^2 / 2 + k dx^2 / 2 in every step.
    const double dv = next.v(0) - motion.v(0), dx = next.x(0) - motion.x(0);
    ASSERT_NEAR(before - after, 0.5 * 0.02 * dv * dv + 0.5 * 400 * dx * dx, 1e-15);
    motion = next;
    before = after;
  }
  EXPECT_LT(before, 1e-6);
}

// The same oscillators, seen in axes that are turned: one system of three axes.
TEST(Integrator, GivesTheSameInTurnedAxes) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d k(20000, 400, 0), b(5, 0.2, 14), f(1, -2, 0.5), x(0.01, -0.02, 0.005), v(0.1, -0.3, 0.2);
  for (const Integrator how : kAll) {
    LinearBody<double, 3> body;
    body.m = 0.02;
    body.k = turn * k.asDiagonal() * turn.transpose();
    body.b = turn * b.asDiagonal() * turn.transpose();
    body.f = turn * f;
    Motion<double, 3> whole{turn * x, turn * v};
    std::array<Motion<double, 1>, 3> alone;
    for (int a = 0; a < 3; ++a) alone[static_cast<std::size_t>(a)] = at<double>(x(a), v(a));
    for (int i = 0; i < 50; ++i) {
      whole = advanced<double, 3>(how, body, whole, 1e-4);
      for (int a = 0; a < 3; ++a) {
        Motion<double, 1>& one = alone[static_cast<std::size_t>(a)];
        one = advanced<double, 1>(how, oscillator<double>(b(a), f(a), k(a)), one, 1e-4);
      }
    }
    const Eigen::Vector3d turned = turn.transpose() * whole.x;
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(turned(a), alone[static_cast<std::size_t>(a)].x(0), 1e-12) << name_of(how) << " axis " << a;
  }
}

TEST(Integrator, GivesNothingFiniteForInputThatIsNotFinite) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const Integrator how : kAll)
    for (const double bad : {inf, -inf, nan}) {
      const Motion<double, 1> force = advanced<double, 1>(how, oscillator<double>(0.2, bad), at<double>(0, 0), 1e-3);
      EXPECT_FALSE(force.x.allFinite() && force.v.allFinite()) << name_of(how);
      const Motion<double, 1> place = advanced<double, 1>(how, oscillator<double>(0.2), at<double>(bad, 0), 1e-3);
      EXPECT_FALSE(place.x.allFinite() && place.v.allFinite()) << name_of(how);
    }
}

template <class S, int N>
void expect_no_heap(Integrator how) {
  LinearBody<S, N> body;
  body.m = S(0.02);
  body.k.setIdentity();
  body.k *= S(2e4);
  Motion<S, N> motion;
  motion.x.setConstant(S(0.01));
  const test::AllocGuard guard;
  for (int i = 0; i < 3; ++i) motion = advanced<S, N>(how, body, motion, S(1e-4));
  EXPECT_EQ(guard.count(), 0u) << name_of(how);
  EXPECT_TRUE(motion.x.allFinite());
}

TEST(Integrator, UsesNoHeap) {
  for (const Integrator how : kAll) {
    expect_no_heap<double, 1>(how);
    expect_no_heap<double, 3>(how);
    expect_no_heap<float, 1>(how);
    expect_no_heap<float, 3>(how);
  }
}

}  // namespace
}  // namespace tandem::control
