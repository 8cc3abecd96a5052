#include "proto/text/text_format_reader.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/message.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "common/base/suggestions.h"

namespace tandem::text {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;
using google::protobuf::io::Tokenizer;

class TokenErrors : public google::protobuf::io::ErrorCollector {
 public:
  explicit TokenErrors(MessageValidator& validator) : checker_(validator) {}
  void AddError(int line, int column, const std::string& message) override {
    checker_.error_at({line + 1, column + 1, ""}, "", message);
  }

 private:
  MessageValidator& checker_;
};

std::vector<std::string> field_names(const Descriptor& d) {
  std::vector<std::string> names;
  for (int i = 0; i < d.field_count(); ++i) names.push_back(d.field(i)->name());
  return names;
}
std::vector<std::string> value_names(const EnumDescriptor& d) {
  std::vector<std::string> names;
  for (int i = 0; i < d.value_count(); ++i) names.push_back(d.value(i)->name());
  return names;
}

class Reader {
 public:
  Reader(std::string_view text, MessageValidator& validator)
      : checker_(validator),
        token_errors_(validator),
        stream_(text.data(), static_cast<int>(text.size())),
        tokens_(&stream_, &token_errors_) {
    tokens_.set_comment_style(Tokenizer::SH_COMMENT_STYLE);
    tokens_.set_allow_multiline_strings(false);
    tokens_.set_require_space_after_number(false);
    tokens_.Next();
  }

  void file(Message& message) {
    fields(message, "");
    while (!at_end()) {  // `fields` returns early only at a closing bracket
      mistake("", "closes nothing");
      tokens_.Next();
      fields(message, "");
    }
  }

 private:
  [[nodiscard]] bool at_end() { return tokens_.current().type == Tokenizer::TYPE_END; }
  [[nodiscard]] bool at(std::string_view symbol) {
    return tokens_.current().type == Tokenizer::TYPE_SYMBOL && tokens_.current().text == symbol;
  }
  bool take(std::string_view symbol) {
    if (!at(symbol)) return false;
    tokens_.Next();
    return true;
  }
  [[nodiscard]] SourceLocation here() {
    const auto& t = tokens_.current();
    return {t.line + 1, t.column + 1, t.text};
  }
  void mistake(std::string_view path, std::string message) {
    SourceLocation place = here();
    if (path.empty() && !place.value.empty()) {  // no key to name: quote the text at this location
      message = "\"" + place.value.substr(0, 40) + "\" " + message;
    }
    checker_.error_at(place, path, std::move(message));
  }

  /// Reads fields up to a closing bracket, which it does not consume, or to the end.
  void fields(Message& message, const std::string& path) {
    std::map<const FieldDescriptor*, int> seen;
    while (!at_end() && !at("}") && !at(">")) {
      if (tokens_.current().type != Tokenizer::TYPE_IDENTIFIER) {
        mistake("", at("[") ? "is not a key: extensions are not used here" : "is not a key");
        skip_to_next_line();
        continue;
      }
      const SourceLocation key_place = here();
      const std::string key = tokens_.current().text;
      tokens_.Next();
      const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(key);
      if (field == nullptr) {
        SourceLocation place = key_place;
        place.value.clear();
        checker_.error_at(place, child_path(path, key),
                          "unknown key; " + suggest(key, field_names(*message.GetDescriptor())));
        skip_value();
      } else {
        one_field(message, *field, path, key_place, seen[field]);
      }
      if (!take(",")) take(";");
    }
  }

  void one_field(Message& message, const FieldDescriptor& field, const std::string& path,
                 const SourceLocation& key_place, int& count) {
    const std::string key = child_path(path, field.name(), field.is_repeated() ? count : -1);
    const bool is_message = field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
    if (!field.is_repeated() && count > 0) {
      SourceLocation place = key_place;
      place.value.clear();
      checker_.error_at(place, key, "is written twice, first in line " + std::to_string(checker_.location(key).line));
      skip_value();
      return;
    }
    const bool colon = take(":");
    if (is_message) {
      ++count;
      SourceLocation place = key_place;
      place.value.clear();
      checker_.record_location(key, place);
      sub_message(message, field, key, key_place);
    } else if (!colon) {
      ++count;
      checker_.record_location(key, key_place);
      checker_.error_at({key_place.line, key_place.column, ""}, key, "needs a colon before its value");
      take("-");
      const bool value_follows =
          tokens_.current().line + 1 == key_place.line && tokens_.current().type != Tokenizer::TYPE_SYMBOL;
      value_follows && !at_end() ? void(tokens_.Next()) : skip_value();
    } else if (field.is_repeated() && take("[")) {
      while (!at_end() && !at("]")) {
        scalar(message, field, child_path(path, field.name(), count++), key_place);
        if (!take(",")) break;
      }
      if (!take("]")) mistake(key, "] is missing");
    } else {
      ++count;
      scalar(message, field, key, key_place);
    }
  }

