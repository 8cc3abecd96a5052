#include "server/service/service_session.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/base/hex.h"
#include "proto/rpc/rpc_limits.h"

namespace tandem::server {

namespace {

using Json = nlohmann::json;

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

bool read_id(const std::string& hex, rpc::Id& into) {
  if (hex.size() != 2 * into.size()) return false;
  rpc::Id id{};
  for (std::size_t i = 0; i < hex.size(); ++i) {
    const char c = hex[i];
    const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    if (digit < 0) return false;
    id[i / 2] = id[i / 2] << 4 | static_cast<std::byte>(digit);
  }
  into = id;
  return true;
}

/// Copies a value of the wanted type. Returns false if it is missing or has another type.
template <class T>
bool read(const Json& in, const char* key, T& into) {
  const auto found = in.find(key);
  if (found == in.end()) return false;
  if constexpr (std::is_same_v<T, std::string>) {
    if (!found->is_string()) return false;
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!found->is_boolean()) return false;
  } else if constexpr (std::is_same_v<T, double>) {
    if (!found->is_number()) return false;
  } else {
    if (!found->is_number_integer()) return false;
  }
  into = found->get<T>();
  return true;
}

}  // namespace

std::string to_text(const ServiceSession& session) {
  Json out{{"id", to_hex(session.id)},         {"code", session.code},
           {"scene", session.scene},           {"scene_name", session.scene_name},
           {"duration_s", session.duration_s}, {"tickets_only", session.tickets_only},
           {"restart", session.restart},       {"created", session.created},
           {"ends_s", session.ends_s}};
  if (session.epoch_base != 0) out["epoch_base"] = session.epoch_base;
  return dumped(out);
}

std::optional<ServiceSession> parse_service_session(std::string_view text) {
  constexpr std::size_t kTextMax = 255;
  constexpr double kDurationMax = 3e6;
  constexpr std::int64_t kEndsMax = 8'000'000'000;               // in the year 2223: still a time in nanoseconds
  constexpr std::int64_t kEpochBaseMax = std::int64_t{1} << 62;  // half of what an epoch can be
  if (text.size() > kServiceSessionMax) return std::nullopt;
  const Json in = Json::parse(text, nullptr, false);
  if (!in.is_object()) return std::nullopt;
  ServiceSession out;
  std::string id;
  const bool complete = read(in, "id", id) && read_id(id, out.id) && read(in, "code", out.code) &&
                        read(in, "scene", out.scene) && read(in, "scene_name", out.scene_name) &&
                        read(in, "duration_s", out.duration_s) && read(in, "tickets_only", out.tickets_only) &&
                        read(in, "restart", out.restart) && read(in, "created", out.created) &&
                        read(in, "ends_s", out.ends_s);
  if (!complete || out.code.size() > kTextMax || out.scene.empty() || out.scene_name.empty() ||
      out.scene_name.size() > kTextMax || out.ends_s < 0 || out.ends_s > kEndsMax)
    return std::nullopt;
  const auto of_code = [](char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z'); };
  if (!std::ranges::all_of(out.code, of_code)) return std::nullopt;
  if (in.contains("epoch_base") && !read(in, "epoch_base", out.epoch_base)) return std::nullopt;
  if (out.epoch_base < 0 || out.epoch_base > kEpochBaseMax) return std::nullopt;
  if (!(out.duration_s >= 0 && out.duration_s <= kDurationMax)) return std::nullopt;
  return out;
}

std::string listed_text(const rpc::ListedSession& session) {
  Json seats = Json::array();
  for (const rpc::ListedSeat& seat : session.seats)
    seats.push_back({{"name", seat.name},
                     {"role", std::string(to_text(seat.role))},
                     {"taken", seat.taken},
                     {"required", seat.required}});
  // A server of before the phase `held` reads `phase` only, and would take an unknown word for no session.
  const bool held = session.phase == rpc::SessionPhase::kHeld;
  Json out{{"phase", to_text(held ? rpc::SessionPhase::kRunning : session.phase)}, {"seats", std::move(seats)}};
  if (held) out["held"] = true;
  return dumped(out);
}

bool read_listed(std::string_view text, rpc::ListedSession& session) {
  if (text.size() > kListedTextMax) return false;
  const Json in = Json::parse(text, nullptr, false);
  std::string phase;
  if (!in.is_object() || !read(in, "phase", phase)) return false;
  rpc::ListedSession out = session;
  const auto named = rpc::session_phase_named(phase);
  const auto held = in.find("held");
  if (held != in.end() && !held->is_boolean()) return false;
  const auto seats = in.find("seats");
  if (!named || seats == in.end() || !seats->is_array() || seats->size() > rpc::kListedSeatsMax) return false;
  out.phase = held != in.end() && held->get<bool>() ? rpc::SessionPhase::kHeld : *named;
  out.seats.clear();
  for (const Json& entry : *seats) {
    rpc::ListedSeat seat;
    std::string role;
    if (!entry.is_object() || !read(entry, "name", seat.name) || !read(entry, "role", role) ||
        !read(entry, "taken", seat.taken) || !read(entry, "required", seat.required))
      return false;
    const auto role_named = access_role_named(role);
    if (!role_named || seat.name.empty() || seat.name.size() > rpc::kNameMax) return false;
    seat.role = *role_named;
    out.seats.push_back(std::move(seat));
  }
  session = std::move(out);
  return true;
}

}  // namespace tandem::server
