#pragma once

#include <google/protobuf/message.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>

/// Private to proto/text: tables that name each key of a message once, for reading and writing.
namespace tandem::text {

/// A key of a message and the member of a struct that holds its value.
template <class Spec>
struct MessageKey {
  const char* name;  ///< of a field in the schema; its type is that of the member
  std::variant<double Spec::*, std::optional<double> Spec::*, bool Spec::*, std::uint32_t Spec::*> member;
  double per_si = 1;  ///< a number in the file is this times the number in the struct: 1000 for a key in ms
};

/// Copies the values of `keys` that are set in `in`; other members of `out` keep their value.
/// @pre the message has a field of each name and type
template <class Spec, std::size_t N>
void read_keys(const google::protobuf::Message& in, const std::array<MessageKey<Spec>, N>& keys, Spec& out) {
  const google::protobuf::Reflection& values = *in.GetReflection();
  for (const MessageKey<Spec>& key : keys) {
    const auto* field = in.GetDescriptor()->FindFieldByName(key.name);
    if (!values.HasField(in, field)) continue;
    std::visit(
        [&]<class T>(T Spec::* member) {
          if constexpr (std::is_same_v<T, bool>) {
            out.*member = values.GetBool(in, field);
          } else if constexpr (std::is_same_v<T, std::uint32_t>) {
            out.*member = values.GetUInt32(in, field);
          } else {
            out.*member = values.GetDouble(in, field) / key.per_si;
          }
        },
        key.member);
  }
}

/// Sets all `keys` of `out`, except those whose member is an empty optional.
/// @pre the message has a field of each name and type
template <class Spec, std::size_t N>
void write_keys(const Spec& in, const std::array<MessageKey<Spec>, N>& keys, google::protobuf::Message& out) {
  const google::protobuf::Reflection& values = *out.GetReflection();
  for (const MessageKey<Spec>& key : keys) {
    const auto* field = out.GetDescriptor()->FindFieldByName(key.name);
    std::visit(
        [&]<class T>(T Spec::* member) {
          if constexpr (std::is_same_v<T, bool>) {
            values.SetBool(&out, field, in.*member);
          } else if constexpr (std::is_same_v<T, std::uint32_t>) {
            values.SetUInt32(&out, field, in.*member);
          } else if constexpr (std::is_same_v<T, double>) {
            values.SetDouble(&out, field, in.*member * key.per_si);
          } else if (in.*member) {
            values.SetDouble(&out, field, *(in.*member) * key.per_si);
          }
        },
        key.member);
  }
}

}  // namespace tandem::text
