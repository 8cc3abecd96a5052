#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// Private to proto/rpc: messages with exactly one encoding.
namespace tandem::rpc {

/// The library writes the fields of these messages in the order of their numbers: they have no map and no extension.
template <class Message>
std::vector<std::byte> serialized(const Message& message) {
  std::vector<std::byte> out(message.ByteSizeLong());
  message.SerializeToArray(out.data(), static_cast<int>(out.size()));
  return out;
}

template <class Message>
bool parse(std::span<const std::byte> bytes, Message& out, std::size_t size_max) {
  return bytes.size() <= size_max && out.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

/// Rejects encodings that differ from the only one: unknown, repeated or reordered fields and long numbers.
template <class Value>
std::optional<Value> if_canonical(Value value, std::span<const std::byte> bytes) {
  return std::ranges::equal(encode(value), bytes) ? std::optional{std::move(value)} : std::nullopt;
}

}  // namespace tandem::rpc
