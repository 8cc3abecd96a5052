#include "server/service/service_consoles.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/auth/key_fingerprint.h"
#include "common/base/hex.h"

namespace tandem::server {

namespace {

/// Reads an id of exactly its length.
template <std::size_t kSize>
bool read_hex(const nlohmann::json& in, std::array<std::byte, kSize>& into) {
  const auto* const text = in.get_ptr<const std::string*>();
  return text != nullptr && text->size() == 2 * kSize && auth::from_hex(*text, into);
}

}  // namespace

std::string to_text(const ServiceConsoles& consoles) {
  nlohmann::json tickets = nlohmann::json::array();
  for (std::size_t i = 0; i < std::min(consoles.tickets.size(), ServiceConsoles::kTicketsMax); ++i)
    tickets.push_back(to_hex(consoles.tickets[i]));
  return nlohmann::json{{"session", to_hex(consoles.session)}, {"epoch", consoles.epoch}, {"tickets", tickets}}.dump();
}

std::optional<ServiceConsoles> parse_service_consoles(std::string_view text) {
  if (text.size() > kServiceConsolesMax) return std::nullopt;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto session = json.find("session"), epoch = json.find("epoch"), tickets = json.find("tickets");
  if (session == json.end() || epoch == json.end() || tickets == json.end()) return std::nullopt;
  ServiceConsoles consoles;
  if (!read_hex(*session, consoles.session) || !epoch->is_number_unsigned() || !tickets->is_array() ||
      tickets->size() > ServiceConsoles::kTicketsMax)
    return std::nullopt;
  consoles.epoch = epoch->get<std::uint64_t>();
  for (const auto& ticket : *tickets)
    if (!read_hex(ticket, consoles.tickets.emplace_back())) return std::nullopt;
  return consoles;
}

std::vector<ServiceConsoles::Ticket> tickets_for_next_owner(std::string_view text, const rpc::Id& session,
                                                            std::uint64_t snapshot_epoch) {
  auto consoles = parse_service_consoles(text);
  if (!consoles || consoles->session != session || consoles->epoch < snapshot_epoch) return {};
  return std::move(consoles->tickets);
}

}  // namespace tandem::server
