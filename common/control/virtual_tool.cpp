#include "common/control/virtual_tool.h"

#include <cmath>
#include <utility>

namespace tandem::control {

namespace {

using Vector = std::array<double, VirtualTool::kAxes>;
using Matrix = std::array<Vector, VirtualTool::kAxes>;

double dot(const Vector& a, const Vector& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Solves a symmetric, positive definite system by elimination; three unknowns need no pivot.
Vector solved(Matrix m, Vector r) noexcept {
  for (std::size_t i = 0; i < r.size(); ++i) {
    for (std::size_t j = i + 1; j < r.size(); ++j) {
      const double factor = m[j][i] / m[i][i];
      if (factor == 0) continue;
      for (std::size_t c = i; c < r.size(); ++c) m[j][c] -= factor * m[i][c];
      r[j] -= factor * r[i];
    }
  }
  for (std::size_t i = r.size(); i-- > 0;) {
    for (std::size_t c = i + 1; c < r.size(); ++c) r[i] -= m[i][c] * r[c];
    r[i] /= m[i][i];
  }
  return r;
}

}  // namespace

void VirtualTool::rest_at(const AxisArray& x) noexcept {
  for (std::size_t a = 0; a < axes_; ++a) x_[a] = x[a];
  v_ = surface_force_ = surface_k_ = surface_b_ = {};
}

bool VirtualTool::step(double dt, const Pulls& pulls) noexcept {
  Equations free;
  Vector velocity{};
  for (std::size_t a = 0; a < kAxes; ++a) {
    free.matrix[a][a] = 1;
    if (a >= axes_) continue;
    const Pull& p = pulls[a];
    free.matrix[a][a] = gains_.m + dt * (gains_.b + p.b) + dt * dt * p.k;
    free.rhs[a] = gains_.m * v_[a] + dt * (p.k_anchor - p.k * x_[a] + p.b_velocity);
    velocity[a] = free.rhs[a] / free.matrix[a][a];
  }
  meet_surfaces(dt, free, velocity);
  for (std::size_t a = 0; a < axes_; ++a) {
    if (std::isfinite(x_[a] + dt * velocity[a])) continue;
    v_ = surface_force_ = surface_k_ = surface_b_ = {};
    return false;
  }
  for (std::size_t a = 0; a < axes_; ++a) {
    v_[a] = velocity[a];
    x_[a] += dt * velocity[a];
  }
  return true;
}

/// Which surfaces are met is found by rounds: one that the step would enter is added, one that would have to pull is taken out.
void VirtualTool::meet_surfaces(double dt, const Equations& free, Vector& velocity) noexcept {
  surface_force_ = surface_k_ = surface_b_ = {};
  if (contacts_.size() == 0) return;
  struct Met {
    bool met = false;
    double force = 0, gain = 0;  ///< the surface's force is force - gain * (normal . velocity)
  };
  std::array<Met, ContactSet::kMax> surfaces{};
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    const double depth = contact.penetration(x_), slope = contact.slope(depth);
    surfaces[c].force = contact.spring(depth);
    surfaces[c].gain = contact.b + dt * slope;
  }
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const double along = dot(contacts_[c].normal, velocity);
      const bool pushes = surfaces[c].force - surfaces[c].gain * along > 0;
      const bool inside = contacts_[c].penetration(x_) - dt * along > 0;
      // Once met it stays so while it pushes: its damping may hold the tool just outside, and without it the tool would be inside.
      const bool met = pushes && (inside || surfaces[c].met);
      changed = changed || met != surfaces[c].met;
      surfaces[c].met = met;
    }
    if (!changed) break;
    Equations with = free;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (!surfaces[c].met) continue;
      const Vector& n = contacts_[c].normal;
      for (std::size_t i = 0; i < axes_; ++i) {
        with.rhs[i] += dt * surfaces[c].force * n[i];
        for (std::size_t j = 0; j < axes_; ++j) with.matrix[i][j] += dt * surfaces[c].gain * n[i] * n[j];
      }
    }
    velocity = solved(with.matrix, with.rhs);
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!surfaces[c].met) continue;
    const Vector& n = contacts_[c].normal;
    const double force = std::max(0.0, surfaces[c].force - surfaces[c].gain * dot(n, velocity));
    const double slope = contacts_[c].slope(contacts_[c].penetration(x_));
    for (std::size_t a = 0; a < axes_; ++a) {
      surface_force_[a] += force * n[a];
      surface_k_[a] += slope * n[a] * n[a];
      surface_b_[a] += contacts_[c].b * n[a] * n[a];
    }
  }
}

double VirtualTool::penetration() const noexcept {
  double deepest = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) deepest = std::max(deepest, contacts_[c].penetration(x_));
  return deepest;
}

}  // namespace tandem::control