  void sub_message(Message& message, const FieldDescriptor& field, const std::string& key,
                   const SourceLocation& key_place) {
    const std::string_view close = at("<") ? ">" : "}";
    if (!take("{") && !take("<")) {
      mistake(key, "needs { ... }");
      skip_value();
      return;
    }
    const Reflection& r = *message.GetReflection();
    fields(field.is_repeated() ? *r.AddMessage(&message, &field) : *r.MutableMessage(&message, &field), key);
    if (at_end()) {
      checker_.error_at({key_place.line, key_place.column, ""}, key, "is never closed: } is missing");
    } else if (!take(close)) {
      mistake(key, "must be closed with " + std::string(close));
      tokens_.Next();
    }
  }

  /// Reads one scalar. It records the location of an unreadable value too, so that the key is not also reported as
  /// missing.
  void scalar(Message& message, const FieldDescriptor& field, const std::string& key, SourceLocation key_place) {
    key_place.value.clear();
    const SourceLocation place = here();
    const bool negative = take("-");
    const auto type = tokens_.current().type;
    if (at_end() || (type == Tokenizer::TYPE_SYMBOL)) {
      checker_.record_location(key, key_place);
      checker_.error_at(key_place, key, "has no value");
      if (!at("}") && !at(">") && !at_end()) skip_value();
      return;
    }
    SourceLocation whole = place;
    if (negative) whole.value += tokens_.current().text;
    checker_.record_location(key, whole);
    const std::string text = tokens_.current().text;
    const bool on_later_line = tokens_.previous().line < tokens_.current().line;
    if (const auto wrong = store(message, field, text, type, negative)) {
      if (type == Tokenizer::TYPE_IDENTIFIER && on_later_line) {  // probably the next key
        checker_.record_location(key, key_place);
        checker_.error_at(key_place, key, "has no value");
        return;
      }
      checker_.error_at(whole, key, *wrong);
    }
    const int line = tokens_.current().line;
    tokens_.Next();
    // TextFormat would join adjacent strings; this reader reports the second value as an error.
    const auto next = tokens_.current().type;
    if (tokens_.current().line == line &&
        (next == Tokenizer::TYPE_STRING || next == Tokenizer::TYPE_INTEGER || next == Tokenizer::TYPE_FLOAT)) {
      mistake(key, "one value only");
      tokens_.Next();
    }
  }

  /// @return the error, or nothing
  std::optional<std::string> store(Message& m, const FieldDescriptor& f, const std::string& text,
                                   Tokenizer::TokenType type, bool negative) {
    const Reflection& r = *m.GetReflection();
    const bool numeric = type == Tokenizer::TYPE_INTEGER || type == Tokenizer::TYPE_FLOAT;
    switch (f.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
      case FieldDescriptor::CPPTYPE_FLOAT: {
        double value = 0;
        if (!numeric) {
          if (text == "nan" || text == "inf" || text == "infinity" || text == "NaN") return "must be a finite number";
          return "must be a number";
        }
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc::result_out_of_range) return "is beyond double precision; must be a finite number";
        if (error != std::errc{} || end != text.data() + text.size()) return "must be a decimal number";
        if (negative) value = -value;
        if (f.cpp_type() == FieldDescriptor::CPPTYPE_FLOAT) {
          const auto single = static_cast<float>(value);
          f.is_repeated() ? r.AddFloat(&m, &f, single) : r.SetFloat(&m, &f, single);
        } else {
          f.is_repeated() ? r.AddDouble(&m, &f, value) : r.SetDouble(&m, &f, value);
        }
        return {};
      }
      case FieldDescriptor::CPPTYPE_UINT32:
      case FieldDescriptor::CPPTYPE_UINT64:
      case FieldDescriptor::CPPTYPE_INT32:
      case FieldDescriptor::CPPTYPE_INT64:
        return integer(m, f, text, type, negative);
      case FieldDescriptor::CPPTYPE_BOOL:
        if (negative || type != Tokenizer::TYPE_IDENTIFIER || (text != "true" && text != "false"))
          return "must be true or false";
        f.is_repeated() ? r.AddBool(&m, &f, text == "true") : r.SetBool(&m, &f, text == "true");
        return {};
      case FieldDescriptor::CPPTYPE_ENUM: {
        const auto* value = type == Tokenizer::TYPE_IDENTIFIER ? f.enum_type()->FindValueByName(text) : nullptr;
        if (value == nullptr || negative) return "unknown; " + suggest(text, value_names(*f.enum_type()));
        f.is_repeated() ? r.AddEnum(&m, &f, value) : r.SetEnum(&m, &f, value);
        return {};
      }
      case FieldDescriptor::CPPTYPE_STRING: {
        if (negative || type != Tokenizer::TYPE_STRING) return "must be a text in double quotes";
        std::string value;
        Tokenizer::ParseString(text, &value);
        f.is_repeated() ? r.AddString(&m, &f, value) : r.SetString(&m, &f, value);
        return {};
      }
      case FieldDescriptor::CPPTYPE_MESSAGE:
        break;
    }
    return "cannot be written here";
  }

