#include "common/control/local_contacts.h"

#include <algorithm>
#include <cmath>

#include "common/control/vector3.h"

namespace tandem::control {

namespace {

Vector3 unit(Vector3 v) noexcept {
  const double length = std::sqrt(dot(v, v));
  for (double& part : v) part /= length;
  return v;
}

/// Converts a received surface; its normal has length 1 to double precision.
Contact surface_of(const LocalContact& told) noexcept {
  Contact out{.k = told.k, .b = told.b, .mu = told.mu};
  const Vector3 point{told.point[0], told.point[1], told.point[2]};
  out.normal = unit({told.normal[0], told.normal[1], told.normal[2]});
  out.at = dot(out.normal, point);
  return out;
}

double energy(double k, double depth) noexcept { return 0.5 * k * depth * depth; }

}  // namespace

LocalContacts::LocalContacts(const Params& params) noexcept
    : p_(params), valid_ticks_(static_cast<std::uint32_t>(std::lround(kValid / params.dt))) {}

void LocalContacts::clear() noexcept {
  for (Slot& slot : slots_) slot.used = false;
  used_ = 0;
  surfaces_.keep(0);
}

void LocalContacts::update(std::span<const LocalContact> told) noexcept {
  for (const LocalContact& contact : told) {
    Slot* place = nullptr;
    for (Slot& slot : slots_)
      if (slot.used && slot.id == contact.id) place = &slot;
    for (Slot& slot : slots_)
      if (place == nullptr && !slot.used) place = &slot;
    if (place == nullptr) {  // other surfaces still retreat; a slot becomes free when one of them is gone
      ++dropped_;
      continue;
    }
    place->told = surface_of(contact);
    place->valid = valid_ticks_;
    if (place->used) continue;
    place->used = true;
    place->id = contact.id;
    place->now = {};  // presses nowhere yet
    ++used_;
  }
}

bool LocalContacts::step(const AxisArray& x, ChannelEnd* end) noexcept {
  if (used_ == 0 && surfaces_.size() == 0) return false;
  const Vector3 here{x[0], p_.axes > 1 ? x[1] : 0, p_.axes > 2 ? x[2] : 0};
  surfaces_.keep(0);
  for (Slot& slot : slots_) {
    if (!slot.used) continue;
    follow(slot, here, end);
    if (slot.used) {
      surfaces_.add(slot.now);
    } else {
      --used_;
    }
  }
  return true;
}

void LocalContacts::follow(Slot& slot, const Vector3& x, ChannelEnd* end) noexcept {
  Contact& now = slot.now;
  const double before = now.penetration(x);
  settle(slot, before, end);
  const bool presses = now.k > 0 && before > 0;
  const bool named = slot.valid > 0;
  if (named) --slot.valid;
  if (!presses && !named) {
    slot.used = false;
    return;
  }
  if (!presses) {
    now = slot.told;
    if (now.penetration(x) <= 0) return;
    now.at = dot(now.normal, x);  // begins at the tool
  }
  const bool opposite =
      dot(now.normal, slot.told.normal) < 0;  // a normal cannot turn by that much while its surface presses
  const double depth = std::max(0.0, now.penetration(x));
  const double most = p_.v_app * p_.dt;
  const double wanted = !named || opposite ? -most : slot.told.penetration(x);
  double next = depth + std::clamp(wanted - depth, -most, most), k = now.k;
  if (named && !opposite) {
    turn(now, slot.told);
    now.b = slot.told.b;
    now.mu = slot.told.mu;
    // A tool that a spring holds against the surface then moves by at most the same distance.
    const double series = now.k + p_.k_c;
    k = std::clamp(slot.told.k, now.k - series * most / (depth + most),
                   now.k + (depth > 0 ? series * most / depth : slot.told.k));
  }
  const auto cost = [&] { return energy(k, std::max(0.0, next)) - energy(now.k, depth); };
  if (end != nullptr) {
    if (const double work = cost(), budget = affordable(work, now, p_.axes, *end); budget < work) {
      end->note_refused(work - budget);
      k = std::min(k, now.k);
      next = std::min(next, std::sqrt(depth * depth + 2 * budget / k));
    }
    for (std::size_t a = 0; a < p_.axes; ++a) static_cast<void>(end->pay(a, cost() * now.normal[a] * now.normal[a]));
    slot.moved = std::max(0.0, next - depth);
    slot.paid = slot.moved > 0 ? energy(k, next) - energy(k, depth) : 0;
  }
  now.k = k;
  now.at = next + dot(now.normal, x);
}

/// Refunds the excess charge of a move. The charge assumed a tool at rest. The tool yielded in its step, so
/// the work was at most the force after the step times the move, as 1/2 k d^2 is convex.
void LocalContacts::settle(Slot& slot, double depth, ChannelEnd* end) const noexcept {
  const double rest = slot.paid - slot.now.k * std::max(0.0, depth) * slot.moved;
  slot.paid = slot.moved = 0;
  if (end == nullptr || !(rest > 0)) return;
  for (std::size_t a = 0; a < p_.axes; ++a)
    static_cast<void>(end->pay(a, -rest * slot.now.normal[a] * slot.now.normal[a]));
}

/// Turns the surface about the tool: penetration and stored energy stay the same.
void LocalContacts::turn(Contact& now, const Contact& told) const noexcept {
  Vector3 way{};
  for (std::size_t a = 0; a < way.size(); ++a) way[a] = told.normal[a] - now.normal[a];
  const double length = std::sqrt(dot(way, way)), most = kTurn * p_.dt;
  if (length <= most) {
    now.normal = told.normal;
    return;
  }
  for (std::size_t a = 0; a < way.size(); ++a) now.normal[a] += way[a] * most / length;
  now.normal = unit(now.normal);
}

/// Returns how much of `energy` the accounts of all axes can pay together [J].
double LocalContacts::affordable(double energy, const Contact& now, std::size_t axes, const ChannelEnd& end) noexcept {
  constexpr double kRounding = 1e-9;  // [J]
  for (std::size_t a = 0; a < axes; ++a) {
    const double part = now.normal[a] * now.normal[a];
    const double budget = std::max(0.0, end.ledger(a).margin() - 2 * kRounding);
    if (part * energy > budget) energy = budget / part;
  }
  return energy;
}

}  // namespace tandem::control
