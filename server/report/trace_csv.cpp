#include "server/report/trace_csv.h"

#include <charconv>
#include <cmath>
#include <cstdlib>

namespace tandem::server {

namespace {

template <class Value>
void put_shortest(std::string& out, Value value) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void put_integer(std::string& out, std::uint64_t value) {
  out += ',';
  put_shortest(out, value);
}

/// Writes nine decimals, which is exact for the magnitudes of this simulation; other values, also NaN, as to_chars
/// does.
void put_number(std::string& out, double value) {
  out += ',';
  if (!(std::abs(value) < 1e9)) return put_shortest(out, value);
  const auto scaled = static_cast<std::int64_t>(std::llround(value * 1e9));
  if (scaled < 0) out += '-';
  const auto magnitude = static_cast<std::uint64_t>(scaled < 0 ? -scaled : scaled);
  put_shortest(out, magnitude / 1'000'000'000);
  std::uint64_t rest = magnitude % 1'000'000'000;
  if (rest == 0) return;
  char decimals[10];
  decimals[0] = '.';
  for (int i = 9; i >= 1; --i) {
    decimals[i] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  }
  int last = 9;
  while (decimals[last] == '0') --last;
  out.append(decimals, static_cast<std::size_t>(last) + 1);
}

void put_triple(std::string& out, const Triple& v) {
  for (const double x : v) put_number(out, x);
}

}  // namespace

TraceCsv::TraceCsv(const SceneSpec& scene) : scene_(&scene) {
  const bool linear = scene.seats.front().device.model == DeviceModel::kLinear;
  joints_ = linear ? 1 : 3;
  const std::string angle = linear ? "[m]" : "[rad]";
  header_ = "tick[1],t_s[s]";
  const auto column = [this](const std::string& name) { header_ += ',' + name; };
  const auto triple = [&](const std::string& stem, const std::string& unit) {
    for (const char* axis : {"x", "y", "z"}) column(stem + axis + unit);
  };
  for (const SeatSpec& s : scene.seats) {
    column(s.name + ".alpha[1]");
    for (std::size_t j = 0; j < joints_; ++j) column(s.name + ".q" + std::to_string(j) + angle);
    triple(s.name + ".", "[m]");
    triple(s.name + ".f_cmd_", "[N]");
    triple(s.name + ".f_out_", "[N]");
    for (std::size_t a = 0; a < scene.dof; ++a) column(s.name + ".e_in" + std::to_string(a) + "[nJ]");
    for (std::size_t a = 0; a < scene.dof; ++a) column(s.name + ".e_out" + std::to_string(a) + "[nJ]");
    if (s.kind != SeatKind::kMaster) continue;
    column(s.name + ".leader[1]");
    triple(s.name + ".ghost_", "[m]");
  }
  for (const ToolSpec& t : scene.tools) {
    for (std::size_t j = 0; j < joints_; ++j) column(t.name + ".q" + std::to_string(j) + angle);
    triple(t.name + ".", "[m]");
    triple(t.name + ".f_cmd_", "[N]");
    triple(t.name + ".f_env_", "[N]");
    column(t.name + ".penetration[m]");
    column(t.name + ".held[1]");
    for (std::size_t a = 0; a < scene.dof; ++a) column(t.name + ".e_p" + std::to_string(a) + "[J]");
  }
  header_ += '\n';
}

void TraceCsv::append(const TickRecord& record, std::string& out) const {
  put_shortest(out, record.tick);
  put_number(out, record.tick / scene_->tick_hz);
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    const SeatRecord& s = record.seats[i];
    put_number(out, s.alpha);
    for (std::size_t j = 0; j < joints_; ++j) put_number(out, s.q[j]);
    put_triple(out, s.x);
    put_triple(out, s.f_cmd);
    put_triple(out, s.f_out);
    for (std::size_t a = 0; a < scene_->dof; ++a) put_integer(out, s.e_in[a]);
    for (std::size_t a = 0; a < scene_->dof; ++a) put_integer(out, s.e_out[a]);
    if (scene_->seats[i].kind != SeatKind::kMaster) continue;
    put_integer(out, s.leader);
    put_triple(out, s.ghost);
  }
  for (std::size_t j = 0; j < scene_->tools.size(); ++j) {
    const ToolRecord& t = record.tools[j];
    for (std::size_t k = 0; k < joints_; ++k) put_number(out, t.q[k]);
    put_triple(out, t.x);
    put_triple(out, t.f_cmd);
    put_triple(out, t.f_env);
    put_number(out, t.penetration);
    out += t.held ? ",1" : ",0";
    for (std::size_t a = 0; a < scene_->dof; ++a) put_number(out, a < 3 ? t.e_p_axis_j[a] : 0);
  }
  out += '\n';
}

}  // namespace tandem::server