  static std::optional<std::string> integer(Message& m, const FieldDescriptor& f, const std::string& text,
                                            Tokenizer::TokenType type, bool negative) {
    const Reflection& r = *m.GetReflection();
    const bool is_unsigned =
        f.cpp_type() == FieldDescriptor::CPPTYPE_UINT32 || f.cpp_type() == FieldDescriptor::CPPTYPE_UINT64;
    const bool narrow =
        f.cpp_type() == FieldDescriptor::CPPTYPE_UINT32 || f.cpp_type() == FieldDescriptor::CPPTYPE_INT32;
    std::uint64_t max = narrow ? 0xffffffffU : ~std::uint64_t{0};
    if (!is_unsigned) max /= 2;
    std::uint64_t value = 0;
    if (type != Tokenizer::TYPE_INTEGER || (negative && is_unsigned)) {
      return is_unsigned ? "must be a whole number from 0" : "must be a whole number";
    }
    if (!Tokenizer::ParseInteger(text, max, &value)) return "must be a whole number of at most " + std::to_string(max);
    const auto signed_value = negative ? -static_cast<std::int64_t>(value) : static_cast<std::int64_t>(value);
    switch (f.cpp_type()) {
      case FieldDescriptor::CPPTYPE_UINT32:
        f.is_repeated() ? r.AddUInt32(&m, &f, static_cast<std::uint32_t>(value))
                        : r.SetUInt32(&m, &f, static_cast<std::uint32_t>(value));
        break;
      case FieldDescriptor::CPPTYPE_UINT64:
        f.is_repeated() ? r.AddUInt64(&m, &f, value) : r.SetUInt64(&m, &f, value);
        break;
      case FieldDescriptor::CPPTYPE_INT32:
        f.is_repeated() ? r.AddInt32(&m, &f, static_cast<std::int32_t>(signed_value))
                        : r.SetInt32(&m, &f, static_cast<std::int32_t>(signed_value));
        break;
      default:
        f.is_repeated() ? r.AddInt64(&m, &f, signed_value) : r.SetInt64(&m, &f, signed_value);
    }
    return {};
  }

  /// Skips `: value`, `{ ... }`, `: [ ... ]` of an unused key.
  void skip_value() {
    if (!take(":") && !at("{") && !at("<")) return;
    take("-");
    int depth = 0;
    while (!at_end()) {
      if (at("{") || at("<") || at("[")) {
        ++depth;
      } else if (at("}") || at(">") || at("]")) {
        if (depth == 0) return;  // belongs to the enclosing message
        --depth;
      }
      tokens_.Next();
      if (depth == 0) return;
    }
  }
  void skip_to_next_line() {
    const int line = tokens_.current().line;
    while (!at_end() && tokens_.current().line == line && !at("}") && !at(">")) tokens_.Next();
  }

  MessageValidator& checker_;
  TokenErrors token_errors_;
  google::protobuf::io::ArrayInputStream stream_;
  Tokenizer tokens_;
};

}  // namespace

void read_text_format(std::string_view text, Message& message, MessageValidator& validator) {
  Reader(text, validator).file(message);
}

void read_json(std::string_view text, Message& message, MessageValidator& validator) {
  google::protobuf::util::JsonParseOptions options;
  options.ignore_unknown_fields = false;
  const auto status = google::protobuf::util::JsonStringToMessage({text.data(), text.size()}, &message, options);
  if (!status.ok()) validator.error_at({}, "", "JSON: " + std::string(status.message()));
}

bool read_document(std::string_view text, std::string_view file_name, Message& message, MessageValidator& validator) {
  if (text.size() > kTextMax) {
    validator.error_at({}, "", "is longer than " + std::to_string(kTextMax) + " bytes");
    return false;
  }
  // A binary file would give one error per byte.
  const auto strange = std::ranges::find_if(text, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
  });
  if (strange != text.end()) {
    const auto line = 1 + std::count(text.begin(), strange, '\n');
    constexpr std::string_view kHex = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(*strange);
    const auto before = static_cast<std::size_t>(strange - text.begin());
    const auto newline = text.substr(0, before).rfind('\n');  // npos + 1 is 0: the first line
    validator.error_at({static_cast<int>(line), static_cast<int>(before - (newline + 1) + 1), ""}, "",
                       std::string("is not text: it has the byte 0x") + kHex[byte >> 4] + kHex[byte & 15] +
                           "; files of this kind are plain text");
    return false;
  }
  if (file_name.ends_with(".json")) {
    read_json(text, message, validator);
    if (!validator.ok()) return false;  // the parser stopped there: later keys would be reported as missing
  } else {
    read_text_format(text, message, validator);
  }
  std::vector<const FieldDescriptor*> set;
  message.GetReflection()->ListFields(message, &set);
  if (set.empty()) {
    if (validator.ok()) validator.error_at({1, 1, ""}, "", "the file is empty: no key is set");
    return false;
  }
  validator.check_limits(message);
  return true;
}

}  // namespace tandem::text
