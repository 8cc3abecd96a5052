#include "server/console/join_body.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>

#include "proto/rpc/rpc_texts.h"

namespace tandem::console {
namespace {

int digit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// @return nullopt: a percent sign without two hexadecimal digits
std::optional<std::string> decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    if (i + 2 >= text.size() || digit(text[i + 1]) < 0 || digit(text[i + 2]) < 0) return std::nullopt;
    out += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
    i += 2;
  }
  return out;
}

/// Stores one field. @return whether the field is known
bool store(JoinBody& into, std::string_view key, std::string value) {
  if (key != "ticket" && key != "name") return false;
  (key == "ticket" ? into.ticket : into.name) = std::move(value);
  return true;
}

bool parse_json(std::string_view text, JoinBody& into) {
  const auto body = nlohmann::json::parse(text, nullptr, false);
  if (!body.is_object()) return false;
  return std::ranges::all_of(body.items(), [&into](const auto& item) {
    return item.value().is_string() && store(into, item.key(), item.value().template get<std::string>());
  });
}

bool parse_form(std::string_view text, JoinBody& into) {
  while (!text.empty()) {
    const auto end = text.find('&');
    const std::string_view pair = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    const auto equals = pair.find('=');
    if (equals == std::string_view::npos) return false;
    auto value = decoded(pair.substr(equals + 1));
    if (!value || !store(into, pair.substr(0, equals), std::move(*value))) return false;
  }
  return true;
}

/// Removes white space at both ends: tickets are often copied with a line break.
void trim(std::string& text) {
  const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  text.erase(std::ranges::find_if_not(text.rbegin(), text.rend(), space).base(), text.end());
  text.erase(text.begin(), std::ranges::find_if_not(text, space));
}

}  // namespace

std::expected<JoinBody, std::string> parse_join_body(std::string_view content_type, std::string_view body) {
  const std::string_view type = content_type.substr(0, content_type.find(';'));
  JoinBody parsed;
  const bool json = type == "application/json", form = type == "application/x-www-form-urlencoded";
  if (!json && !form) return std::unexpected("the body must be application/json or application/x-www-form-urlencoded");
  if (body.size() > kJoinBodyMax) return std::unexpected("the body must have at most 2048 bytes");
  if (!(json ? parse_json(body, parsed) : parse_form(body, parsed)))
    return std::unexpected("the body must have the texts \"ticket\" and perhaps \"name\", and nothing else");
  trim(parsed.ticket);
  trim(parsed.name);
  if (parsed.ticket.empty() || parsed.ticket.size() > kTicketTextMax)
    return std::unexpected("\"ticket\" must be the output of `tandem-server ticket`, at most 1024 characters");
  if (!parsed.name.empty() && !rpc::is_name(parsed.name))
    return std::unexpected("\"name\" must be " + std::string(rpc::kNameRule));
  return parsed;
}

}  // namespace tandem::console
