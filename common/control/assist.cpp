#include "common/control/assist.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

namespace {
double norm(const AxisArray& v, std::size_t axes) noexcept {
  double square = 0;
  for (std::size_t a = 0; a < axes; ++a) square += v[a] * v[a];
  return std::sqrt(square);
}
/// Returns the factor that limits `length` to `most`.
double within(double length, double most) noexcept { return length > most ? most / length : 1; }
}  // namespace

Assist::Assist(const Params& params) noexcept
    : p_(params),
      reach_(params.force / params.k_c),
      pole_(0.5 * std::sqrt(params.k_c / kMassMax)),
      most_(kRate / params.k_c * params.dt) {}

double Assist::force() const noexcept { return p_.k_c * norm(shift_, p_.axes); }

const AxisArray& Assist::step(const Input& in) noexcept {
  const double distance = norm(in.ahead, p_.axes), speed = norm(in.velocity, p_.axes);
  const bool known = in.led && std::isfinite(distance) && std::isfinite(speed);
  const bool wanted = known && (p_.in_contact || !in.touching);
  const double part =
      wanted ? std::clamp(1 - in.authority / kAuthority, 0.0, 1.0) / (1 + speed * speed / (kSlow * kSlow)) : 0;
  const double clip = known ? within(distance, reach_) : 0, share = 1 - std::exp(-pole_ * p_.dt);
  const double fading = (part / kFadeTime + (1 - part) / kReleaseTime) * p_.dt, gain = part * pole_ / 6 * p_.dt;
  AxisArray next{};
  for (std::size_t a = 0; a < p_.axes; ++a) {
    first_[a] += share * ((known ? clip * in.ahead[a] : 0) - first_[a]);
    second_[a] += share * (first_[a] - second_[a]);
    next[a] = shift_[a] + gain * second_[a] - fading * shift_[a];
  }
  const double bound = within(norm(next, p_.axes), reach_);
  for (std::size_t a = 0; a < p_.axes; ++a) step_[a] = bound * next[a] - shift_[a];
  const double pace = within(norm(step_, p_.axes), most_);
  for (std::size_t a = 0; a < p_.axes; ++a) step_[a] *= pace;
  return step_;
}

}  // namespace tandem::control
