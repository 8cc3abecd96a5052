#include "common/control/virtual_tool.h"

#include <cmath>
#include <utility>

#include "common/control/vector3.h"

namespace tandem::control {

namespace {

using Matrix = std::array<Vector3, VirtualTool::kAxes>;

/// Static friction is modelled as damping so large that the tool creeps by 0.01 mm/s under 1 kN [N s/m].
constexpr double kHolds = 1e8;

/// Solves a symmetric, positive definite system by elimination; three unknowns need no pivot.
Vector3 solved(Matrix m, Vector3 r) noexcept {
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

bool VirtualTool::implicit_step(double dt, const Pulls& pulls) noexcept {
  Vector3 velocity{};
  for (std::size_t a = 0; a < axes_; ++a) {
    const FreeAxis free = free_axis(a, dt, pulls[a]);
    velocity[a] = free.momentum / free.inertia;
  }
  surface_force_ = surface_k_ = surface_b_ = {};
  if (contacts_.size() > 0) {
    Equations free;
    for (std::size_t a = 0; a < kAxes; ++a) free.matrix[a][a] = 1;
    for (std::size_t a = 0; a < axes_; ++a) {
      const FreeAxis axis = free_axis(a, dt, pulls[a]);
      free.matrix[a][a] = axis.inertia;
      free.rhs[a] = axis.momentum;
    }
    meet_surfaces(dt, free, velocity);
  }
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

void VirtualTool::set_received_contacts(const ContactSet& received) noexcept {
  contacts_.keep(own_contacts_);
  for (std::size_t c = 0; c < received.size(); ++c) contacts_.add(received[c]);
}

/// Determines the touched surfaces by rounds: a surface that the step would enter is added; one that would have to pull
/// is removed.
void VirtualTool::meet_surfaces(double dt, const Equations& free, Vector3& velocity) noexcept {
  Surfaces surfaces{};
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    const double depth = contact.penetration(x_), slope = contact.slope(depth);
    surfaces[c].force = contact.spring(depth);
    surfaces[c].gain = contact.b + dt * slope;
  }
  constexpr int kRounds = 4, kRoundsRubbing = 12;
  bool settled = false;
  for (int round = 0, rounds = kRounds; round < rounds; ++round) {
    bool changed = false, rubs = false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const double along = dot(contacts_[c].normal, velocity);
      const bool pushes = surfaces[c].force - surfaces[c].gain * along > 0;
      const bool inside = contacts_[c].penetration(x_) - dt * along > 0;
      // A touched surface stays touched while it pushes: its damping may hold the tool just outside, and without it the
      // tool would be inside.
      const bool met = pushes && (inside || surfaces[c].met);
      changed = changed || met != surfaces[c].met;
      surfaces[c].met = met;
      rubs = rubs || (met && contacts_[c].mu > 0);
    }
    if (!changed) {
      settled = true;
      break;
    }
    if (rubs) {
      rounds = kRoundsRubbing;
      apply_friction(dt, free, surfaces, velocity);
    } else {
      for (Met& surface : surfaces) surface.drag = 0;
      velocity = with_surfaces(dt, free, surfaces);
    }
  }
  // Rare, between three stiff surfaces: no set of them is consistent with its own step. The tool rests for this tick,
  // which creates no energy.
  if (!settled) velocity = {};
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!surfaces[c].met) continue;
    const Vector3& n = contacts_[c].normal;
    const double force = std::max(0.0, surfaces[c].force - surfaces[c].gain * dot(n, velocity));
    const double slope = contacts_[c].slope(contacts_[c].penetration(x_));
    const Vector3 slip = surfaces[c].drag > 0 ? across(contacts_[c], velocity) : Vector3{};
    for (std::size_t a = 0; a < axes_; ++a) {
      surface_force_[a] += force * n[a] - surfaces[c].drag * slip[a];
      surface_k_[a] += slope * n[a] * n[a];
      surface_b_[a] += contacts_[c].b * n[a] * n[a];
    }
  }
}

Vector3 VirtualTool::with_surfaces(double dt, Equations equations, const Surfaces& surfaces) const noexcept {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!surfaces[c].met) continue;
    const Vector3& n = contacts_[c].normal;
    for (std::size_t i = 0; i < axes_; ++i) {
      equations.rhs[i] += dt * surfaces[c].force * n[i];
      for (std::size_t j = 0; j < axes_; ++j)
        equations.matrix[i][j] +=
            dt * ((surfaces[c].gain - surfaces[c].drag) * n[i] * n[j] + (i == j ? surfaces[c].drag : 0));
    }
  }
  return solved(equations.matrix, equations.rhs);
}

/// Applies Coulomb friction at the end of the step. A surface holds the tool where mu times its force suffices.
/// Otherwise it drags with exactly that force, written as damping: a force that only opposes the slip creates no energy
/// and no chatter. One round is exact where one surface is touched and all axes are alike; other cases take a few
/// rounds.
void VirtualTool::apply_friction(double dt, const Equations& free, Surfaces& surfaces,
                                 Vector3& velocity) const noexcept {
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    surfaces[c].drag = surfaces[c].met && contacts_[c].mu > 0 ? kHolds : 0;
  velocity = with_surfaces(dt, free, surfaces);
  constexpr int kRounds = 5;
  bool too_much = true;
  for (int round = 0; round < kRounds && too_much; ++round) {
    too_much = false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      Met& surface = surfaces[c];
      if (surface.drag == 0) continue;
      const Vector3 slip = across(contacts_[c], velocity);
      const double rate = std::sqrt(dot(slip, slip));
      const double most =
          contacts_[c].mu * std::max(0.0, surface.force - surface.gain * dot(contacts_[c].normal, velocity));
      if (surface.drag * rate <= most * (1 + 1e-9)) continue;
      double inertia = 0;  // of the tool, its springs and dampers along the slip
      for (std::size_t a = 0; a < axes_; ++a) inertia += free.matrix[a][a] * slip[a] * slip[a] / (rate * rate);
      const double drive = rate * (inertia + dt * surface.drag);  // momentum that the slip would have without friction
      surface.drag = std::min(surface.drag, most * inertia / (drive - dt * most));
      too_much = true;
    }
    if (too_much) velocity = with_surfaces(dt, free, surfaces);
  }
}

/// Returns the part of a vector that lies in the surface, in the axes of this tool.
Vector3 VirtualTool::across(const Contact& contact, const Vector3& vector) const noexcept {
  const double along = dot(contact.normal, vector);
  Vector3 out{};
  for (std::size_t a = 0; a < axes_; ++a) out[a] = vector[a] - along * contact.normal[a];
  return out;
}

double VirtualTool::surface_energy() const noexcept {
  double sum = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const double d = std::max(0.0, contacts_[c].penetration(x_));
    sum += (0.5 * contacts_[c].k + 0.25 * contacts_[c].k3 * d * d) * d * d;
  }
  return sum;
}

double VirtualTool::penetration() const noexcept {
  double deepest = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) deepest = std::max(deepest, contacts_[c].penetration(x_));
  return deepest;
}

}  // namespace tandem::control
