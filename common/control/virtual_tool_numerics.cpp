#include <algorithm>
#include <cmath>

#include "common/control/integrator.h"
#include "common/control/vector3.h"
#include "common/control/virtual_tool.h"

namespace tandem::control {

namespace {

/// Advances the axes of a tool without surfaces, which needs no matrices: they would be half of the work on one axis.
/// @return whether the result was finite
template <class S>
bool free_step(Integrator how, const VirtualTool::Gains& gains, std::size_t axes, const VirtualTool::Pulls& pulls,
               double dt, Vector3& x, Vector3& v) noexcept {
  for (std::size_t a = 0; a < axes; ++a) {
    LinearBody<S, 1> body;
    body.m = static_cast<S>(gains.m);
    body.k(0) = static_cast<S>(pulls[a].k);
    body.b(0) = static_cast<S>(gains.b + pulls[a].b);
    body.f(0) = static_cast<S>(pulls[a].k_anchor + pulls[a].b_velocity);
    Motion<S, 1> at;
    at.x(0) = static_cast<S>(x[a]);
    at.v(0) = static_cast<S>(v[a]);
    const Motion<S, 1> to = advanced<S, 1>(how, body, at, static_cast<S>(dt));
    if (!std::isfinite(to.x(0)) || !std::isfinite(to.v(0))) return false;
    x[a] = static_cast<double>(to.x(0));
    v[a] = static_cast<double>(to.v(0));
  }
  return true;
}

}  // namespace

VirtualTool::Parts VirtualTool::step_in_parts(double dt, const Pulls& pulls) noexcept {
  const std::array<double, kAxes> start = x_;
  const double h = dt / numerics_.substeps;
  Parts parts{.finite = true};
  for (std::uint8_t i = 0; i < numerics_.substeps; ++i) {
    bool finite = false;
    const bool rounds = numerics_.precision == Precision::kFloat;
    if (numerics_.keeps_proof()) {
      finite = implicit_step(h, pulls);
    } else if (contacts_.size() > 0) {
      finite = rounds ? linear_step<float>(h, pulls) : linear_step<double>(h, pulls);
    } else {
      surface_force_ = surface_k_ = surface_b_ = {};
      finite = rounds ? free_step<float>(numerics_.integrator, gains_, axes_, pulls, h, x_, v_)
                      : free_step<double>(numerics_.integrator, gains_, axes_, pulls, h, x_, v_);
    }
    if (!finite) {
      x_ = start;
      v_ = surface_force_ = surface_k_ = surface_b_ = {};
      return {};
    }
    for (std::size_t a = 0; a < axes_; ++a) parts.squares[a] += v_[a] * v_[a] * h;
  }
  return parts;
}

double VirtualTool::heat(const Parts& parts, std::size_t axis, double b, double k, double dt) const noexcept {
  return numerics_.keeps_proof() ? (b + 0.5 * k * dt / numerics_.substeps) * parts.squares[axis] : 0;
}

/// Takes each surface that pushes at the start as linear: k' = d force / d depth there. A surface along one axis leaves
/// the axes independent.
template <class S>
bool VirtualTool::linear_step(double dt, const Pulls& pulls) noexcept {
  constexpr int kN = static_cast<int>(kAxes);
  LinearBody<S, kN> body;
  Motion<S, kN> at;
  body.m = static_cast<S>(gains_.m);
  for (std::size_t a = 0; a < axes_; ++a) {
    const auto i = static_cast<int>(a);
    body.k(i, i) = static_cast<S>(pulls[a].k);
    body.b(i, i) = static_cast<S>(gains_.b + pulls[a].b);
    body.f(i) = static_cast<S>(pulls[a].k_anchor + pulls[a].b_velocity);
    at.x(i) = static_cast<S>(x_[a]);
    at.v(i) = static_cast<S>(v_[a]);
  }
  bool independent = true;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    Eigen::Matrix<S, kN, 1> n = Eigen::Matrix<S, kN, 1>::Zero();
    int along = 0;
    for (std::size_t a = 0; a < axes_; ++a) {
      n(static_cast<int>(a)) = static_cast<S>(contact.normal[a]);
      along += contact.normal[a] != 0 ? 1 : 0;
    }
    const S depth = static_cast<S>(contact.at) - n.dot(at.x), b = static_cast<S>(contact.b);
    if (!(depth > 0)) continue;
    const S force = static_cast<S>(contact.spring(static_cast<double>(depth)));
    if (!(force - b * n.dot(at.v) > 0)) continue;  // a surface never pulls
    const S slope = static_cast<S>(contact.slope(static_cast<double>(depth)));
    body.f += (force + slope * n.dot(at.x)) * n;
    body.k += slope * n * n.transpose();
    body.b += b * n * n.transpose();
    independent = independent && along <= 1;
  }
  const S h = static_cast<S>(dt);
  Motion<S, kN> to;
  if (independent) {
    for (int i = 0; i < static_cast<int>(axes_); ++i) {
      const LinearBody<S, 1> one{body.m, body.k.template block<1, 1>(i, i), body.b.template block<1, 1>(i, i),
                                 body.f.template segment<1>(i)};
      const Motion<S, 1> next =
          advanced<S, 1>(numerics_.integrator, one, {at.x.template segment<1>(i), at.v.template segment<1>(i)}, h);
      to.x(i) = next.x(0);
      to.v(i) = next.v(0);
    }
  } else {
    to = advanced<S, kN>(numerics_.integrator, body, at, h);
  }
  if (!to.x.allFinite() || !to.v.allFinite()) return false;
  for (std::size_t a = 0; a < axes_; ++a) {
    x_[a] = static_cast<double>(to.x(static_cast<int>(a)));
    v_[a] = static_cast<double>(to.v(static_cast<int>(a)));
  }
  feel_surfaces();
  return true;
}

/// Sets force, stiffness and damping of the surfaces at the present state.
void VirtualTool::feel_surfaces() noexcept {
  surface_force_ = surface_k_ = surface_b_ = {};
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    const double depth = contact.penetration(x_);
    if (!(depth > 0)) continue;
    const Vector3& n = contact.normal;
    const double force = std::max(0.0, contact.spring(depth) - contact.b * dot(n, v_)), slope = contact.slope(depth);
    for (std::size_t a = 0; a < axes_; ++a) {
      surface_force_[a] += force * n[a];
      surface_k_[a] += slope * n[a] * n[a];
      surface_b_[a] += contact.b * n[a] * n[a];
    }
  }
}

}  // namespace tandem::control
